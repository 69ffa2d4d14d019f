#include <render/light/area.h>

#include <mc/core/error.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

std::shared_ptr<const Shape> square() { return std::make_shared<const Shape>(TriangleMesh::rectangle({})); }

TEST(AreaLight, EmitsFromSideOfNormal) {
  SurfacePoint p;
  p.ng = Vec3::UnitY();
  const Spectrum radiance(1, 2, 3), black = Spectrum::Zero();
  const Vec3 above(0, -1, 0), below(0, 1, 0), beside(1, 0, 0); // directions toward the light
  const AreaLight one(square(), {radiance}), both(square(), {radiance, true});
  EXPECT_TRUE((one.Le(above, &p) == radiance).all());
  EXPECT_TRUE((one.Le(below, &p) == black).all());
  EXPECT_TRUE((one.Le(beside, &p) == black).all());
  for (const Vec3& wi : {above, below}) EXPECT_TRUE((both.Le(wi, &p) == radiance).all());
  EXPECT_TRUE((both.Le(above, nullptr) == black).all()) << "where no surface is met, it does not shine";
}

// A square of area 4 has the power pi A L, and twice that if both sides emit.
TEST(AreaLight, Power) {
  EXPECT_NEAR(AreaLight(square(), {Spectrum::Constant(3)}).power(1), 12 * mc::pi<double>, 1e-5);
  EXPECT_NEAR(AreaLight(square(), {Spectrum::Constant(3), true}).power(1), 24 * mc::pi<double>, 1e-5);
}

TEST(AreaLight, SamplesItsShape) {
  const AreaLight light(square(), {Spectrum::Ones()});
  const Vec3 ref(Float(0.2), Float(0.1), 3);
  const auto s = light.sample(ref, Vec2(Float(0.3), Float(0.7)));
  ASSERT_TRUE(s && s->point);
  EXPECT_NEAR(light.pdf(ref, s->wi, &*s->point) / s->pdf, 1, 1e-5);
  EXPECT_TRUE((s->radiance == 1).all());
  EXPECT_LE((ref + (s->point->p - ref).norm() * s->wi - s->point->p).norm(), 1e-5);
}

TEST(AreaLight, RefusesNonsense) {
  const Float nan = std::numeric_limits<Float>::quiet_NaN();
  for (const Float bad : {Float(-1), nan, mc::infinity<Float>})
    EXPECT_THROW(AreaLight(square(), {Spectrum(1, bad, 1)}), mc::Error);
  const auto flat = std::make_shared<const Shape>(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}));
  EXPECT_THROW(AreaLight(flat, {}), mc::Error);
}

} // namespace

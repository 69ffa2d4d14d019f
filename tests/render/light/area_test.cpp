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

// The radiance of a texture where a light is hit, sampled or left; its mean decides power and irradiance.
TEST(AreaLight, TextureVariesTheRadiance) {
  const Spectrum bright(4, 2, 6), dark = Spectrum::Zero();
  const Texture halves = Checkerboard(bright, dark, UvMap({1, 0}));
  for (const auto& shape : {square(), std::make_shared<const Shape>(Sphere(Vec3d::Zero(), 1))}) {
    const AreaLight light(shape, {Spectrum::Constant(Float(0.5)), false, halves}),
        plain(shape, {Spectrum::Ones(), false});
    EXPECT_NEAR(light.radiance()[0], 1, 0.02);
    EXPECT_NEAR(light.power(1) / plain.power(1), double(luminance(bright)) / 4, 0.02);
    int lit = 0;
    constexpr int n = 40;
    for (int i = 0; i < n * n; ++i) {
      const int row = i / n, column = i % n;
      const Vec2 u((Float(column) + Float(0.5)) / n, (Float(row) + Float(0.5)) / n);
      const Vec3 ref(Float(0.3), Float(0.2), 4);
      const auto s = light.sample(ref, u);
      ASSERT_TRUE(s && s->point);
      const bool is_bright = shape->uv(*s->point)[0] < 0.5;
      EXPECT_TRUE((s->radiance == (is_bright ? Spectrum(bright / 2) : dark)).all());
      EXPECT_TRUE((light.Le(s->wi, &*s->point) == s->radiance).all());
      const auto e = light.sample_emission(EmissionTargets({}, {}, Bounds()), u, u);
      ASSERT_TRUE(e && e->point);
      EXPECT_TRUE((e->radiance == (shape->uv(*e->point)[0] < 0.5 ? Spectrum(bright / 2) : dark)).all());
      lit += is_bright;
    }
    EXPECT_GT(lit, n * n / 4);
    EXPECT_LT(lit, 3 * n * n / 4);
  }
  const auto without_uv = std::make_shared<const Shape>(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  EXPECT_THROW(AreaLight(without_uv, {Spectrum::Ones(), false, halves}), mc::Error);
  EXPECT_THROW(AreaLight(square(), {Spectrum::Ones(), false, Checkerboard(bright, Spectrum::Constant(-1))}), mc::Error);
}

} // namespace

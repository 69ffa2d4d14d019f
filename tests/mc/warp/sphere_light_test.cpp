#include <mc/warp/sphere_light.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class SphereLightOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SphereLightOver, Scalars);

// Viewers far away, at grazing distance, on the surface, inside and at the centre.
TYPED_TEST(SphereLightOver, ObeysTheLawsAtEveryDistance) {
  using S = TypeParam;
  for (const double radius : {1e-15, 1e-8, 1e-3, 0.5, 0.999999, 1.0, 1.5}) {
    const SphereLight<S> warp({S(0), S(1), S(0)}, S(radius));
    EXPECT_WARP_LAWS(warp, {.name = fmt::format("radius {}", radius),
                            .statistics = {.samples = radius >= 0.5 ? 20'000u : 0u},
                            .invert_eps = 16,
                            .sample_eps = 16,
                            .pdf_eps = 16});
  }
}

// Viewers next to the surface on all sides: the solid angle agrees with 50 digits to 8 eps at any scale.
TYPED_TEST(SphereLightOver, GrazingViewersSeeTheRightAngle) {
  using S = TypeParam;
  Pcg random(3);
  for (int k = 0; k < 2000; ++k) {
    const double height = std::pow(10.0, -18 * random.uniform<double>()),
                 scale = std::exp2(40 * random.uniform<double>() - 20);
    const S radius = S(scale * (1 + random.uniform<double>()));
    const Vec3<S> center = Sphere<S>{}.from_unit(random.point<S, 2>()) * S(radius * (1 + height));
    const SphereLight<S> light(center, radius);
    const double exact = static_cast<double>(light.template cast<Oracle>().solid_angle());
    ASSERT_LE(std::abs(double(light.solid_angle()) / exact - 1), 8 * double(std::numeric_limits<S>::epsilon()))
        << "height " << height << " radius " << radius;
  }
}

TEST(SphereLight, SolidAngles) {
  EXPECT_NEAR(SphereLight<double>({0, 0, 2}, 2).solid_angle(), 2 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(SphereLight<double>({0, 0, 0}, 2).solid_angle(), 4 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(SphereLight<float>({0, 0, 1}, 1e-9f).solid_angle() / (std::numbers::pi * 1e-18), 1, 1e-6);
}

TEST(SphereLight, RefusesNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double r : {0.0, -1.0, nan, HUGE_VAL, 1e-20}) EXPECT_THROW((SphereLight<double>({0, 0, 1}, r)), Error);
  EXPECT_THROW((SphereLight<double>({0, 0, nan}, 1)), Error);
}

} // namespace
} // namespace mc

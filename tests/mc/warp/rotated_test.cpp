#include <mc/warp/rotated.h>

#include <mc/gtest/matchers.h>
#include <mc/warp/cone.h>
#include <mc/warp/hemisphere.h>

namespace mc {
namespace {

template <class S> class RotatedOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(RotatedOver, Scalars);

template <class S> std::array<Vec3<S>, 3> axes() {
  return {Vec3<S>(0, 0, -1), Vec3<S>(Vec3<S>(1, -2, S(0.3)).normalized()),
          Vec3<S>(Vec3<S>(1, 1, S(-1e-3)).normalized())};
}

// u1 is accurate to eps / sin(theta), and the smallest sin(theta) in 20000 points is about 1/100. The pdf of the cosine
// is accurate to eps / z.
TYPED_TEST(RotatedOver, ObeysTheLawsAboutAnyAxis) {
  using S = TypeParam;
  for (const Vec3<S>& n : axes<S>()) {
    EXPECT_WARP_LAWS(Rotated(CosineHemisphere<S>{}, n),
                     {.name = "cosine", .statistics = {.samples = 0}, .points = 64, .invert_eps = 64, .pdf_eps = 128});
    EXPECT_WARP_LAWS(Rotated(UniformHemisphere<S>{}, n),
                     {.name = "uniform", .statistics = {.samples = 0}, .points = 64, .invert_eps = 256, .pdf_eps = 8});
    EXPECT_WARP_LAWS(Rotated(UniformCone<S>::from_angle(S(0.5)), n),
                     {.name = "cone", .statistics = {.samples = 0}, .points = 64, .invert_eps = 512, .pdf_eps = 8});
  }
}

TEST(Rotated, RefusesNonsense) {
  EXPECT_THROW((Rotated(CosineHemisphere<double>{}, Vec3<double>(0, 0, 2))), Error);
  EXPECT_THROW((Rotated(CosineHemisphere<double>{}, Vec3<double>(0, 0, std::numeric_limits<double>::quiet_NaN()))),
               Error);
}

} // namespace
} // namespace mc

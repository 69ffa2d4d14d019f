#include <mc/warp/rotation.h>

#include <mc/gtest/matchers.h>

#include <Eigen/Geometry>

namespace mc {
namespace {

template <class S> class RotationOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(RotationOver, Scalars);

TYPED_TEST(RotationOver, ObeysTheLaws) {
  EXPECT_WARP_LAWS(UniformRotation<TypeParam>{}, {.statistics = {.samples = 50'000}, .invert_eps = 8, .pdf_eps = 4});
}

// A uniform rotation takes each axis to a uniform direction, and its angle t has the density (1 - cos t) / pi.
TEST(Rotation, AxesAndAnglesHaveTheirDistributions) {
  Pcg random(3);
  std::vector<double> z, cosines;
  for (int i = 0; i < 100'000; ++i) {
    const Vec<double, 4> q = UniformRotation<double>{}.sample(random.point<double, 3>());
    const Eigen::Quaterniond r(q[3], q[0], q[1], q[2]);
    z.push_back((r * Eigen::Vector3d::UnitX()).z());
    cosines.push_back(2 * q[3] * q[3] - 1); // cos t
  }
  EXPECT_MEAN(z, 0);
  EXPECT_MEAN(cosines, -0.5);
}

// The samples differ from a density that prefers small angles.
TEST(Rotation, WrongDensityFails) {
  struct Wrong : UniformRotation<double> {
    double pdf(const Vec<double, 4>& q) const { return (0.9 + 0.4 * q[3] * q[3]) / (pi<double> * pi<double>); }
  };
  const Report r = check_subject(make_subject("wrong", Wrong{}), {.samples = 50'000});
  EXPECT_EQ(r.verdict(), Verdict::fail) << r.to_string();
}

} // namespace
} // namespace mc

#include <mc/core/frame.h>

#include <mc/random/pcg.h>
#include <mc/warp/hemisphere.h>

#include <gtest/gtest.h>

namespace {

template <class S> class FrameTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(FrameTest, Scalars);

template <class S> void expect_orthonormal(const mc::Vec3<S>& n) {
  const S eps = std::numeric_limits<S>::epsilon();
  const auto f = mc::Frame<S>::from_z(n);
  EXPECT_LE(std::abs(f.x.squaredNorm() - 1), 4 * eps) << n.transpose();
  EXPECT_LE(std::abs(f.y.squaredNorm() - 1), 4 * eps) << n.transpose();
  EXPECT_LE(std::abs(f.x.dot(f.y)), 4 * eps) << n.transpose();
  EXPECT_LE(std::abs(f.x.dot(n)), 4 * eps) << n.transpose();
  EXPECT_LE(std::abs(f.y.dot(n)), 4 * eps) << n.transpose();
  EXPECT_GE(mc::cross<S>(f.x, f.y).dot(n), S(0.99)) << "right-handed";
}

TYPED_TEST(FrameTest, OrthonormalForRandomNormalsAndAtThePoles) {
  using S = TypeParam;
  mc::Pcg random(1);
  for (int i = 0; i < 20000; ++i) {
    mc::Vec3<S> n = mc::UniformHemisphere<S>{}.sample(random.point<S, 2>());
    n.normalize();
    expect_orthonormal<S>(n);
    expect_orthonormal<S>(-n);
  }
  for (const S tiny : {S(0), std::numeric_limits<S>::denorm_min(), S(1e-30), S(1e-8), S(1e-4)})
    for (const S z : {S(1), S(-1)}) {
      mc::Vec3<S> n(tiny, -tiny, z);
      n.normalize();
      expect_orthonormal<S>(n);
    }
  for (const S zero : {S(0), S(-0.0)}) expect_orthonormal<S>({S(1), S(0), zero});
}

TYPED_TEST(FrameTest, LocalAndWorldAreInverse) {
  using S = TypeParam;
  mc::Pcg random(2);
  for (int i = 0; i < 1000; ++i) {
    const mc::Vec3<S> n = mc::UniformHemisphere<S>{}.sample(random.point<S, 2>()).normalized();
    const auto f = mc::Frame<S>::from_z(n);
    const mc::Vec3<S> v = mc::UniformHemisphere<S>{}.sample(random.point<S, 2>());
    EXPECT_LE((f.to_local(f.to_world(v)) - v).norm(), 8 * std::numeric_limits<S>::epsilon());
    EXPECT_LE((f.to_local(n) - mc::Vec3<S>::UnitZ()).norm(), 8 * std::numeric_limits<S>::epsilon());
  }
}

} // namespace

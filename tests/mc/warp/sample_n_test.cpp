#include <mc/warp/sample_n.h>

#include <mc/random/pcg.h>
#include <mc/warp/annulus.h>
#include <mc/warp/cone.h>
#include <mc/warp/disk.h>
#include <mc/warp/exponential.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/sphere.h>
#include <mc/warp/trowbridge_reitz.h>

#include <gtest/gtest.h>

namespace mc {
namespace {

template <class S> std::vector<S> numbers(std::size_t n, std::uint64_t seed) {
  // The ends and the middle first, then random numbers.
  std::vector<S> u{S(0), one_minus_epsilon<S>, S(0.5), S(0.25), S(0.75)};
  Pcg random(seed);
  while (u.size() < n) u.push_back(random.uniform<S>());
  u.resize(n);
  return u;
}

template <class W> void expect_same_bits(const W& warp) {
  using S = typename W::Scalar;
  for (const std::size_t n : {0, 1, 63, 64, 65, 1000}) {
    const auto u0 = numbers<S>(n, 1), u1 = numbers<S>(n, 2);
    std::vector<S> x(n), y(n), z(n);
    if constexpr (std::tuple_size_v<PointColumns<W>> == 3) sample_n(warp, {u0, u1}, {x, y, z});
    else sample_n(warp, {u0, u1}, {x, y});
    for (std::size_t i = 0; i < n; ++i) {
      const PointOf<W> p = warp.sample({u0[i], u1[i]});
      ASSERT_EQ(x[i], p[0]) << i;
      ASSERT_EQ(y[i], p[1]) << i;
      if constexpr (std::tuple_size_v<PointColumns<W>> == 3) {
        ASSERT_EQ(z[i], p[2]) << i;
      }
    }
  }
}

template <class S> class SampleN : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SampleN, Scalars);

TYPED_TEST(SampleN, HasTheBitsOfSample) {
  using S = TypeParam;
  expect_same_bits(UniformDisk<S>{});
  expect_same_bits(UniformAnnulus<S>(S(0.5), S(2)));
  expect_same_bits(UniformSphere<S>{});
  expect_same_bits(UniformHemisphere<S>{});
  expect_same_bits(CosineHemisphere<S>{});
  for (const double angle : {1e-9, 0.3, 3.0}) expect_same_bits(UniformCone<S>::from_angle(S(angle)));
  for (const double g : {-0.9, 0.0, 0.9999}) expect_same_bits(HenyeyGreenstein<S>(S(g)));
  expect_same_bits(TrowbridgeReitzVisibleNormals<S>({S(0.6), S(0), S(0.8)}, S(0.2)));
}

TYPED_TEST(SampleN, TakesIntervalsToo) {
  using S = TypeParam;
  const Exponential<S> warp(S(2));
  const auto u = numbers<S>(100, 3);
  std::vector<S> x(100);
  sample_n(warp, {u}, {x});
  for (std::size_t i = 0; i < 100; ++i) ASSERT_EQ(x[i], warp.sample(u[i]));
}

TYPED_TEST(SampleN, MayOverwriteU) {
  using S = TypeParam;
  auto u0 = numbers<S>(200, 1), u1 = numbers<S>(200, 2);
  const auto v0 = u0, v1 = u1;
  sample_n(UniformDisk<S>{}, {u0, u1}, {u1, u0});
  for (std::size_t i = 0; i < 200; ++i) ASSERT_EQ(Vec2<S>(u1[i], u0[i]), UniformDisk<S>{}.sample({v0[i], v1[i]}));
}

TYPED_TEST(SampleN, RefusesArraysOfDifferentSizes) {
  using S = TypeParam;
  std::vector<S> four(4), five(5);
  EXPECT_THROW(sample_n(UniformDisk<S>{}, {four, five}, {four, four}), Error);
  EXPECT_THROW(sample_n(UniformDisk<S>{}, {four, four}, {four, five}), Error);
}

} // namespace
} // namespace mc

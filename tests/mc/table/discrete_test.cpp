#include <mc/table/discrete.h>

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>

#include <gtest/gtest.h>

#include <array>

namespace mc {
namespace {

template <class S> class DiscreteOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(DiscreteOver, Scalars);

// Statistical laws with alpha 1e-6 per case and fixed seeds.
template <class D> void expect_laws(const D& distribution) {
  static_assert(DiscreteDistribution<D>);
  const Report report =
      check_subject(make_discrete_subject("discrete", distribution), {.samples = 50'000, .seed = 3, .alpha = 1e-6});
  EXPECT_TRUE(report.passed()) << report.to_string();
  for (const auto u : {typename D::Scalar(0), one_minus_epsilon<typename D::Scalar>}) {
    const auto s = distribution.sample_index(u);
    EXPECT_LT(s.index, distribution.size());
    EXPECT_GT(s.pmf, 0);
    EXPECT_EQ(s.pmf, distribution.pmf(s.index));
    EXPECT_TRUE(s.u_remapped >= 0 && s.u_remapped < 1) << s.u_remapped;
  }
}

TYPED_TEST(DiscreteOver, UniformObeysItsLaws) {
  for (const std::size_t n : {1u, 2u, 3u, 10u, 1000u}) expect_laws(UniformDiscrete<TypeParam>(n));
}

// For every n up to 5000 and the largest n, the outcome of u is floor(u n), also at the last u. u_remapped lies in
// [0,1), and with the index it reproduces u.
TYPED_TEST(DiscreteOver, UniformIsExactForEveryN) {
  using S = TypeParam;
  Pcg random(4);
  const double eps = double(std::numeric_limits<S>::epsilon());
  const auto check = [&](std::size_t n, S u) {
    const auto s = UniformDiscrete<S>(n).sample_index(u);
    ASSERT_TRUE(s.index < n && s.u_remapped >= 0 && s.u_remapped < 1) << "n = " << n << ", u = " << u;
    ASSERT_LE(std::abs((double(s.index) + double(s.u_remapped)) / double(n) - double(u)), 2 * eps) << n;
  };
  for (std::size_t n = 1; n <= 5000; ++n) {
    check(n, S(0));
    check(n, one_minus_epsilon<S>);
    for (int k = 0; k < 20; ++k) check(n, random.uniform<S>());
  }
  check(1u << 24, one_minus_epsilon<S>);
}

TYPED_TEST(DiscreteOver, ShortObeysItsLaws) {
  using S = TypeParam;
  const S tiny = std::numeric_limits<S>::min(), huge = std::numeric_limits<S>::max() / 4;
  for (const std::vector<S>& weights : {std::vector<S>{1},
                                        {0, 0, 2, 0},
                                        {1, 2, 3, 4, 5, 6, 7, 8},
                                        {S(1e-3), 0, 20, S(0.5)},
                                        {tiny, 2 * tiny},
                                        {huge, huge}})
    expect_laws(ShortDiscrete<S, 8>(weights));
}

TYPED_TEST(DiscreteOver, ShortRefusesNonsense) {
  using S = TypeParam;
  const S inf = infinity<S>, nan = std::numeric_limits<S>::quiet_NaN(), max = std::numeric_limits<S>::max();
  for (const std::vector<S>& weights :
       {std::vector<S>{}, {0, 0}, {1, -1, 2}, {inf}, {1, nan}, {max, max}, {1, 1, 1, 1}})
    EXPECT_THROW((ShortDiscrete<S, 3>(weights)), Error);
}

TYPED_TEST(DiscreteOver, BernoulliObeysItsLaws) {
  using S = TypeParam;
  for (const double p : {0.0, 0.25, 0.3, 0.5, 0.999, 1.0}) expect_laws(Bernoulli<S>(S(p)));
  for (const S p : {std::numeric_limits<S>::denorm_min(), S(1e-30), one_minus_epsilon<S>}) {
    const Bernoulli<S> rare(p);
    for (const S u : {S(0), S(0.5), one_minus_epsilon<S>}) {
      const auto s = rare.sample_index(u);
      EXPECT_TRUE(s.pmf > 0 && s.u_remapped >= 0 && s.u_remapped < 1) << p << ' ' << u;
    }
  }
}

TEST(Discrete, RefusesNonsense) {
  EXPECT_THROW(UniformDiscrete<float>(0), Error);
  EXPECT_THROW(UniformDiscrete<float>((1u << 24) + 1), Error);
  for (const double p : {-0.1, 1.1, double(NAN)}) EXPECT_THROW(Bernoulli<double>{p}, Error);
}

} // namespace
TEST(ShortDiscrete, WeightsFarApartAndDenormal) {
  const mc::ShortDiscrete<float, 2> apart(std::array{1e-32f, 1e32f});
  EXPECT_EQ(apart.sample_index(0.0f).index, 1u);
  EXPECT_EQ(apart.pmf(0), 0);
  const mc::ShortDiscrete<double, 2> denormal(std::array{5e-324, 5e-324});
  EXPECT_EQ(denormal.sample_index(0.499).index, 0u);
  EXPECT_EQ(denormal.sample_index(0.5).index, 1u);
  EXPECT_EQ(denormal.pmf(0), 0.5);
}

} // namespace mc

#include <mc/estimate/mis.h>

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace {

template <class S> class Mis : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Mis, Scalars);

// Every pair and triple of these densities, every heuristic: the weights sum to 1 within (n + 2) eps.
TYPED_TEST(Mis, WeightsSumToOneOverTheWholeRange) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity();
  const std::vector<S> values = {S(0), std::numeric_limits<S>::denorm_min(), S(1e-30), S(1e-24), S(1), S(1e20), S(1e30), std::numeric_limits<S>::max(), inf};
  for (const S a : values)
    for (const S b : values)
      for (const S c : values)
        for (const S beta : {S(1), S(2), S(1.5), inf}) {
          const std::vector<S> p = {a, b, c}, n = {S(1), S(4), S(2)};
          S sum(0);
          for (std::size_t i = 0; i < 3; ++i) {
            const S w = mc::mis_weight<S>(i, p, n, beta);
            EXPECT_GE(w, S(0));
            EXPECT_LE(w, S(1));
            sum += w;
          }
          const S wanted = std::max({a, b, c}) > 0 ? S(1) : S(0);
          EXPECT_LE(std::abs(sum - wanted), 5 * std::numeric_limits<S>::epsilon()) << a << ' ' << b << ' ' << c << ' ' << beta;
        }
}

// pbrt's float power heuristic gives 0 or NaN where the square of a density leaves the range.
TYPED_TEST(Mis, PowerHeuristicWhereSquaresLeaveTheRange) {
  using S = TypeParam;
  EXPECT_EQ(mc::power_heuristic<S>(1, S(1e20), 1, S(1e20)), S(0.5));
  EXPECT_EQ(mc::power_heuristic<S>(1, S(1e-24), 1, S(1e-24)), S(0.5));
  EXPECT_EQ(mc::power_heuristic<S>(1, std::numeric_limits<S>::infinity(), 1, S(1)), S(1));
  EXPECT_NEAR(mc::power_heuristic<S>(1, S(3e-24), 1, S(1e-24)), S(0.9), S(1e-6));
}

TYPED_TEST(Mis, BalanceCountsSamples) {
  using S = TypeParam;
  EXPECT_NEAR(mc::balance_heuristic<S>(1, S(2), 3, S(2)), S(0.25), S(1e-6));
  EXPECT_EQ(mc::balance_heuristic<S>(0, S(2), 3, S(2)), S(0));
}

} // namespace

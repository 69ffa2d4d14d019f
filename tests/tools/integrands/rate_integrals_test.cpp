// The closed forms of the integrands for the table of rates.

#include <integrands/rate_integrals.h>
#include <sampling/sampling_methods.h>

#include <mc/random/hash.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

// 24 estimates with 4096 scrambled points: each of the 25 tests exceeds six standard errors with probability 1e-5.
TEST(RateIntegrals, StatedValuesAreCorrect) {
  EXPECT_EQ(carlo::rate_integrals().size(), 25u);
  for (const carlo::UnitCubeIntegral& e : carlo::rate_integrals()) {
    double sum = 0, squares = 0;
    constexpr int n = 24;
    for (std::uint64_t r = 0; r < n; ++r) {
      const double x = carlo::sampling_method("sobol").estimate(e, 4096, mc::hash(9, r)).value - e.truth;
      sum += x / n;
      squares += x * x / n;
    }
    const double error = std::sqrt((squares - sum * sum) / (n - 1));
    EXPECT_LE(std::abs(sum), 6 * error + 1e-13) << e.name;
    EXPECT_LE(error, 0.02 * e.truth) << e.name;
  }
}

} // namespace

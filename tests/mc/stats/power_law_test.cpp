#include <mc/core/error.h>
#include <mc/random/uniform.h>
#include <mc/stats/power_law.h>

#include <gtest/gtest.h>

#include <vector>

namespace {

TEST(RmsError, OfKnownEstimates) {
  const std::vector<double> estimates = {1, 3, 1, 3};
  const mc::RmsError e = mc::rms_error(16, estimates, 2);
  EXPECT_DOUBLE_EQ(e.rms, 1);
  EXPECT_LT(e.lo, 1);
  EXPECT_GT(e.hi, 1);
  EXPECT_THROW(mc::rms_error(16, std::vector<double>{1}, 0), mc::Error);
}

// Squares of these values would overflow or underflow.
TEST(RmsError, IsScaleFree) {
  const std::vector<double> estimates = {1, 3, 1, 4};
  const mc::RmsError one = mc::rms_error(16, estimates, 2);
  for (const int exponent : {-1000, -600, -300, 300, 600, 1000}) {
    std::vector<double> scaled;
    for (const double x : estimates) scaled.push_back(std::ldexp(x, exponent));
    const mc::RmsError e = mc::rms_error(16, scaled, std::ldexp(2, exponent));
    EXPECT_EQ(e.rms, std::ldexp(one.rms, exponent)) << exponent;
    EXPECT_EQ(e.lo, std::ldexp(one.lo, exponent)) << exponent;
    EXPECT_EQ(e.hi, std::ldexp(one.hi, exponent)) << exponent;
  }
  EXPECT_EQ(mc::rms_error(16, std::vector<double>{0, 0}, 0).rms, 0);
}

// One error in sixteen is not 0. Among 128 errors, 8 +- 2.7 are not 0, and an interval for normal errors would contain
// the truth only for 7 to 10. At coverage 90 %, fewer than 340 hits of 400 have probability 1e-3.
TEST(RmsError, IntervalHoldsTheErrorOfALongTail) {
  int hits = 0;
  for (std::uint64_t run = 0; run < 400; ++run) {
    std::vector<double> estimates(128);
    for (std::uint64_t r = 0; r < estimates.size(); ++r)
      estimates[r] = mc::hash_uniform<double>(run, r) < 1.0 / 16 ? 4 : 0;
    const mc::RmsError e = mc::rms_error(1, estimates, 0);
    hits += e.lo <= 1 && 1 <= e.hi;
  }
  EXPECT_GE(hits, 340);
}

TEST(RmsError, GivenKurtosisWidensTheInterval) {
  const std::vector<double> estimates = {1, 3, 1, 3, 1, 3, 1, 4};
  EXPECT_NEAR(mc::error_kurtosis(estimates, 2), 23 * 8 / 121.0, 1e-12); // seven errors of 1 and one of 2
  const mc::RmsError own = mc::rms_error(16, estimates, 2), same = mc::rms_error(16, estimates, 2, 1.5),
                     wide = mc::rms_error(16, estimates, 2, 9);
  EXPECT_EQ(own.hi, same.hi);
  EXPECT_EQ(own.rms, wide.rms);
  EXPECT_LT(wide.lo, own.lo);
  EXPECT_GT(wide.hi, own.hi);
  EXPECT_EQ(mc::effective_error_count(8, 3), 8);
  EXPECT_EQ(mc::effective_error_count(8, 9), 2);
  EXPECT_EQ(mc::effective_error_count(8, 1e9), 1);
}

TEST(PowerLaw, FindsAnExactOne) {
  std::vector<mc::RmsError> errors;
  for (double n = 16; n <= 4096; n *= 2) errors.push_back({n, 3 * std::pow(n, -0.75)});
  const mc::PowerLaw law = mc::fit_power_law(errors, 128);
  EXPECT_NEAR(law.slope, -0.75, 1e-12);
  EXPECT_NEAR(law.constant, 3, 1e-10);
  EXPECT_LE(law.lo, -0.75);
  EXPECT_GE(law.hi, -0.75);
}

// The error of means of N uniforms has slope -1/2. With 60 fits at 95 %, fewer than 50 hits have probability 1e-4.
TEST(PowerLaw, IntervalHoldsTheSlope) {
  int hits = 0;
  for (std::uint64_t run = 0; run < 60; ++run) {
    std::vector<mc::RmsError> errors;
    for (std::uint64_t n = 8; n <= 256; n *= 2) {
      std::vector<double> estimates(64);
      for (std::uint64_t r = 0; r < estimates.size(); ++r)
        for (std::uint64_t i = 0; i < n; ++i)
          estimates[r] += mc::hash_uniform<double>(run, n, r, i) / static_cast<double>(n);
      errors.push_back(mc::rms_error(static_cast<double>(n), estimates, 0.5));
    }
    const mc::PowerLaw law = mc::fit_power_law(errors, 64);
    hits += law.lo <= -0.5 && law.hi >= -0.5;
  }
  EXPECT_GE(hits, 50);
}

TEST(PowerLaw, RefusesTooLittle) {
  EXPECT_THROW(mc::fit_power_law(std::vector<mc::RmsError>{{1, 1}, {2, 1}}, 16), mc::Error);
  EXPECT_THROW(mc::fit_power_law(std::vector<mc::RmsError>{{1, 1}, {2, 0}, {4, 1}}, 16), mc::Error);
}

} // namespace

#include <mc/core/error.h>
#include <mc/estimate/values/histogram.h>

#include <mc/estimate/settings.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using support::with;
using Unit = std::span<const double>;

// A peak along x and a slope along y.
double f(Unit u) { return std::exp(-mc::sqr((u[0] - 0.42) / 0.05) / 2) * (1 + u[1]); }
double part(double lo, double hi) { // by the complements on the side of the bin, as differences of small numbers
  const double side = lo >= 0.4 ? 1 : -1;
  const auto beyond = [&](double x) { return std::erfc(side * (x - 0.42) / 0.05 / std::sqrt(2.0)); };
  return 1.5 * 0.05 * std::sqrt(mc::pi<double> / 2) * std::abs(beyond(hi) - beyond(lo));
}

// The total must have the same bits as without bins, and the parts must add up to it. The coverage of their intervals
// must be 93 to 97 %. The binomial deviation of 400 trials is .011, and parts of one run are dependent. A learned
// density leaves few points to the bins beyond the peak, where few values dominate.
TEST(Histogram, PartsOfAnIntegral) {
  for (const mc::Method method : support::all_methods) {
    int covered = 0, known = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const mc::IntegrateOptions o = with(method, 10'000, seed);
      const auto along_x = [](Unit u, double) { return static_cast<std::size_t>(u[0] * 10); };
      const mc::VectorIntegral r = mc::integrate_histogram(f, 2, 10, along_x, o);
      const mc::Integral alone = mc::integrate_unit(f, 2, o);
      EXPECT_EQ(r.outputs[0].estimate.value, alone.estimate.value) << name(method);
      EXPECT_EQ(r.outputs[0].estimate.std_error, alone.estimate.std_error) << name(method);
      EXPECT_EQ(r.outputs[0].calls, alone.calls) << name(method);
      double sum = 0;
      for (std::size_t k = 1; k <= 10; ++k) {
        const mc::Integral& p = r.outputs[k];
        const double truth = part(0.1 * static_cast<double>(k - 1), 0.1 * static_cast<double>(k));
        sum += p.estimate.value;
        if (p.error_bar != mc::ErrorBar::known) continue;
        ++known;
        covered += p.interval.lo <= truth && truth <= p.interval.hi;
      }
      EXPECT_NEAR(sum / alone.estimate.value, 1, 1e-12) << name(method);
    }
    EXPECT_GE(covered, 0.90 * known) << name(method);
    EXPECT_GE(known, method == mc::Method::vegas || method == mc::Method::tree ? 150 : 320) << name(method);
  }
}

TEST(Histogram, OctavesBelowTheTop) {
  EXPECT_EQ(mc::octave_bin(8, 100, 5), 0u);
  EXPECT_EQ(mc::octave_bin(8, -8, 5), 0u);
  EXPECT_EQ(mc::octave_bin(8, 7.99, 5), 1u);
  EXPECT_EQ(mc::octave_bin(8, 4, 5), 1u);
  EXPECT_EQ(mc::octave_bin(8, 3.99, 5), 2u);
  EXPECT_EQ(mc::octave_bin(8, 1e-9, 5), 4u);
  EXPECT_EQ(mc::octave_bin(8, 0, 5), 4u);
}

TEST(Histogram, RefusesNonsense) {
  const auto none = [](Unit, double) { return std::size_t{99}; };
  EXPECT_THROW(mc::integrate_histogram(f, 2, 0, none), mc::Error);
  EXPECT_THROW(mc::integrate_histogram(f, 2, 10, {}), mc::Error);
  const mc::VectorIntegral r = mc::integrate_histogram(f, 2, 3, none, with(mc::Method::rqmc, 1000, 1));
  EXPECT_EQ(r.outputs[1].error_bar, mc::ErrorBar::all_zero);
}

} // namespace

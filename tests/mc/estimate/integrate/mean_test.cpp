#include <mc/estimate/integrate/mean.h>
#include <mc/random/pcg.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace {

using mc::detail::Mean;
using mc::detail::mean_of_replicates;
using mc::detail::ReplicateHistory;

constexpr std::size_t replicates = 24;

mc::detail::IntegrandDiagnostics diagnostics_of(const std::vector<double>& values) {
  mc::detail::IntegrandDiagnostics m;
  m.values.add(values);
  return m;
}

TEST(Mean, WelchLiesBetweenTheSmallerAndTheSum) {
  EXPECT_DOUBLE_EQ(mc::detail::welch_dof({0, 1, 10}, {0, 1, 10}), 20);
  EXPECT_DOUBLE_EQ(mc::detail::welch_dof({0, 1, 10}, {0, 0, 3}), 10);
  EXPECT_DOUBLE_EQ(mc::detail::welch_dof({0, 0, 10}, {0, 0, 3}), 13);
  EXPECT_NEAR(mc::detail::welch_dof({0, 1e-300, 10}, {0, 1e-300, 10}), 20, 1e-9); // the squares would underflow
}

TEST(Mean, ZScoreIsThatOfANormal) {
  // Student's t with many degrees of freedom is normal.
  EXPECT_NEAR(mc::detail::z_score({0, std::sqrt(0.5), 1e9}, {2, std::sqrt(0.5), 1e9}).value(), 2, 1e-6);
  // 2.069 is the 97.5 % quantile for 23 degrees of freedom, 1.960 the normal one.
  EXPECT_NEAR(mc::detail::z_score({0, 1, 23}, {2.0687, 0, 23}).value(), 1.95996, 1e-4);
  EXPECT_FALSE(mc::detail::z_score({1, 0, 23}, {2, 0, 23}).has_value());
  EXPECT_LE(mc::detail::z_score({1, 1e-20, 23}, {1 + 1e-15, 0, 23}).value(), 1); // rounding is no disagreement
  EXPECT_FALSE(mc::detail::z_score({0, 0, 23, 0, mc::ErrorBar::all_zero}, {1, 1, 23}).has_value());
}

TEST(Mean, CombineIndependentPropagatesErrorAndSkew) {
  const Mean m = mc::detail::combine_independent({1, 3, 10, 0.2}, {2, 4, 10, 0}, 0.5);
  EXPECT_EQ(m.value, 1.5);
  EXPECT_DOUBLE_EQ(m.error, 2.5);
  EXPECT_DOUBLE_EQ(m.skew, 0.2 * std::pow(0.6, 3));
}

TEST(Mean, UnknownErrorBar_IntervalIsInfinite) {
  for (const auto bar : {mc::ErrorBar::all_zero, mc::ErrorBar::infinite_variance}) {
    const Mean m{1, 0.1, 23, 0, bar};
    EXPECT_EQ(mc::detail::estimate(m, 1).std_error, std::numeric_limits<double>::infinity());
    EXPECT_EQ(mc::detail::interval(m, 0.95).lo, -std::numeric_limits<double>::infinity());
  }
}

TEST(Mean, UnsampledTailBound_WidensTheIntervalOrMakesTheErrorUnknown) {
  const Mean met{-10, 0.1, 23}, little{-10, 0.1, 23, 0, mc::ErrorBar::known, -0.2},
      much{-10, 0.1, 23, 0, mc::ErrorBar::known, -2};
  const auto inside = mc::detail::interval(met, 0.95), beside = mc::detail::interval(little, 0.95);
  EXPECT_DOUBLE_EQ(beside.lo, inside.lo - 0.2); // only on the side of the bound
  EXPECT_EQ(beside.hi, inside.hi);
  EXPECT_EQ(mc::detail::estimate(little, 1).std_error, mc::detail::estimate(met, 1).std_error);
  EXPECT_NEAR(mc::detail::estimate(much, 1).std_error / mc::detail::estimate(met, 1).std_error, std::hypot(1, 20),
              1e-9);
  EXPECT_LT(mc::detail::interval(much, 0.95).lo, -14);
  const Mean most{-10, 0.1, 23, 0, mc::ErrorBar::known, -std::numeric_limits<double>::infinity()};
  EXPECT_EQ(most.reported_error_bar(), mc::ErrorBar::undersampled);
  EXPECT_EQ(mc::detail::interval(most, 0.95).hi, std::numeric_limits<double>::infinity());
}

// A density that follows only a part of the integrand: sixteen values fall off with an index of 1.
TEST(Mean, UnsampledTailBound_FewLargeValuesOfALearnedDensity_IsInfinite) {
  std::vector<double> values(5000, 1.0), volumes(5000, 1.0);
  for (int octave = 0; octave < 5; ++octave) // 1, 2, 4, 8, 16 values of 2048, 1024, ... 128
    for (int i = 0; i < 1 << octave; ++i)
      values[static_cast<std::size_t>((1 << octave) + i)] = -std::ldexp(2048.0, -octave);
  mc::detail::IntegrandDiagnostics baseline = diagnostics_of(values), learned = baseline;
  learned.tail.add(values, volumes);
  EXPECT_EQ(mc::detail::unsampled_tail_bound(baseline, 1), 0);
  const double largest = 2048.0 / 5000; // for a mean magnitude of 3
  EXPECT_EQ(mc::detail::unsampled_tail_bound(learned, largest), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(mc::detail::unsampled_tail_bound(learned, largest / 3), 0); // the replicates agree too well for such values
}

TEST(Mean, SkewOfAMean) {
  EXPECT_EQ(mc::detail::skewness(std::vector<double>{}), 0);
  EXPECT_EQ(mc::detail::skewness(std::vector<double>{3, 3, 3}), 0);
  for (const double scale : {-1e-200, 1.0, 1e200}) { // 0 0 0 4: mean 1, variance 4, third central moment 6
    const double skewness = mc::detail::skewness(std::vector<double>{0, 0, 0, 4 * scale});
    EXPECT_NEAR(skewness, std::copysign(6.0 / 8, scale), 1e-12);
  }
  EXPECT_NEAR(mc::detail::skew_of_mean(0.6, 1e6), 1e-4, 1e-8);
}

TEST(MeanOfReplicates, EqualReplicatesHaveAnError) {
  ReplicateHistory history;
  const std::vector<double> halves(replicates, 0.5);
  const Mean step = mean_of_replicates(halves, 64, diagnostics_of({0, 1, 1, 0}), history);
  EXPECT_DOUBLE_EQ(step.error, 0.75 / 64 / replicates);
  ReplicateHistory other;
  const Mean constant = mean_of_replicates(halves, 64, diagnostics_of({0.5, 0.5}), other);
  // The rule of three bounds the mass of unsampled regions with 95 % confidence: 3 / N, times the sampled size.
  const mc::Estimate::Interval i = mc::detail::interval(constant, 0.95);
  EXPECT_NEAR(i.hi - 0.5, 0.5 * 3 / (64 * replicates), 0.05 * (i.hi - 0.5));
  ReplicateHistory nothing;
  EXPECT_EQ(mean_of_replicates(std::vector<double>(replicates, 0.0), 64, diagnostics_of({0, 0}), nothing).error_bar,
            mc::ErrorBar::all_zero);
}

TEST(MeanOfReplicates, IdenticalReplicates_SetZeroSpread) {
  ReplicateHistory history;
  std::vector<double> means(replicates, 0.5);
  const Mean equal = mean_of_replicates(means, 64, diagnostics_of({0, 1}), history);
  EXPECT_TRUE(equal.zero_spread);
  means[3] += 0.01;
  const Mean apart = mean_of_replicates(means, 128, diagnostics_of({0, 1}), history);
  EXPECT_FALSE(apart.zero_spread);
  EXPECT_FALSE(
      mean_of_replicates(std::vector<double>(replicates, 0.5), 256, diagnostics_of({0, 1}), history).zero_spread);
  EXPECT_TRUE(mc::detail::combine_independent(equal, equal, 0.5).zero_spread);
  EXPECT_FALSE(mc::detail::combine_independent(equal, apart, 0.5).zero_spread);
}

// Steps of random heights at random places, plus a smooth part that soon becomes exact. Each replicate has either of
// two numbers of points beyond the step. If the place is close to a multiple of 1 / points, all replicates have the
// same number. A few runs remain far off, with steps that appeared at one length only.
TEST(MeanOfReplicates, RemembersAJumpThatReplicatesAgreeOn) {
  int beyond = 0;
  for (std::uint64_t run = 0; run < 2000; ++run) {
    mc::Pcg random(run);
    const double place = random.uniform<double>(), height = std::pow(10, -3 * random.uniform<double>());
    ReplicateHistory history;
    Mean m;
    for (double points = 16; points <= 16384; points *= 2) {
      std::vector<double> means;
      for (std::size_t r = 0; r < replicates; ++r)
        means.push_back(height * std::floor(place * points + random.uniform<double>()) / points +
                        (random.uniform<double>() - 0.5) * std::pow(points, -2.5));
      m = mean_of_replicates(means, points, diagnostics_of({0, 1}), history);
    }
    beyond += std::abs(m.value - height * place) > 10 * m.error;
  }
  EXPECT_LE(beyond, 4);
}

// A step of 4.4 with an integral of .009. The rounding error that separates equal replicates depends on the size of the
// values, not on the size of their mean.
TEST(MeanOfReplicates, RoundingByCancellationIsNotSpread) {
  ReplicateHistory history;
  std::vector<double> means(replicates, 0.009);
  for (std::size_t i = 0; i < replicates; i += 2) means[i] += 4e-16;
  const Mean m = mean_of_replicates(means, 1024, diagnostics_of({3, -1.4, -1.4}), history);
  EXPECT_NEAR(m.error, 0.75 * 4.4 / 1024 / replicates, 1e-9);
}

TEST(MeanOfReplicates, IdenticalAfterSpread_KeepsTheLastDeviation) {
  ReplicateHistory history;
  std::vector<double> means(replicates, 0.5);
  for (std::size_t i = 0; i < replicates; ++i) means[i] += 1e-13 * static_cast<double>(i);
  const double before = mean_of_replicates(means, 64, diagnostics_of({0, 0.5, 1}), history).error;
  EXPECT_LT(before, 2e-13);
  for (const double points : {128.0, 256.0})
    EXPECT_NEAR(
        mean_of_replicates(std::vector<double>(replicates, 0.5), points, diagnostics_of({0, 0.5, 1}), history).error,
        before, 1e-3 * before);
}

// With a heavy tail, the error combines two lengths, and replicates may agree at both.
TEST(MeanOfReplicates, IdenticalAfterSpread_HeavyTail_KeepsTheLastDeviation) {
  std::vector<double> values(4096);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = std::pow((static_cast<double>(i) + 0.5) / static_cast<double>(values.size()), -1.0 / 3);
  const mc::detail::IntegrandDiagnostics cube = diagnostics_of(values);
  ASSERT_LT(cube.tail_index(), 5);
  ReplicateHistory history;
  std::vector<double> means(replicates, 1.5);
  for (std::size_t i = 0; i < replicates; ++i) means[i] += 1e-9 * static_cast<double>(i);
  const double before = 1e-9 * std::sqrt((replicates + 1) / 12.0); // deviation of the mean of uniform numbers
  mean_of_replicates(means, 64, cube, history);
  for (const double points : {128.0, 256.0, 512.0, 1024.0})
    EXPECT_GE(mean_of_replicates(std::vector<double>(replicates, 1.5), points, cube, history).error, 0.7 * before)
        << points;
}

// For skewed replicates, the next length may have sampled no large value by chance.
TEST(MeanOfReplicates, SkewedReplicates_KeepTheLastDeviation) {
  for (const double size : {1.0, 0.01}) {
    ReplicateHistory history;
    std::vector<double> means(replicates, 1.0);
    means.back() = 1.01;
    for (std::size_t r = 0; r < replicates; ++r) means[r] += 1e-4 * static_cast<double>(r % 5);
    const mc::detail::IntegrandDiagnostics light = diagnostics_of({1, 1.5});
    const double before = mean_of_replicates(means, 64, light, history).error;
    for (double& x : means) x = 1 + size * (x - 1);
    EXPECT_GE(mean_of_replicates(means, 128, light, history).error, 0.5 * before) << size;
  }
}

// Share of 4000 intervals of 95 % that contain the exact value.
double covered(double index, const std::function<double(std::uint64_t, std::vector<double>&)>& draw) {
  mc::detail::IntegrandDiagnostics tail;
  for (std::uint64_t i = 1; i <= 20'000; ++i)
    tail.values.add(std::vector{index > 0 ? std::pow((static_cast<double>(i) - 0.5) / 20'000, -1 / index)
                                          : 1.0 + 1e-9 * static_cast<double>(i)});
  int hits = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    std::vector<double> means(replicates);
    const double truth = draw(i, means);
    ReplicateHistory history;
    const mc::Estimate::Interval interval = mc::detail::interval(mean_of_replicates(means, 1, tail, history), 0.95);
    hits += interval.lo <= truth && truth <= interval.hi;
  }
  return hits / 4000.0;
}

// The binomial deviation of 4000 trials is .0035. The required coverage is .93 to .97; the coverage depends on the
// shape of the distribution.
TEST(MeanOfReplicates, IntervalsCover) {
  const auto uniform = [](std::uint64_t i, std::size_t r) { return mc::hash_uniform<double>(8, i, r); };
  const double smooth = covered(0, [&](std::uint64_t i, std::vector<double>& x) {
    for (std::size_t r = 0; r < x.size(); ++r) x[r] = uniform(i, r);
    return 0.5;
  });
  EXPECT_GE(smooth, 0.93);
  EXPECT_LE(smooth, 0.97);
  for (const double index : {2.5, 3.3, 5.0, 10.0}) { // the corner cell of x^(-1/index)
    const double singular = covered(index, [&](std::uint64_t i, std::vector<double>& x) {
      for (std::size_t r = 0; r < x.size(); ++r) x[r] = std::pow(1 - uniform(i, r), -1 / index);
      return 1 / (1 - 1 / index);
    });
    EXPECT_GE(singular, 0.93) << index;
    EXPECT_LE(singular, 0.97) << index;
  }
}

// A jump of height 1 at a random place adds one point to a replicate or none: 24 trials of a random probability.
TEST(MeanOfReplicates, IntervalsCoverJumps) {
  int hits = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double p = mc::hash_uniform<double>(9, i);
    std::vector<double> means;
    for (std::uint64_t r = 0; r < replicates; ++r) means.push_back(mc::hash_uniform<double>(10, i, r) < p);
    ReplicateHistory history;
    const mc::Estimate::Interval interval =
        mc::detail::interval(mean_of_replicates(means, 1, diagnostics_of({0, 1}), history), 0.95);
    hits += interval.lo <= p && p <= interval.hi;
  }
  EXPECT_GE(hits / 4000.0, 0.93);
  EXPECT_LE(hits / 4000.0, 0.975);
}

} // namespace

#include <mc/estimate/integrate/error_bar.h>
#include <mc/random/pcg.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace {

using mc::detail::Mean;
using mc::detail::mean_of_replicates;
using mc::detail::SpreadHistory;

constexpr std::size_t replicates = 16;
constexpr double infinity = std::numeric_limits<double>::infinity();

mc::SampledValues sampled(const std::vector<double>& values) {
  mc::SampledValues s;
  s.averaged.add(values);
  return s;
}

Mean mean_at(const std::vector<double>& means, double points, const mc::SampledValues& values, SpreadHistory& history) {
  return mean_of_replicates(means, points, values, 1, history);
}

TEST(ErrorBar, NormalDeviateOfADifference) {
  const auto mean = [](double value, double error, double dof) {
    return Mean{.value = value, .error = error, .dof = dof};
  };
  EXPECT_NEAR(mc::detail::normal_deviate(mean(0, std::sqrt(0.5), 1e9), mean(2, std::sqrt(0.5), 1e9)).value(), 2, 1e-6);
  // 2.069 is the 97.5 % quantile for 23 degrees of freedom, 1.960 the normal one.
  EXPECT_NEAR(mc::detail::normal_deviate(mean(0, 1, 23), mean(2.0687, 0, 23)).value(), 1.95996, 1e-4);
  EXPECT_FALSE(mc::detail::normal_deviate(mean(1, 0, 23), mean(2, 0, 23)).has_value());
  EXPECT_LE(mc::detail::normal_deviate(mean(1, 1e-20, 23), mean(1 + 1e-15, 0, 23)).value(), 1); // rounding
  Mean unknown = mean(0, 1, 23);
  unknown.bar = mc::ErrorBar::undersampled;
  EXPECT_FALSE(mc::detail::normal_deviate(unknown, mean(1, 1, 23)).has_value());
}

TEST(ErrorBar, CombineIndependentPropagatesErrorAndSkew) {
  const Mean a{.value = 1, .error = 3, .dof = 10, .skew = 0.2}, b{.value = 2, .error = 4, .dof = 10};
  const Mean m = mc::detail::combine_independent(a, b, 0.5);
  EXPECT_EQ(m.value, 1.5);
  EXPECT_DOUBLE_EQ(m.error, 2.5);
  EXPECT_DOUBLE_EQ(m.skew, 0.2 * std::pow(0.6, 3));
}

TEST(ErrorBar, UnknownError_IntervalIsInfinite) {
  for (const auto bar : {mc::ErrorBar::all_zero, mc::ErrorBar::undersampled, mc::ErrorBar::too_few_points,
                         mc::ErrorBar::infinite_variance, mc::ErrorBar::not_integrable}) {
    const Mean m{.value = 1, .error = 0.1, .dof = 15, .bar = bar};
    EXPECT_EQ(mc::detail::estimate(m, 1).std_error, infinity);
    EXPECT_EQ(mc::detail::interval(m, 0.95).lo, -infinity);
    EXPECT_TRUE(std::isfinite(mc::detail::half_width(m)));
  }
}

// Each correction lengthens one side.
TEST(ErrorBar, IntervalIsStudentsTWithItsCorrections) {
  const Mean plain{.value = 10, .error = 1, .dof = 15};
  const mc::Estimate::Interval t = mc::detail::interval(plain, 0.95);
  EXPECT_NEAR(t.hi, 10 + 2.13145, 1e-4);
  EXPECT_NEAR(t.lo, 10 - 2.13145, 1e-4);
  EXPECT_NEAR(mc::detail::estimate(plain, 7).std_error, 1.0345, 1e-3); // the 68.27 % quantile of t
  Mean skewed = plain, tailed = plain;
  skewed.skew = 0.1;
  tailed.tail = {0.5, 0};
  EXPECT_EQ(mc::detail::interval(skewed, 0.95).lo, t.lo);
  EXPECT_NEAR(mc::detail::interval(skewed, 0.95).hi, t.hi + 0.1 * (1 + 2 * 2.13145 * 2.13145), 1e-3);
  EXPECT_EQ(mc::detail::interval(tailed, 0.95).hi, t.hi);
  EXPECT_NEAR(mc::detail::interval(tailed, 0.95).lo, t.lo - 0.5 * 3.6889, 1e-3);
}

// Replicates that never differed may do so by one jump. The bound for a constant is the rule of three.
TEST(MeanOfReplicates, EqualReplicatesHaveAnError) {
  SpreadHistory history, other, nothing;
  const std::vector<double> halves(replicates, 0.5);
  EXPECT_DOUBLE_EQ(mean_at(halves, 64, sampled({0, 1, 1, 0}), history).error, 1.5 / 64 / replicates);
  const Mean constant = mean_at(halves, 64, sampled({0.5, 0.5}), other);
  EXPECT_TRUE(constant.constant);
  EXPECT_NEAR(mc::detail::interval(constant, 0.95).hi - 0.5, 0.5 * 3 / (64 * replicates), 0.1 * 0.5 * 3 / (64 * 16));
  EXPECT_EQ(mean_at(std::vector<double>(replicates, 0.0), 64, sampled({0, 0}), nothing).bar, mc::ErrorBar::all_zero);
}

// The sum of the values overflows, their mean does not.
TEST(MeanOfReplicates, HugeValuesHaveAnError) {
  SpreadHistory history;
  std::vector<double> means(replicates, 1e308);
  means[0] = 1.01e308;
  const Mean m = mean_at(means, 64, sampled({0.9e308, 1e308, 1.1e308}), history);
  EXPECT_NEAR(m.error, 1e306 / std::pow(replicates, 1.0), 1e302);
  EXPECT_EQ(m.bar, mc::ErrorBar::known);
}

// The tail index is that of the shape that decides: the median of the last three.
TEST(MeanOfReplicates, TailIndexIsTheOneThatDecides) {
  mc::Pcg random(1);
  std::vector<double> values(4096);
  for (double& x : values) x = random.uniform<double>(); // a bounded tail
  SpreadHistory history;
  history.points = {16, 32};
  history.spreads = {1, 1};
  history.shapes = {{0, 0.8}, {0, 0.9}};
  history.contributions = {std::vector<double>{0, 0}, std::vector<double>{0, 0}};
  std::vector<double> means(replicates, 0.5);
  means[0] = 0.51;
  const Mean m = mean_at(means, 64, sampled(values), history);
  EXPECT_EQ(m.bar, mc::ErrorBar::infinite_variance);
  EXPECT_DOUBLE_EQ(m.tail_index, 1 / 0.8);
}

// A step of 4.4 with an integral of .009. The rounding error that separates equal replicates depends on the size of the
// values, not on the size of their mean.
TEST(MeanOfReplicates, RoundingByCancellationIsNotSpread) {
  SpreadHistory history;
  std::vector<double> means(replicates, 0.009);
  for (std::size_t i = 0; i < replicates; i += 2) means[i] += 4e-16;
  EXPECT_NEAR(mean_at(means, 1024, sampled({3, -1.4, -1.4}), history).error, 1.5 * 4.4 / 1024 / replicates, 1e-9);
}

// Steps of random heights at random places, plus a smooth part that soon becomes exact. Each replicate has either of
// two numbers of points beyond the step. If the place is close to a multiple of 1 / points, all replicates agree.
TEST(MeanOfReplicates, RemembersAJumpThatReplicatesAgreeOn) {
  int beyond = 0;
  for (std::uint64_t run = 0; run < 2000; ++run) {
    mc::Pcg random(run);
    const double place = random.uniform<double>(), height = std::pow(10, -3 * random.uniform<double>());
    SpreadHistory history;
    Mean m;
    for (double points = 64; points <= 16384; points *= 2) {
      std::vector<double> means;
      for (std::size_t r = 0; r < replicates; ++r)
        means.push_back(height * std::floor(place * points + random.uniform<double>()) / points +
                        (random.uniform<double>() - 0.5) * std::pow(points, -2.5));
      m = mean_at(means, points, sampled({0, 1}), history);
    }
    beyond += std::abs(m.value - height * place) > 10 * m.error;
  }
  EXPECT_LE(beyond, 100); // 95 % intervals may miss twenty times as far
}

// Share of 4000 intervals of 95 % that contain the exact value.
double covered(const std::function<double(std::uint64_t, std::vector<double>&)>& draw) {
  int hits = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    std::vector<double> means(replicates);
    const double truth = draw(i, means);
    SpreadHistory history;
    const mc::Estimate::Interval interval = mc::detail::interval(mean_at(means, 1, sampled(means), history), 0.95);
    hits += interval.lo <= truth && truth <= interval.hi;
  }
  return hits / 4000.0;
}

// The binomial deviation of 4000 trials is .0035.
TEST(MeanOfReplicates, IntervalsCover) {
  const auto uniform = [](std::uint64_t i, std::size_t r) { return mc::hash_uniform<double>(8, i, r); };
  const double even = covered([&](std::uint64_t i, std::vector<double>& x) {
    for (std::size_t r = 0; r < x.size(); ++r) x[r] = uniform(i, r);
    return 0.5;
  });
  EXPECT_GE(even, 0.935);
  EXPECT_LE(even, 0.98);
  for (const double index : {2.5, 3.3, 5.0, 10.0}) { // the corner cell of x^(-1/index)
    const double singular = covered([&](std::uint64_t i, std::vector<double>& x) {
      for (std::size_t r = 0; r < x.size(); ++r) x[r] = std::pow(1 - uniform(i, r), -1 / index);
      return 1 / (1 - 1 / index);
    });
    EXPECT_GE(singular, 0.92) << index;
    EXPECT_LE(singular, 0.99) << index;
  }
}

// A heavy tail is named only if most of the last lengths show it.
TEST(Judge, NamesWhatTheValuesShow) {
  using Shapes = std::vector<std::array<double, 2>>;
  std::vector<double> even(4096), few(4096, 0.001), one(4096, 0.0);
  for (std::size_t i = 0; i < even.size(); ++i) even[i] = 1 + static_cast<double>(i % 7);
  for (std::size_t i = 0; i < 8; ++i) few[i] = 100;
  one[17] = 1;
  const auto judge = [](const std::vector<double>& values, const Shapes& shapes, int dim, double above = 0) {
    return mc::detail::judge(sampled(values).averaged, {0, above}, shapes, dim);
  };
  EXPECT_EQ(judge(even, {}, 3), mc::ErrorBar::known);
  EXPECT_EQ(judge(few, {}, 3), mc::ErrorBar::undersampled);
  EXPECT_EQ(judge(one, {}, 3), mc::ErrorBar::undersampled);
  EXPECT_EQ(judge(even, {}, 3, 3), mc::ErrorBar::known);
  EXPECT_EQ(judge(even, {}, 3, 5), mc::ErrorBar::undersampled); // the mean is 4
  EXPECT_EQ(judge({0, 0, 0}, {}, 3), mc::ErrorBar::all_zero);
  const Shapes heavy(3, {-1, 0.8}), once = {{-1, 0.2}, {-1, 0.2}, {-1, 0.8}}, worst(3, {1.5, -1});
  EXPECT_EQ(judge(even, heavy, 3), mc::ErrorBar::infinite_variance);
  EXPECT_EQ(judge(even, once, 3), mc::ErrorBar::known);
  EXPECT_EQ(judge(even, worst, 3), mc::ErrorBar::not_integrable);
  // The variance is infinite from a shape of 1/2 on, the integral from 1 on; fitted shapes err.
  EXPECT_EQ(judge(even, Shapes(3, {-1, 0.65}), 3), mc::ErrorBar::known);
  EXPECT_EQ(judge(even, Shapes(3, {0.75, -1}), 3), mc::ErrorBar::infinite_variance);
  EXPECT_EQ(judge(even, Shapes(3, {-1, 0.95}), 3), mc::ErrorBar::infinite_variance);
  EXPECT_EQ(judge(even, Shapes(3, {-1, 0.99}), 3), mc::ErrorBar::not_integrable);
  EXPECT_EQ(judge(even, Shapes(2, {-1, 0.8}), 3), mc::ErrorBar::known); // too few lengths
  std::vector<double> sixteen(4096, 0.001);
  std::fill_n(sixteen.begin(), 17, 100.0);
  EXPECT_EQ(judge(sixteen, {}, 3), mc::ErrorBar::known);
  EXPECT_EQ(judge(even, heavy, 13), mc::ErrorBar::too_few_points); // 4096 points cannot fill 2^13 corners
}

} // namespace

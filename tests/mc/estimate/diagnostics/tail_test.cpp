#include <mc/estimate/diagnostics/tail.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace {

// Values f(u) of independent u.
mc::Extremes extremes(std::uint64_t seed, std::size_t n, const std::function<double(double)>& f) {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < n; ++i) values.push_back(f(mc::hash_uniform<double>(seed, i)));
  mc::Extremes e;
  e.add(values);
  return e;
}

double mean_shape(const std::function<double(double)>& f, std::size_t k) {
  double sum = 0;
  constexpr int runs = 200;
  for (std::uint64_t seed = 1; seed <= runs; ++seed)
    sum += mc::fit_tail(extremes(seed, 10'000, f).largest(k + 1)).shape;
  return sum / runs;
}

// The deviation of a fit to k values is about (1 + shape) / sqrt(k), that of 200 fits to 200 values below .01.
TEST(FitTail, ShapeOfAPowerLaw) {
  for (const double shape : {0.1, 0.3, 0.5, 0.7, 0.95})
    EXPECT_NEAR(mean_shape([&](double u) { return std::pow(u, -shape); }, 200), shape, 0.06) << shape;
}

TEST(FitTail, BoundedAndExponentialTailsHaveNoPositiveShape) {
  EXPECT_LT(mean_shape([](double u) { return 1 - u; }, 200), -0.5);
  EXPECT_NEAR(mean_shape([](double u) { return -std::log(u); }, 200), 0, 0.06);
}

TEST(FitTail, DoesNotDependOnLocationAndScale) {
  const auto power = [](double u) { return std::pow(u, -0.6); };
  const mc::TailFit plain = mc::fit_tail(extremes(3, 5000, power).largest(101));
  for (const double scale : {1e-200, 1.0, 1e200}) {
    const mc::TailFit scaled = mc::fit_tail(extremes(3, 5000, [&](double u) { return scale * power(u); }).largest(101));
    EXPECT_NEAR(scaled.shape, plain.shape, 1e-9);
    EXPECT_NEAR(scaled.largest_excess / scale, plain.largest_excess, 1e-9 * plain.largest_excess);
  }
  const mc::TailFit raised = mc::fit_tail(extremes(3, 5000, [&](double u) { return 300 + power(u); }).largest(101));
  EXPECT_NEAR(raised.shape, plain.shape, 1e-9);
}

TEST(FitTail, TooFewValues_IsEmpty) { EXPECT_EQ(mc::fit_tail(std::vector<double>{3, 2, 1}).values, 0u); }

// Many values that equal the largest are an upper bound.
TEST(FitTail, EqualValues_AreBounded) {
  EXPECT_EQ(mc::fit_tail(std::vector<double>(50, 2.0)).shape, -std::numeric_limits<double>::infinity());
  mc::Extremes plateau; // a small box on a smooth function
  std::vector<double> values(10'000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = i < 40 ? 1000.0 : static_cast<double>(i % 100);
  plateau.add(values);
  EXPECT_LT(mc::find_tail(plateau, mc::TailSide::largest).shape, 0);
}

// A fortieth of the values, but at least 16 and at most 250; the deep tail is a quarter of them.
TEST(FindTail, ThresholdFollowsTheNumberOfValues) {
  const auto power = [](double u) { return std::pow(u, -0.4); };
  const std::pair<std::size_t, std::size_t> numbers[] = {
      {200, 16}, {640, 16}, {4000, 100}, {10'000, 250}, {90'000, 250}};
  for (const auto& [count, values] : numbers) {
    const mc::Tail tail = mc::find_tail(extremes(5, count, power), mc::TailSide::largest);
    EXPECT_EQ(tail.fit.values, values) << count;
    EXPECT_EQ(tail.deep.values, values / 4 < 16 ? 0 : values / 4) << count;
  }
}

// Every threshold sees the same power law.
TEST(FindTail, HeavyTailIsHeavyAtAllThresholds) {
  int heavy = 0, light = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const mc::Extremes up = extremes(seed, 20'000, [](double u) { return std::pow(u, -0.8); }),
                       down = extremes(seed, 20'000, [](double u) { return -std::pow(u, -0.8); }),
                       moderate = extremes(seed, 20'000, [](double u) { return std::pow(u, -0.25); });
    heavy += mc::find_tail(up, mc::TailSide::largest).shape > 0.5;
    EXPECT_EQ(mc::find_tail(up, mc::TailSide::largest).shape, mc::find_tail(down, mc::TailSide::smallest).shape);
    EXPECT_LT(mc::find_tail(up, mc::TailSide::smallest).shape, 0);
    light += mc::find_tail(moderate, mc::TailSide::largest).shape > 0.5;
  }
  EXPECT_GE(heavy, 80);
  EXPECT_LE(light, 3);
}

// The flank of a narrow Gaussian is steep over decades, and its top is bounded.
TEST(FindTail, PeakIsNoHeavyTail) {
  int heavy = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const mc::Extremes peak =
        extremes(seed, 20'000, [](double u) { return std::exp(-std::pow((u - 0.3) / 0.002, 2)); });
    heavy += mc::find_tail(peak, mc::TailSide::largest).shape > 0.5;
  }
  EXPECT_LE(heavy, 5);
}

TEST(UpperShape, LiesAboveByItsDeviation) {
  mc::TailFit fit;
  fit.shape = 0.4;
  fit.values = 225;
  EXPECT_DOUBLE_EQ(mc::upper_shape(fit), 0.5);
}

// The largest N values of a Pareto distribution are near (i / N)^-xi, and those beyond the first add
// N int_0^(1/N) (p^-xi - N^xi) dp = N^xi xi / (1 - xi) to their sum.
TEST(ExcessBeyond, OfAParetoDistribution) {
  for (const double shape : {0.2, 0.5, 0.7}) {
    std::vector<double> values;
    for (int i = 1; i <= 4000; ++i) values.push_back(std::pow(i / 4000.0, -shape));
    mc::Extremes e;
    e.add(values);
    const mc::Tail tail = mc::find_tail(e, mc::TailSide::largest);
    const double expected = std::pow(4000.0, shape) * shape / (1 - shape), found = mc::excess_beyond(tail);
    EXPECT_GE(found, expected) << shape; // the shape is the upper end of its interval
    EXPECT_LE(found, 4 * expected) << shape;
    EXPECT_LE(mc::excess_beyond(tail, mc::infinity<double>, {.max_shape = 0.5}), tail.fit.largest_excess);
  }
}

TEST(ExcessBeyond, OfABoundedTailIsZero) {
  std::vector<double> values;
  for (int i = 0; i < 4000; ++i) values.push_back(i);
  mc::Extremes e;
  e.add(values);
  EXPECT_EQ(mc::excess_beyond(mc::find_tail(e, mc::TailSide::largest)), 0);
  EXPECT_EQ(mc::excess_beyond({}), 0);
}

// All of N values lie below a value that is exceeded with probability c / N with probability exp(-c).
TEST(TailExtension, LengthFollowsTheConfidence) {
  EXPECT_NEAR(mc::tail_extension(0.025), 3.6889, 1e-4);
  EXPECT_NEAR(std::pow(1 - 3.6889 / 1e6, 1e6), 0.025, 1e-5);
}

} // namespace

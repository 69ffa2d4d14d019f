#include <mc/estimate/integrate/sequences.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

namespace detail = mc::detail;
using mc::detail::Sequences;

const std::function<double(std::span<const double>)> exponential = [](std::span<const double> u) {
  return std::exp(u[0] + u[1] * u[2]);
};

TEST(Sequences, GrowToTheSameSums) {
  mc::IntegrateOptions o;
  o.replicates = 5;
  detail::Run run{{.one = &exponential}, 1, 3, o};
  Sequences steps{.purpose = 0, .count = 5}, once{.purpose = 0, .count = 5};
  steps.extend(run, 64);
  steps.extend(run, 128);
  const auto grown = steps.extend(run, 1024), at_once = once.extend(run, 1024);
  EXPECT_NEAR(grown[0].value, at_once[0].value, 1e-14);
  EXPECT_NEAR(grown[0].error, at_once[0].error, 1e-2 * at_once[0].error);
  EXPECT_EQ(steps.history.size(), 3u);
  EXPECT_EQ(steps.widen(run, 3)[0].dof, 7);
  EXPECT_EQ(run.calls, 5u * 1024 + 5u * 1024 + 3u * 1024);
}

// Some twice as long, the rest let go.
TEST(Sequences, KeepSome) {
  double squares = 0, errors = 0;
  constexpr int runs = 200;
  const double truth = std::expm1(1.0) * 1.317902151454404; // (e - 1) and the sum of 1 / (k! (k + 1)^2)
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    mc::IntegrateOptions o;
    o.seed = seed;
    detail::Run run{{.one = &exponential}, 1, 3, o};
    Sequences s{.purpose = 0, .count = 24};
    s.extend(run, 64);
    s.keep(20);
    const auto longer = s.extend(run, 128);
    ASSERT_EQ(run.calls, 24u * 64 + 20u * 64);
    ASSERT_EQ(longer[0].dof, 19);
    squares += mc::sqr(longer[0].value - truth) / runs;
    errors += mc::sqr(longer[0].error) / runs;
  }
  EXPECT_NEAR(errors / squares, 1, 0.4); // 200 squares of a normal know their mean to 10 %, the errors theirs to 3 %
}

// What the others saw of a heavy tail is not forgotten with them.
TEST(Sequences, RememberTheTailOfThoseLetGo) {
  const std::function<double(std::span<const double>)> heavy = [](std::span<const double> u) {
    return std::pow(1 - u[0], -0.9);
  };
  mc::IntegrateOptions o;
  detail::Run run{{.one = &heavy}, 1, 1, o};
  Sequences s{.purpose = 0, .count = 24};
  s.extend(run, 4096);
  const mc::Magnitudes before = s.seen()[0].values;
  ASSERT_EQ(s.means[0].bar, mc::ErrorBar::infinite_variance);
  s.keep(12);
  const detail::Mean after = s.extend(run, 8192)[0];
  EXPECT_EQ(s.seen()[0].values.count(), 24u * 4096 + 12u * 4096);
  EXPECT_GE(s.seen()[0].values.hi(), before.hi());
  EXPECT_EQ(after.bar, mc::ErrorBar::infinite_variance);
  EXPECT_EQ(after.dof, 11);
}

TEST(Sequences, FallIsThatOfTheVariance) {
  Sequences s{.purpose = 0, .count = 24};
  s.history.push_back({{0, 1, 23}});
  EXPECT_EQ(detail::fall(s), 0);
  for (const double v : {1.0, 0.25, 0.0625, 0.0625 / 4}) s.history.push_back({{0, std::sqrt(v), 23}});
  EXPECT_NEAR(detail::fall(s), std::log(4.0), 1e-12); // of the last three doublings
}

// Replicates of equal size whose means have so much less variance than independent points would give them: `gain` is
// the logarithm of that.
Sequences gaining(double deviation, double gain, std::uint32_t count = 12) {
  Sequences s{.purpose = 0, .count = count, .length = 256};
  s.sums.resize(count, detail::Sums{std::vector<detail::ScaledMoments>(1), std::vector<detail::Seen>(1)});
  for (std::uint32_t r = 0; r < count; ++r) {
    std::vector<double> values(256);
    for (std::size_t i = 0; i < 256; ++i) values[i] = i % 2 == 0 ? deviation : -deviation;
    s.sums[r].outputs[0].add(values, 0, deviation);
  }
  s.history.push_back({{1, deviation / 16 / std::sqrt(count) * std::exp(-gain / 2), count - 1.0}});
  return s;
}

// Where nothing is gained the points decide, whatever the replicates say, and however many these are; and what is
// expected of the next doublings is part of a ninth of .4, as these gained nothing in eight.
TEST(Sequences, AdvantageOfPointsThatGainNothing) {
  const Sequences wide = gaining(0.1, 0), narrow = gaining(0.05, 0), lucky = gaining(0.1, 0.5),
                  few = gaining(0.05, 0, 8);
  EXPECT_NEAR(detail::advantage(wide, narrow, 5, 0), std::log(4), 1e-2);
  EXPECT_NEAR(detail::advantage(narrow, wide, 5, 0), -std::log(4), 1e-2);
  EXPECT_NEAR(detail::advantage(wide, few, 5, 0), std::log(4), 1e-2);
  EXPECT_LT(std::abs(detail::advantage(wide, lucky, 5, 0)), 0.05);
  EXPECT_NEAR(detail::advantage(wide, narrow, 5, 0.6), std::log(4) - 3 * 0.4 / 9, 1e-2);
}

// Where much is gained the replicates decide; and what gained fast will.
TEST(Sequences, AdvantageOfPointsThatGainMuch) {
  const Sequences slow = gaining(0.01, 4), fast = gaining(0.01, 8), half = gaining(0.01, 1.4);
  EXPECT_NEAR(detail::advantage(slow, fast, 0, 0.6), 4, 0.2);
  EXPECT_NEAR(detail::advantage(fast, slow, 0, 0.6), -4, 0.2);
  EXPECT_NEAR(detail::advantage(fast, slow, 5, 0.6), detail::advantage(fast, slow, 0, 0.6) - 3 * 8.4 / 9, 1e-3);
  EXPECT_NEAR(detail::advantage(half, slow, 5, 0.6), detail::advantage(half, slow, 0, 0.6) - 3 * 1.8 / 9, 1e-2);
}

TEST(Sequences, WidenedOnesSayWhatAllOfThemSaw) {
  const std::function<double(std::span<const double>)> f = [](std::span<const double> u) { return u[0] * u[0]; };
  mc::IntegrateOptions o;
  detail::Run run{{.one = &f}, 1, 1, o};
  Sequences half{.purpose = 0, .count = 12}, all{.purpose = 0, .count = 24};
  half.extend(run, 64);
  all.extend(run, 64);
  EXPECT_EQ(half.widen(run, 12)[0].error, all.means[0].error);
  EXPECT_EQ(half.count, 24u);
  ASSERT_EQ(half.history.size(), 1u);
  EXPECT_EQ(half.history[0][0].error, all.means[0].error);
}

// A uniform part that is an eighth as long as the other has most of the variance, whatever the unit, and less once it
// is as dense.
TEST(Sequences, TheUniformPartMayBecomeDenser) {
  for (const double unit : {1.0, 1e-300, 1e300}) {
    const std::function<double(std::span<const double>)> f = [&](std::span<const double> u) {
      return unit * std::exp(u[0] * u[1] - u[0]);
    };
    mc::IntegrateOptions o;
    detail::Run run{{.one = &f}, 1, 2, o};
    std::vector<double> edges;
    for (int axis = 0; axis < 2; ++axis)
      for (std::size_t i = 0; i <= mc::ImportanceGrid::bins; ++i)
        edges.push_back(std::pow(static_cast<double>(i) / mc::ImportanceGrid::bins, 1.2));
    const auto density = std::make_shared<mc::AdaptedDensity>(mc::AdaptedDensity{mc::ImportanceGrid(std::move(edges))});
    Sequences s{.purpose = 1, .count = 24, .proposal = {density, {0.7 * unit}}};
    EXPECT_EQ(s.uniform_variance(), 0);
    s.extend(run, 128);
    EXPECT_EQ(s.calls_each(), 128u + 16u);
    const double sparse = s.uniform_variance();
    s.sparse = 1;
    const detail::Mean mean = s.extend(run, 256)[0];
    EXPECT_EQ(s.calls_each(), 512u);
    EXPECT_EQ(run.calls, 24u * 512);
    EXPECT_GT(sparse, 0.5);
    EXPECT_LT(s.uniform_variance(), 0.5 * sparse);
    EXPECT_LE(std::abs(mean.value / unit - 0.7965995992970531), 5 * mean.error / unit);
    s.widen(run, 2);
    EXPECT_EQ(run.calls, 26u * 512);
  }
}

// Ten times the error, but a hundredth of the relative one: the other has met next to nothing of the integrand.
TEST(Sequences, WhoMetNothingIsNotAhead) {
  const mc::detail::Means nothing = {{1e-4, 1e-4, 23}}, much = {{1, 1e-3, 23}}, like_it = {{1.0001, 1e-4, 23}};
  EXPECT_LT(mc::detail::log_ratio(much, nothing), -10);
  EXPECT_NEAR(mc::detail::log_ratio(much, like_it), std::log(100), 1e-9);
  EXPECT_GT(mc::detail::doubt({{1, 1, 23, 0.2}}), mc::detail::doubt(much) + 0.45);
  EXPECT_TRUE(mc::detail::apart(much, nothing));
  EXPECT_FALSE(mc::detail::apart(much, like_it));
}

// Half of the value with a fiftieth of its error: what it has not met it is off by.
TEST(Sequences, WhoMetLessIsNotAhead) {
  const mc::detail::Means less = {{0.5, 1e-3, 23}}, much = {{1, 0.05, 23}};
  EXPECT_TRUE(mc::detail::apart(much, less));
  EXPECT_LT(mc::detail::log_ratio(much, less), -4);
  EXPECT_NEAR(mc::detail::log_ratio(less, much), -mc::detail::log_ratio(much, less), 1e-12);
}

TEST(Sequences, AnErrorThatOnlyOthersKnowSaysLess) {
  const detail::Mean known{1, 0.1, 23}, unknown{1e-4, 1e-4, 23, 0, mc::ErrorBar::infinite_variance};
  EXPECT_TRUE(mc::detail::sees_less({known, unknown}, {known, known}));
  EXPECT_FALSE(mc::detail::sees_less({unknown}, {unknown}));
  EXPECT_FALSE(mc::detail::sees_less({known}, {unknown}));
  EXPECT_FALSE(mc::detail::sees_less({known, unknown}, {unknown, known}));
}

} // namespace

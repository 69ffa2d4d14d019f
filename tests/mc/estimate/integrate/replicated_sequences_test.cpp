#include <mc/estimate/integrate/replicated_sequences.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

namespace detail = mc::detail;
using mc::detail::ReplicatedSequences;

const std::function<double(std::span<const double>)> exponential = [](std::span<const double> u) {
  return std::exp(u[0] + u[1] * u[2]);
};

TEST(ReplicatedSequences, ExtendingInStepsGivesTheSameSums) {
  mc::IntegrateOptions o;
  o.replicates = 5;
  detail::IntegrationRun run{{.one = &exponential}, 1, 3, o};
  ReplicatedSequences steps{.stream_id = 0, .count = 5}, once{.stream_id = 0, .count = 5};
  steps.extend(run, 64);
  steps.extend(run, 128);
  const auto grown = steps.extend(run, 1024), at_once = once.extend(run, 1024);
  EXPECT_NEAR(grown[0].value, at_once[0].value, 1e-14);
  EXPECT_NEAR(grown[0].error, at_once[0].error, 1e-2 * at_once[0].error);
  EXPECT_EQ(steps.means_history.size(), 3u);
  EXPECT_EQ(steps.add_replicates(run, 3)[0].dof, 7);
  EXPECT_EQ(run.calls, 5u * 1024 + 5u * 1024 + 3u * 1024);
}

// Doubles the length of some sequences and drops the others.
TEST(ReplicatedSequences, KeepFirst_ErrorStaysCalibrated) {
  double squares = 0, errors = 0;
  constexpr int runs = 200;
  const double truth = std::expm1(1.0) * 1.317902151454404; // (e - 1) times the sum of 1 / (k! (k + 1)^2)
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    mc::IntegrateOptions o;
    o.seed = seed;
    detail::IntegrationRun run{{.one = &exponential}, 1, 3, o};
    ReplicatedSequences s{.stream_id = 0, .count = 24};
    s.extend(run, 64);
    s.keep_first(20);
    const auto longer = s.extend(run, 128);
    ASSERT_EQ(run.calls, 24u * 64 + 20u * 64);
    ASSERT_EQ(longer[0].dof, 19);
    squares += mc::sqr(longer[0].value - truth) / runs;
    errors += mc::sqr(longer[0].error) / runs;
  }
  // the mean of 200 squares of a normal has an error of 10 %, the estimated errors have 3 %
  EXPECT_NEAR(errors / squares, 1, 0.4);
}

// Dropped sequences must not remove their part of a heavy tail from the diagnostics.
TEST(ReplicatedSequences, KeepFirst_KeepsTheTailOfDiscardedSequences) {
  const std::function<double(std::span<const double>)> heavy = [](std::span<const double> u) {
    return std::pow(1 - u[0], -0.9);
  };
  mc::IntegrateOptions o;
  detail::IntegrationRun run{{.one = &heavy}, 1, 1, o};
  ReplicatedSequences s{.stream_id = 0, .count = 24};
  s.extend(run, 4096);
  const mc::OctaveHistogram before = s.diagnostics()[0].values;
  ASSERT_EQ(s.means[0].error_bar, mc::ErrorBar::infinite_variance);
  s.keep_first(12);
  const detail::Mean after = s.extend(run, 8192)[0];
  EXPECT_EQ(s.diagnostics()[0].values.count(), 24u * 4096 + 12u * 4096);
  EXPECT_GE(s.diagnostics()[0].values.hi(), before.hi());
  EXPECT_EQ(after.error_bar, mc::ErrorBar::infinite_variance);
  EXPECT_EQ(after.dof, 11);
}

TEST(ReplicatedSequences, ConvergenceRateIsThatOfTheVariance) {
  ReplicatedSequences s{.stream_id = 0, .count = 24};
  s.means_history.push_back({{0, 1, 23}});
  EXPECT_EQ(detail::convergence_rate(s), 0);
  for (const double v : {1.0, 0.25, 0.0625, 0.0625 / 4}) s.means_history.push_back({{0, std::sqrt(v), 23}});
  EXPECT_NEAR(detail::convergence_rate(s), std::log(4.0), 1e-12); // over the last three doublings
}

// Replicates of equal length. The log variance of their means is lower by `gain` than for independent points.
ReplicatedSequences gaining(double deviation, double gain, std::uint32_t count = 12) {
  ReplicatedSequences s{.stream_id = 0, .count = count, .length = 256};
  s.sums.resize(count,
                detail::Sums{std::vector<detail::ScaledMoments>(1), std::vector<detail::IntegrandDiagnostics>(1)});
  for (std::uint32_t r = 0; r < count; ++r) {
    std::vector<double> values(256);
    for (std::size_t i = 0; i < 256; ++i) values[i] = i % 2 == 0 ? deviation : -deviation;
    s.sums[r].outputs[0].add(values, 0, deviation);
  }
  s.means_history.push_back({{1, deviation / 16 / std::sqrt(count) * std::exp(-gain / 2), count - 1.0}});
  return s;
}

// Without a gain, the points decide, for any values and any number of the replicates. The expected gain of the next
// doublings is a ninth of .4, because there was none in eight doublings.
TEST(ReplicatedSequences, PredictedRatio_NoGain_FollowsThePoints) {
  const ReplicatedSequences wide = gaining(0.1, 0), narrow = gaining(0.05, 0), lucky = gaining(0.1, 0.5),
                            few = gaining(0.05, 0, 8);
  EXPECT_NEAR(detail::predicted_log_variance_ratio(wide, narrow, 5, 0), std::log(4), 1e-2);
  EXPECT_NEAR(detail::predicted_log_variance_ratio(narrow, wide, 5, 0), -std::log(4), 1e-2);
  EXPECT_NEAR(detail::predicted_log_variance_ratio(wide, few, 5, 0), std::log(4), 1e-2);
  EXPECT_LT(std::abs(detail::predicted_log_variance_ratio(wide, lucky, 5, 0)), 0.05);
  EXPECT_NEAR(detail::predicted_log_variance_ratio(wide, narrow, 5, 0.6), std::log(4) - 3 * 0.4 / 9, 1e-2);
}

// With a large gain, the replicates decide. The predicted gain follows the gain so far.
TEST(ReplicatedSequences, PredictedRatio_LargeGain_FollowsTheReplicates) {
  const ReplicatedSequences slow = gaining(0.01, 4), fast = gaining(0.01, 8), half = gaining(0.01, 1.4);
  EXPECT_NEAR(detail::predicted_log_variance_ratio(slow, fast, 0, 0.6), 4, 0.2);
  EXPECT_NEAR(detail::predicted_log_variance_ratio(fast, slow, 0, 0.6), -4, 0.2);
  EXPECT_NEAR(detail::predicted_log_variance_ratio(fast, slow, 5, 0.6),
              detail::predicted_log_variance_ratio(fast, slow, 0, 0.6) - 3 * 8.4 / 9, 1e-3);
  EXPECT_NEAR(detail::predicted_log_variance_ratio(half, slow, 5, 0.6),
              detail::predicted_log_variance_ratio(half, slow, 0, 0.6) - 3 * 1.8 / 9, 1e-2);
}

TEST(ReplicatedSequences, AddReplicatesEqualsAllAtOnce) {
  const std::function<double(std::span<const double>)> f = [](std::span<const double> u) { return u[0] * u[0]; };
  mc::IntegrateOptions o;
  detail::IntegrationRun run{{.one = &f}, 1, 1, o};
  ReplicatedSequences half{.stream_id = 0, .count = 12}, all{.stream_id = 0, .count = 24};
  half.extend(run, 64);
  all.extend(run, 64);
  EXPECT_EQ(half.add_replicates(run, 12)[0].error, all.means[0].error);
  EXPECT_EQ(half.count, 24u);
  ASSERT_EQ(half.means_history.size(), 1u);
  EXPECT_EQ(half.means_history[0][0].error, all.means[0].error);
}

// A uniform part with an eighth of the points has most of the variance, in any unit. It has less with equally many
// points.
TEST(ReplicatedSequences, DenserUniformPartHasLessOfTheVariance) {
  for (const double unit : {1.0, 1e-300, 1e300}) {
    const std::function<double(std::span<const double>)> f = [&](std::span<const double> u) {
      return unit * std::exp(u[0] * u[1] - u[0]);
    };
    mc::IntegrateOptions o;
    detail::IntegrationRun run{{.one = &f}, 1, 2, o};
    std::vector<double> edges;
    for (int axis = 0; axis < 2; ++axis)
      for (std::size_t i = 0; i <= mc::ImportanceGrid::bins; ++i)
        edges.push_back(std::pow(static_cast<double>(i) / mc::ImportanceGrid::bins, 1.2));
    const auto density = std::make_shared<mc::AdaptedDensity>(mc::AdaptedDensity{mc::ImportanceGrid(std::move(edges))});
    ReplicatedSequences s{.stream_id = 1, .count = 24, .proposal = {density, {0.7 * unit}}};
    EXPECT_EQ(s.uniform_variance_share(), 0);
    s.extend(run, 128);
    EXPECT_EQ(s.calls_per_replicate(), 128u + 16u);
    const double sparse = s.uniform_variance_share();
    s.points_per_uniform_point = 1;
    const detail::Mean mean = s.extend(run, 256)[0];
    EXPECT_EQ(s.calls_per_replicate(), 512u);
    EXPECT_EQ(run.calls, 24u * 512);
    EXPECT_GT(sparse, 0.5);
    EXPECT_LT(s.uniform_variance_share(), 0.5 * sparse);
    EXPECT_LE(std::abs(mean.value / unit - 0.7965995992970531), 5 * mean.error / unit);
    s.add_replicates(run, 2);
    EXPECT_EQ(run.calls, 26u * 512);
  }
}

// Ten times the error but a hundredth of the relative error. The other mean missed almost the whole integrand.
TEST(ReplicatedSequences, LogVarianceRatio_IntegrandMissed_IsNotBetter) {
  const mc::detail::Means nothing = {{1e-4, 1e-4, 23}}, much = {{1, 1e-3, 23}}, like_it = {{1.0001, 1e-4, 23}};
  EXPECT_LT(mc::detail::log_variance_ratio(much, nothing), -10);
  EXPECT_NEAR(mc::detail::log_variance_ratio(much, like_it), std::log(100), 1e-9);
  EXPECT_GT(mc::detail::required_margin({{1, 1, 23, 0.2}}), mc::detail::required_margin(much) + 0.45);
  EXPECT_TRUE(mc::detail::significantly_different(much, nothing));
  EXPECT_FALSE(mc::detail::significantly_different(much, like_it));
}

// Half of the value with a fiftieth of the error. The missing half counts as its error.
TEST(ReplicatedSequences, LogVarianceRatio_HalfMissed_IsNotBetter) {
  const mc::detail::Means less = {{0.5, 1e-3, 23}}, much = {{1, 0.05, 23}};
  EXPECT_TRUE(mc::detail::significantly_different(much, less));
  EXPECT_LT(mc::detail::log_variance_ratio(much, less), -4);
  EXPECT_NEAR(mc::detail::log_variance_ratio(less, much), -mc::detail::log_variance_ratio(much, less), 1e-12);
}

TEST(ReplicatedSequences, HasFewerKnownErrorsComparesErrorBars) {
  const detail::Mean known{1, 0.1, 23}, unknown{1e-4, 1e-4, 23, 0, mc::ErrorBar::infinite_variance};
  EXPECT_TRUE(mc::detail::has_fewer_known_errors({known, unknown}, {known, known}));
  EXPECT_FALSE(mc::detail::has_fewer_known_errors({unknown}, {unknown}));
  EXPECT_FALSE(mc::detail::has_fewer_known_errors({known}, {unknown}));
  EXPECT_FALSE(mc::detail::has_fewer_known_errors({known, unknown}, {unknown, known}));
}

} // namespace

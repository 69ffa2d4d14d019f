#include <mc/estimate/integrate/methods.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace {

using namespace mc::detail;
namespace detail = mc::detail;

const std::function<double(std::span<const double>)> near_pole = [](std::span<const double> u) {
  return 1 / (1e-3 + mc::sqr(u[0] - 0.4));
};

// Each method must respect its calls, store its latest means and report its name.
TEST(Methods, DoNotExceedMaxCalls) {
  for (const std::uint64_t calls : {500u, 5000u, 77'777u}) {
    mc::IntegrateOptions o;
    o.max_calls = calls;
    o.rel_error = 0;
    const auto expect = [&](auto method, mc::Method name) {
      detail::IntegrationRun run{{.one = &near_pole}, 1, 2, o};
      std::optional<Outcome> last;
      const Outcome out = method(run, last);
      EXPECT_LE(run.calls, calls);
      EXPECT_GE(run.calls, calls / 2);
      EXPECT_EQ(out.method, name);
      EXPECT_EQ(out.stop, mc::StopReason::max_calls);
      EXPECT_GT(out.means[0].error, 0);
    };
    expect(plain, mc::Method::plain);
    expect(stratified, mc::Method::stratified);
    expect([](detail::IntegrationRun& run, auto& last) { return replicated_rqmc(run, mc::Method::rqmc, last); },
           mc::Method::rqmc);
    expect([](detail::IntegrationRun& run, auto& last) { return replicated_rqmc(run, mc::Method::vegas, last); },
           mc::Method::vegas);
    expect([](detail::IntegrationRun& run, auto& last) { return replicated_rqmc(run, mc::Method::tree, last); },
           mc::Method::tree);
  }
}

// For any number of calls and replicates, no run exceeds its calls, and the rest is smaller than the calls spent. Up to
// eight replicates are all kept; of more, at least a third.
TEST(Methods, SpendMostCallsOfAnyBudget) {
  std::mt19937_64 random(20261122);
  for (int i = 0; i < 60; ++i) {
    mc::IntegrateOptions o;
    o.max_calls = static_cast<std::uint64_t>(std::exp(std::uniform_real_distribution<>(4, 12)(random)));
    o.replicates = std::uniform_int_distribution<std::uint32_t>(2, 30)(random);
    o.rel_error = 0;
    for (const mc::Method method : {mc::Method::rqmc, mc::Method::vegas, mc::Method::tree, mc::Method::automatic}) {
      SCOPED_TRACE(std::string(mc::name(method)) + ", " + std::to_string(o.max_calls) + " calls, " +
                   std::to_string(o.replicates) + " replicates");
      detail::IntegrationRun run{{.one = &near_pole}, 1, 2, o};
      std::optional<Outcome> last;
      const Outcome out = replicated_rqmc(run, method, last);
      EXPECT_LE(run.calls, o.max_calls);
      EXPECT_GE(run.calls, o.max_calls / 2);
      EXPECT_GE(out.means[0].dof + 1, std::max<double>(std::min(o.replicates, 8u), std::ceil(o.replicates / 3.0)));
    }
  }
}

// If the error falls faster than for independent points, a run must end with fewer and longer sequences. If not, all
// replicates remain, except for a few seeds.
TEST(Methods, EndWithFewerLongerSequencesWhereVarianceIsLower) {
  const std::function<double(std::span<const double>)> smooth = [](std::span<const double> u) {
    return std::exp(u[0] - 0.3 * u[1]);
  };
  const std::function<double(std::span<const double>)> rough = [](std::span<const double> u) {
    return std::fmod(1e6 * std::sin(1e6 * u[0] + 3e5 * u[1]), 1.0); // values at different points are unrelated
  };
  const double truth = (std::exp(1) - 1) * (1 - std::exp(-0.3)) / 0.3;
  double ended = 0, even = 0;
  int stay = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    mc::IntegrateOptions o;
    o.max_calls = 100'000; // 24 sequences of 2^12 points, or 12 of 2^13
    o.rel_error = 0;
    o.method = mc::Method::rqmc;
    o.seed = seed;
    const mc::Integral fewer = mc::integrate_unit(smooth, 2, o);
    EXPECT_LT(fewer.estimate.dof, 23);
    EXPECT_GE(fewer.estimate.dof, 7);
    ended += mc::sqr(fewer.estimate.value - truth);
    even += mc::sqr(mc::integrate_rqmc(smooth, 2, 4096, 24, seed).estimate.value - truth);
    stay += mc::integrate_unit(rough, 2, o).estimate.dof >= 23;
  }
  EXPECT_GE(stay, 20);
  // The standard error of both sums is about a quarter (30 squares of a normal). The variance of interlaced points in
  // two dimensions falls by up to a factor 32 for each doubling.
  EXPECT_LT(ended, even / 2);
}

// With very few calls, the learned density cannot be compared with the baseline points. The number of remaining calls
// must not underflow.
TEST(Methods, Automatic_FewCalls_DoesNotExceedMaxCalls) {
  for (std::uint64_t calls = 48; calls <= 200; ++calls) {
    mc::IntegrateOptions o;
    o.max_calls = calls;
    detail::IntegrationRun run{{.one = &near_pole}, 1, 2, o};
    std::optional<Outcome> last;
    replicated_rqmc(run, mc::Method::automatic, last);
    ASSERT_LE(run.calls, calls);
  }
}

// A long thin Gaussian along no axis, on .015 % of the volume. Baseline points that miss it have the least variance,
// and short learning rounds sample only a part of it. A run must neither end with the baseline points nor have a large
// error.
TEST(Methods, Automatic_NarrowRidge_FindsTheWholeIntegral) {
  const std::function<double(std::span<const double>)> ridge = [](std::span<const double> u) {
    const double x = u[0] - 0.5, y = u[1] - 0.5, z = u[2] - 0.5, along = (x + 2 * y + 2 * z) / 3;
    const double across2 = x * x + y * y + z * z - along * along;
    return std::exp(-(mc::sqr(along / 0.06) + across2 / mc::sqr(0.006)) / 2);
  };
  const double truth = std::pow(2 * mc::pi<double>, 1.5) * 0.06 * mc::sqr(0.006);
  int baseline = 0, off = 0, covered = 0;
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    mc::IntegrateOptions o;
    o.rel_error = 0;
    o.max_calls = 100'000;
    o.seed = seed;
    const mc::Integral r = mc::integrate_unit(ridge, 3, o);
    baseline += r.method == mc::Method::rqmc;
    off += std::abs(r.estimate.value / truth - 1) > 0.1;
    covered += r.interval.lo <= truth && truth <= r.interval.hi;
    squares += mc::sqr(r.estimate.value / truth - 1);
  }
  EXPECT_EQ(baseline, 0);
  EXPECT_LE(off, 4);
  EXPECT_GE(covered, 20);                   // 22.8 expected
  EXPECT_LE(std::sqrt(squares / 24), 0.03); // measured .004, and .009 over 100 seeds
}

TEST(Methods, LearnDensity_ConcentratesAtThePeak) {
  mc::IntegrateOptions o;
  o.max_calls = 100'000;
  detail::IntegrationRun run{{.one = &near_pole}, 1, 2, o};
  std::optional<Outcome> last;
  const LearnedDensity learned = learn_density(run, nullptr, last).value();
  ASSERT_TRUE(last.has_value()) << "what to say when cancelled now";
  EXPECT_EQ(last->means[0].value, run.rounds.back().means[0].value);
  EXPECT_FALSE(run.rounds.empty());
  EXPECT_LE(run.calls, 100'000u / 4);
  int inside = 0; // of 129 edges, the edges within .1 of the peak; a uniform grid would have 20 %
  for (const double e : learned.density->grid.edges(0)) inside += std::abs(e - 0.4) < 0.1;
  EXPECT_GE(inside, 60);
}

// For a smooth wave, a density is no better than the points themselves.
TEST(Methods, LearnDensity_SmoothIntegrand_ReturnsNothing) {
  const std::function<double(std::span<const double>)> wave = [](std::span<const double> u) {
    return std::cos(0.97 + 2.76 * u[0] + 3.24 * u[1]);
  };
  mc::IntegrateOptions o;
  o.max_calls = 100'000;
  detail::IntegrationRun run{{.one = &wave}, 1, 2, o};
  ReplicatedSequences baseline{.stream_id = 0, .count = 24, .record = true};
  for (std::uint64_t to = 16; to <= 256; to *= 2) baseline.extend(run, to);
  std::optional<Outcome> last;
  EXPECT_FALSE(learn_density(run, &baseline, last).has_value());
  EXPECT_FALSE(last.has_value());
  EXPECT_LE(run.calls, 24u * 256 + 5000);
}

// For such a heavy tail, the error of the baseline points is rarely known, and looks small if they missed all large
// values. Learning must not be given up for that reason. With these seeds, a comparison by the apparent errors would
// give up.
TEST(Methods, LearnDensity_UnknownErrors_ReturnsADensity) {
  const std::function<double(std::span<const double>)> corner = [](std::span<const double> u) {
    return std::pow(u[0] * u[1] * u[2] + 1e-300, -0.4);
  };
  for (const std::uint64_t seed : {29u, 41u, 42u, 54u, 87u, 116u, 146u, 147u}) {
    mc::IntegrateOptions o;
    o.max_calls = 100'000;
    o.rel_error = 0;
    o.seed = seed;
    detail::IntegrationRun run{{.one = &corner}, 1, 3, o};
    ReplicatedSequences baseline{.stream_id = 0, .count = 24, .record = true};
    for (std::uint64_t to = 16; to <= 256; to *= 2) baseline.extend(run, to);
    std::optional<Outcome> last;
    EXPECT_TRUE(learn_density(run, &baseline, last).has_value()) << seed;
  }
}

// The calls that auto spends on rejected methods must not reduce the number of sequences that rqmc keeps.
TEST(Methods, Automatic_RqmcChosen_EndsWithAsManySequences) {
  const std::function<double(std::span<const double>)> wave = [](std::span<const double> u) {
    double x = 0.97;
    for (std::size_t i = 0; i < u.size(); ++i) x += (0.3 + 0.1 * static_cast<double>(i)) * u[i];
    return std::cos(x);
  };
  mc::IntegrateOptions o;
  o.rel_error = 0;
  for (o.seed = 1; o.seed <= 2; ++o.seed) {
    o.method = mc::Method::rqmc;
    const mc::Integral rqmc = mc::integrate_unit(wave, 8, o);
    o.method = mc::Method::automatic;
    const mc::Integral automatic = mc::integrate_unit(wave, 8, o);
    EXPECT_EQ(automatic.method, mc::Method::rqmc);
    EXPECT_EQ(automatic.estimate.dof, rqmc.estimate.dof);
  }
}

// The error bar of few points is unreliable, because they may all miss an important thousandth of the volume.
TEST(Methods, ReplicatesNeed128PointsEach) {
  for (const auto method : {mc::Method::rqmc, mc::Method::vegas, mc::Method::tree, mc::Method::automatic}) {
    mc::IntegrateOptions o;
    o.rel_error = 0.1;
    detail::IntegrationRun run{{.one = &near_pole}, 1, 2, o};
    std::optional<Outcome> last;
    EXPECT_EQ(replicated_rqmc(run, method, last).stop, mc::StopReason::converged);
    EXPECT_GE(run.calls, 128u * o.replicates);
  }
}

} // namespace

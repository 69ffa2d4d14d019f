#include <mc/estimate/integrate/evaluate.h>
#include <mc/estimate/integrate/learn_density.h>
#include <mc/estimate/integrate/run.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

using namespace mc::detail;
namespace detail = mc::detail;
using Function = std::function<double(std::span<const double>)>;

Record record_of(const Function& f, int dim, std::uint64_t points, const Proposal& proposal = {},
                 std::uint64_t round = 0) {
  const mc::IntegrateOptions o;
  detail::Run run{{{.one = &f}, 1, dim, o}};
  Record record;
  run.evaluator.evaluate(run.sobol_sets(Stream::adapted, round, 0, 16), 0, points, proposal, {.record = &record});
  return record;
}

// Two peaks on a diagonal: each axis shows two bumps, and a product of axes has four peaks.
const Function peaks = [](std::span<const double> u) {
  const auto at = [&](double c) { return std::exp(-(mc::sqr(u[0] - c) + mc::sqr(u[1] - c)) / (2 * 0.05 * 0.05)); };
  return at(0.25) + at(0.75);
};

TEST(LearnDensity, TreeFollowsWhatIsNoProduct) {
  mc::AdaptedDensity density{mc::ImportanceGrid(2)};
  std::vector<double> variance;
  for (std::uint64_t round = 0; round < 4; ++round) {
    Proposal proposal;
    if (round > 0) proposal = {std::make_shared<mc::AdaptedDensity>(density), {2 * 2 * mc::pi<double> * 0.0025}};
    const Record record = record_of(peaks, 2, 256, proposal, round);
    const Samples samples{record, 2, 1};
    variance.push_back(variances(proposal, samples)[0]);
    density = adapted(density, samples, true);
  }
  EXPECT_LT(variance[3], 0.15 * variance[0]);
  ASSERT_TRUE(density.tree.has_value());
  std::vector<double> scratch(2);
  const auto at = [&](double x, double y) { return density.density(std::array{x, y}, scratch); };
  EXPECT_GT(at(0.25, 0.25), 4 * at(0.25, 0.75));
  EXPECT_GT(at(0.75, 0.75), 4 * at(0.75, 0.25));
}

// The predicted variance is the one that points through the proposal have.
TEST(LearnDensity, VariancesPredictAnotherProposal) {
  const Function peak = [](std::span<const double> u) { return 1 / (0.01 + mc::sqr(u[0] - 0.4)) + u[1]; };
  const Record uniform = record_of(peak, 2, 1024);
  const Samples samples{uniform, 2, 1};
  const Proposal next{std::make_shared<mc::AdaptedDensity>(adapted({mc::ImportanceGrid(2)}, samples, false)), {25.0}};
  const double predicted = variances(next, samples)[0];
  const Record weighted = record_of(peak, 2, 1024, next, 1);
  const double measured = variances(next, {weighted, 2, 1})[0];
  EXPECT_NEAR(predicted / measured, 1, 0.1);
  EXPECT_LT(measured, 0.2 * variances({}, samples)[0]);
}

TEST(LearnDensity, HalvesAreDisjointAndComplete) {
  const Record record = record_of(peaks, 2, 100);
  std::vector<int> used(record.weights.size());
  for (const auto half : {Samples::Half::first, Samples::Half::second})
    Samples{record, 2, 1, half}.each([&](std::size_t i) { ++used[i]; });
  for (const int n : used) EXPECT_EQ(n, 1);
}

// The few largest values of this product dominate the mean square. The grid must stay as symmetric about the middle as
// the product, so it must not follow single points.
TEST(LearnDensity, DoesNotFollowSinglePoints) {
  constexpr std::size_t dim = 20;
  const Function product = [](std::span<const double> u) {
    double f = 1;
    for (const double x : u) f *= std::abs(4 * x - 2);
    return f;
  };
  const Record record = record_of(product, dim, 512);
  const mc::AdaptedDensity learned = adapted({mc::ImportanceGrid(dim)}, {record, dim, 1}, false);
  std::vector<double> x(dim, 0.5), scratch(dim);
  const auto density = [&](std::size_t axis, double at) {
    x[axis] = at;
    const double p = learned.density(x, scratch);
    x[axis] = 0.5;
    return p;
  };
  double largest = 1;
  for (std::size_t axis = 0; axis < dim; ++axis)
    for (double at = 0.005; at < 0.5; at += 0.01) {
      const double ratio = density(axis, at) / density(axis, 1 - at);
      largest = std::max({largest, ratio, 1 / ratio});
    }
  EXPECT_LE(largest, 2.5);
}

// The points of two densities are one sample: its weighted mean is the integral, and no weight exceeds that of the
// density which has a point in its region.
TEST(MixtureRecord, PointsOfAllProposalsAreOneSample) {
  const Proposal uniform, peaked{std::make_shared<mc::AdaptedDensity>(
                                     adapted({mc::ImportanceGrid(2)}, {record_of(peaks, 2, 256), 2, 1}, false)),
                                 {}};
  detail::MixtureRecord all;
  all.add(record_of(peaks, 2, 256, uniform, 1), uniform, 2);
  all.add(record_of(peaks, 2, 512, peaked, 2), peaked, 2);
  const Record& r = all.record();
  ASSERT_EQ(r.weights.size(), 16u * (256 + 512));
  double mean = 0, volume = 0, largest = 0;
  for (std::size_t i = 0; i < r.weights.size(); ++i) {
    mean += r.weights[i] * r.values[i] / static_cast<double>(r.weights.size());
    volume += r.weights[i] / static_cast<double>(r.weights.size());
    largest = std::max(largest, r.weights[i]);
  }
  EXPECT_NEAR(mean, 2 * 2 * mc::pi<double> * 0.0025, 1e-4);
  EXPECT_NEAR(volume, 1, 0.02);
  EXPECT_LE(largest, 3); // a third of the points is uniform
}

TEST(MixtureRecord, IsBounded) {
  const Proposal uniform;
  detail::MixtureRecord all;
  for (std::uint64_t round = 0; round < 3; ++round)
    all.add(record_of(peaks, 2, detail::MixtureRecord::most / 32, uniform, round), uniform, 2);
  EXPECT_EQ(all.record().weights.size(), detail::MixtureRecord::most / 2);
}

TEST(LearnDensity, AllZero_StaysUniform) {
  const Function zero = [](std::span<const double>) { return 0.0; };
  const Record record = record_of(zero, 2, 64);
  const mc::AdaptedDensity learned = adapted({mc::ImportanceGrid(2)}, {record, 2, 1}, false);
  std::vector<double> scratch(2);
  EXPECT_NEAR(learned.density(std::array{0.3, 0.6}, scratch), 1, 1e-12);
}

} // namespace

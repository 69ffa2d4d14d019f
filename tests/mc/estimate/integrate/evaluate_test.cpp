#include <mc/estimate/integrate/evaluate.h>
#include <mc/estimate/integrate/run.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace mc::detail;
namespace detail = mc::detail;

const std::function<double(std::span<const double>)> weighted_sum = [](std::span<const double> u) {
  return u[0] + 2 * u[1];
};

TEST(Evaluator, SumsEveryPointOnceForAnyPartition) {
  const mc::IntegrateOptions o;
  detail::Run run{{{.one = &weighted_sum}, 1, 2, o}};
  const std::vector<mc::PointSet> sets = run.sobol_sets(Stream::rqmc, 0, 0, 3);
  std::vector<Sums> whole = run.evaluator.evaluate(sets, 0, 10'000), parts = run.evaluator.evaluate(sets, 0, 300);
  std::vector<Sums> rest = run.evaluator.evaluate(sets, 300, 9700);
  EXPECT_EQ(run.evaluator.calls, 60'000u);
  for (std::size_t r = 0; r < sets.size(); ++r) {
    parts[r].merge(std::move(rest[r]));
    EXPECT_EQ(parts[r].outputs[0].moments().count(), whole[r].outputs[0].moments().count());
    EXPECT_NEAR(parts[r].outputs[0].mean(), whole[r].outputs[0].mean(), 1e-14);
    EXPECT_EQ(parts[r].sampled[0].averaged.largest(100), whole[r].sampled[0].averaged.largest(100));
  }
}

// The record holds the first points of each set, wherever chunks end.
TEST(Evaluator, RecordsTheFirstPointsOfEachSet) {
  const mc::IntegrateOptions o;
  detail::Run run{{{.one = &weighted_sum}, 1, 2, o}};
  const std::vector<mc::PointSet> sets = run.sobol_sets(Stream::rqmc, 0, 0, 2);
  Record record;
  run.evaluator.evaluate(sets, 100, 9000, {}, {.record = &record, .most_recorded = 10'000});
  ASSERT_EQ(record.values.size(), 10'000u);
  for (std::size_t set = 0; set < 2; ++set)
    for (const std::size_t i : {0u, 4095u, 4096u, 4999u}) {
      std::vector<double> u(2), jacobian(1);
      mc::fill_points(sets[set], 100 + i, 2, u, jacobian);
      const std::size_t at = set * 5000 + i;
      EXPECT_EQ(record.points[2 * at], u[0]);
      EXPECT_EQ(record.values[at], weighted_sum(u));
      EXPECT_EQ(record.weights[at], 1);
    }
}

// An output that is auxiliary has no part in learning.
TEST(Evaluator, RecordsPrimaryOutputsOnly) {
  const mc::VectorIntegrand three = [](std::span<const double> u, std::span<double> y) {
    y[0] = u[0];
    y[1] = 2 * u[0];
    y[2] = -1;
  };
  mc::IntegrateOptions o;
  o.auxiliary_outputs = 1;
  detail::Run run{{{.several = &three}, 3, 1, o}};
  Record record;
  run.evaluator.evaluate(run.sobol_sets(Stream::rqmc, 0, 0, 2), 0, 5000, {}, {.record = &record});
  ASSERT_EQ(record.values.size(), 2 * record.points.size());
  for (std::size_t i = 0; i < record.points.size(); ++i) {
    EXPECT_EQ(record.values[2 * i], record.points[i]);
    EXPECT_EQ(record.values[2 * i + 1], 2 * record.points[i]);
  }
}

// Parts and messages hold the sums of every unit.
TEST(Evaluator, NumberOfUnits_IsBoundedInCalls) {
  std::size_t units = 0;
  mc::IntegrateOptions o;
  o.max_calls = std::uint64_t{1} << 50;
  o.executor = [&](const mc::AnyJob& job, const mc::RunOptions&) {
    units = job.next_stage();
    return false;
  };
  detail::Run run{{{.one = &weighted_sum}, 1, 2, o}};
  const std::vector<mc::PointSet> sets = run.sobol_sets(Stream::rqmc, 0, 0, 16);
  for (int power = 16; power <= 44; ++power) {
    EXPECT_THROW(run.evaluator.evaluate(sets, 0, std::uint64_t{1} << power), Cancelled);
    EXPECT_GE(units, 16u);
    EXPECT_LE(units, 65536u) << "2^" << power << " points of each set";
  }
}

// The average with weights and control must be the integral for any density.
TEST(Evaluator, MixtureIsUnbiased) {
  mc::AdaptedDensity density{mc::ImportanceGrid(2)};
  std::vector<double> power(2 * mc::ImportanceGrid::bins, 1e-3);
  for (std::size_t i = 0; i < 20; ++i) power[i] = power[200 + i] = 1; // where the integrand is small
  density.grid.refine(power, 100'000);
  const std::vector<mc::BoxTreeNode> nodes = {
      {0, 0.3}, {mc::BoxTreeNode::leaf, 5}, {1, 0.6}, {mc::BoxTreeNode::leaf, 1}, {mc::BoxTreeNode::leaf, 2}};
  density.tree = mc::BoxTree(2, nodes);
  const mc::IntegrateOptions o;
  detail::Run run{{{.one = &weighted_sum}, 1, 2, o}};
  const Proposal proposal{std::make_shared<mc::AdaptedDensity>(density), {0.7}};
  mc::Moments means;
  for (const Sums& s : run.evaluator.evaluate(run.sobol_sets(Stream::adapted, 0, 0, 24), 0, 4096, proposal)) {
    means.add(s.outputs[0].mean());
    EXPECT_EQ(s.sampled[0].integrand.count(), 4096u);
    EXPECT_LE(s.sampled[0].averaged.hi(), 8 * 3.0); // the uniform part bounds the weights
  }
  EXPECT_LE(means.std_error(), 0.01);
  EXPECT_NEAR(means.mean(), 1.5, 5 * means.std_error());
}

TEST(Evaluator, NotANumber_ThrowsWithItsPoint) {
  const std::function<double(std::span<const double>)> bad = [](std::span<const double> u) {
    return u[0] > 0.9 ? std::nan("") : 1.0;
  };
  const mc::IntegrateOptions o;
  detail::Run run{{{.one = &bad}, 1, 2, o}};
  try {
    run.evaluator.evaluate(run.sobol_sets(Stream::rqmc, 0, 0, 2), 0, 100);
    FAIL();
  } catch (const mc::NotFinite& e) {
    ASSERT_EQ(e.u.size(), 2u);
    EXPECT_GT(e.u[0], 0.9);
  }
}

} // namespace

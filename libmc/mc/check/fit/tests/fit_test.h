#pragma once
/// Interface of the statistical tests. Each test is one file of fit/tests/ and one row of table.cpp.
///
///   pilot -> FitSetup -> prepare -> expect, count: blocks of points -> FitCounts -> judge -> Findings -> explanations

#include <mc/check/fit/expected/mass.h>
#include <mc/check/fit/expected/stratified_reference.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/fit/pooled_cells.h>
#include <mc/check/fit/tests/axis_intervals.h>
#include <mc/check/fit/weighted_counts.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/options.h>
#include <mc/check/subject/subject.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mc {

/// Input of all tests before the first sample is counted.
struct FitSetup {
  const Subject& subject;
  const SubjectOptions& options;
  const Pilot& pilot;
};

/// Random points of the reference, which estimate the expected counts.
struct ReferenceBlock {
  std::span<const StratifiedReference::EvaluatedPoint> points;
  std::span<const double> weights; ///< the weight that a sample at each point would have
};

/// Counted samples that are points of the domain.
struct SampleBlock {
  std::span<const Subject::Coordinates> points;
  std::span<const double> densities; ///< the claimed density at each point
  std::span<const double> weights;   ///< the weight of each sample; nearly always 1
  std::span<const double> shares;    ///< the share of the expected counts that a random point there would have
  std::span<const StratifiedReference::Stratum* const> strata; ///< the stratum of each point
};

/// Results of counting that several tests use. Other counts are the state of one test.
struct FitCounts {
  const FitSetup& setup;
  DrawStats draws = {};                 ///< statistics of the counted samples, without the pilot
  const Partition* partition = nullptr; ///< the tree of the first cells; null for discrete outcomes
  std::vector<UnitBox> boxes = {};      ///< boxes of the first cells; the other cells are discrete outcomes
  std::vector<Cell> cells = {};         ///< cells with their counts
  PooledCells pooled = {};              ///< the same, with at least 8 expected samples each
  WeightedCounts all = {};              ///< all samples and random points
  SampleWeights weights = {};           ///< sums of the weights of the samples
  ClaimedMass mass = {};                ///< integral of the claimed density and the outcomes
  std::optional<Subject::Coordinates> invalid_point = {}; ///< where the density is negative or not finite
  std::vector<AxisInterval> intervals = {};               ///< suspicious thin intervals of the axes
  double kept = 0;                                        ///< number of draws among which the intervals were found
  std::vector<Subject::Coordinates> inverted = {};        ///< images of samples under the subject's inverse

  /// Returns the integral to which counts are normalised. Failures supply the rest of 1.
  double total() const { return setup.subject.may_fail ? 1.0 : std::max(mass.value, 1e-300); }
};

/// Returns the stream of the draws behind FitCounts::inverted.
std::uint64_t inverted_stream(const SubjectOptions& options);
/// Returns the number of these draws.
std::uint64_t inverted_count(const SubjectOptions& options);

/// A statistical test in progress. Each function is called once per block or once in all, never per sample.
struct FitTest {
  std::function<void(const ReferenceBlock& block)> expect = {}; ///< counts random points; may be empty
  std::function<void(const SampleBlock& block)> count = {};     ///< counts samples; may be empty
  std::function<Findings(const FitCounts& counts)> judge = {};  ///< returns no check if the test is impossible
};

/// Returns the test with the state `state`: judge(counts), and optionally expect(block) and count(block).
template <class State> FitTest make_fit_test(State initial) {
  const auto state = std::make_shared<State>(std::move(initial));
  FitTest test;
  if constexpr (requires(const ReferenceBlock& block) { state->expect(block); })
    test.expect = [state](const ReferenceBlock& block) { state->expect(block); };
  if constexpr (requires(const SampleBlock& block) { state->count(block); })
    test.count = [state](const SampleBlock& block) { state->count(block); };
  test.judge = [state](const FitCounts& counts) { return state->judge(counts); };
  return test;
}

/// Returns a test without a state of its own that judges the pooled cells.
///   judge : (cells, setup) -> Findings; called if the cells are testable.
template <class Judge> FitTest make_cell_test(Judge judge) {
  FitTest test;
  test.judge = [judge](const FitCounts& counts) {
    return counts.pooled.is_testable() ? judge(counts.pooled, counts.setup) : Findings{};
  };
  return test;
}

/// Returns the Check of a p-value. It fails if p <= sidak_level(alpha, share), and only then has a detail.
Check statistical_check(std::string name, double p, double statistic, double share, double alpha, Fault fault,
                        std::string detail);

/// Share of one test in the family-wise alpha. Laws have none.
struct AlphaShare {
  double discrete = 0, one_axis = 0, more_axes = 0; ///< for subjects without axes, with one, with two or three

  /// Returns the share for a subject with `dim` axes.
  constexpr double at_dimension(int dim) const {
    if (dim == 0) return discrete;
    return dim == 1 ? one_axis : more_axes;
  }
};

/// A row of the table of statistical tests.
struct FitTestRow {
  /// Rows with equal names spend one share, in equal parts.
  const char* name;
  /// The share of alpha that all checks of the test spend together. If the shares of all rows exceed 1, they are
  /// divided by their sum.
  AlphaShare share;
  bool (*applies)(const Subject& subject);                 ///< whether the test is possible for the subject
  FitTest (*prepare)(const FitSetup& setup, double share); ///< starts the test
  bool of_cells = false;                                   ///< judges nothing but the pooled cells: see test_cells()
};

/// The Findings of one row; row is null for findings of an explanation.
struct TestFindings {
  const FitTestRow* row = nullptr;
  std::vector<Check> checks;
};

/// A row of the table of explanations, which change failed tests into their cause.
struct ExplanationRow {
  const char* name;
  /// Changes the findings of all tests.
  void (*explain)(const FitCounts& counts, std::vector<TestFindings>& findings);
};

/// Returns the checks of all tests of cells.
std::vector<Check*> checks_of_cells(std::vector<TestFindings>& findings);
/// Puts a finding before the detail of the failed checks that may lead a report: the first, and the first with p <
/// 1e-9.
void prepend_finding(const std::vector<Check*>& checks, const std::string& finding);

} // namespace mc

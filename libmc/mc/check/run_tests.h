#pragma once
/// Runs the rows of the table of statistical tests.

#include <mc/check/fit/tests/fit_test.h>

#include <vector>

namespace mc {

/// A row of the table with its test in progress.
struct RunningTest {
  const FitTestRow* row; ///< the row
  FitTest test;          ///< its test
};

/// Returns the share of alpha that a row spends on a subject. Rows with equal names that apply to the subject divide
/// one share evenly.
double share_of(const FitTestRow& row, const Subject& subject);

/// Starts every test that applies to the subject, in the order of the table.
std::vector<RunningTest> start_tests(const FitSetup& setup);

/// Findings of all tests, and the errors that they state as detectable.
struct JudgedTests {
  std::vector<TestFindings> findings; ///< one for each test
  double detectable = 0,              ///< as in Report
      detectable_cell = 0;            ///< as in Report
};
/// Judges every test, in the order of the table.
JudgedTests judge_tests(const std::vector<RunningTest>& tests, const FitCounts& counts);

/// Runs the rows that judge cells alone: chi-square, single cells, tails, KS and correlation, given the sum of the
/// counts. The variance of the probabilities adds to the variance of the counts. An estimated probability thus makes a
/// test weaker, but never wrong.
///   dim : number of axes with ranks, 0 to 3.
Findings test_cells(const std::vector<Cell>& cells, int dim, double alpha, const std::vector<Axis>& named = {});

} // namespace mc

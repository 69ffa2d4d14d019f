#include <mc/check/run_tests.h>

#include <mc/check/table.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace mc {

double share_of(const FitTestRow& row, const Subject& subject) {
  const auto equal_rows = [&](const FitTestRow& of, bool applicable) {
    return static_cast<double>(std::count_if(fit_tests().begin(), fit_tests().end(), [&](const FitTestRow& other) {
      return other.name == std::string_view(of.name) && (!applicable || other.applies(subject));
    }));
  };
  double sum = 0;
  for (const FitTestRow& other : fit_tests()) sum += other.share.at_dimension(subject.dim) / equal_rows(other, false);
  constexpr double rounding = 1e-9;
  return row.share.at_dimension(subject.dim) / std::max(equal_rows(row, true), 1.0) / (sum > 1 + rounding ? sum : 1);
}

std::vector<RunningTest> start_tests(const FitSetup& setup) {
  std::vector<RunningTest> tests;
  for (const FitTestRow& row : fit_tests())
    if (row.applies(setup.subject)) tests.push_back({&row, row.prepare(setup, share_of(row, setup.subject))});
  return tests;
}

JudgedTests judge_tests(const std::vector<RunningTest>& tests, const FitCounts& counts) {
  JudgedTests judged;
  for (const RunningTest& running : tests) {
    Findings found = running.test.judge(counts);
    judged.detectable = std::max(judged.detectable, found.detectable);
    judged.detectable_cell = std::max(judged.detectable_cell, found.detectable_cell);
    judged.findings.push_back({running.row, std::move(found.checks)});
  }
  return judged;
}

Findings test_cells(const std::vector<Cell>& cells, int dim, double alpha, const std::vector<Axis>& named) {
  Subject subject;
  subject.dim = dim;
  subject.axes = named;
  SubjectOptions options;
  options.alpha = alpha;
  const Pilot pilot;
  const FitSetup setup{subject, options, pilot};
  FitCounts counts{.setup = setup, .pooled = pool(cells)};
  std::vector<RunningTest> tests;
  for (const FitTestRow& row : fit_tests())
    if (row.of_cells && row.applies(subject)) tests.push_back({&row, row.prepare(setup, share_of(row, subject))});
  JudgedTests judged = judge_tests(tests, counts);
  Findings all;
  all.detectable = judged.detectable;
  all.detectable_cell = judged.detectable_cell;
  for (TestFindings& f : judged.findings)
    for (Check& c : f.checks) all.checks.push_back(std::move(c));
  return all;
}

} // namespace mc

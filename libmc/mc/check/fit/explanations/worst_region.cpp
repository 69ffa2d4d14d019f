#include <mc/check/fit/explanations/summary.h>
#include <mc/check/fit/tests/fit_test.h>

#include <algorithm>

namespace mc {

// The test of cells that leads the report begins with the region where the counts are worst.
void explain_by_region(const FitCounts& counts, std::vector<TestFindings>& findings) {
  const std::vector<Check*> checks = checks_of_cells(findings);
  if (std::any_of(checks.begin(), checks.end(), [](const Check* c) { return c->verdict == Verdict::fail; }))
    prepend_finding(checks, describe_worst_region(counts.setup.subject, counts.boxes, counts.cells));
}

} // namespace mc

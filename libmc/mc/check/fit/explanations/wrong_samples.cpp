#include <mc/check/fit/explanations/summary.h>
#include <mc/check/fit/tests/fit_test.h>

#include <algorithm>

namespace mc {
namespace {

// Whether a failed test of the mass shows wrong samples: the samples, which estimate the mass, contradict the density
// also given their number, and random points alone do not find too much mass.
bool is_of_samples(const Check& test, const ClaimedMass& mass, const std::vector<Check*>& of_cells) {
  return test.verdict == Verdict::fail && !mass.by_cubature &&
         std::any_of(of_cells.begin(), of_cells.end(), [](const Check* c) { return c->verdict == Verdict::fail; }) &&
         !(mass.from_points > 1 + 4 * mass.from_points_error);
}

// Changes a failed test of the mass into a finding about the samples, in the worst region.
void blame_samples(Check& test, const std::string& region) {
  if (test.fault == Fault::mass)
    test.detail = "the mean weight of the samples is off, since they do not follow the density";
  test.fault = Fault::shape;
  if (!region.empty()) test.detail = region + "; " + test.detail;
}

} // namespace

FitTest mass_test(const FitSetup&, double);

// A mass that is estimated from wrong samples is no evidence against the density. Its test then follows the tests of
// cells.
void explain_mass_by_samples(const FitCounts& counts, std::vector<TestFindings>& findings) {
  const auto mass = std::find_if(findings.begin(), findings.end(),
                                 [](const TestFindings& f) { return f.row && f.row->prepare == mass_test; });
  if (mass == findings.end() || mass->checks.empty()) return;
  Check& test = mass->checks.front();
  const bool of_samples = is_of_samples(test, counts.mass, checks_of_cells(findings));
  if (!of_samples && test.fault != Fault::shape) return;
  blame_samples(test, describe_worst_region(counts.setup.subject, counts.boxes, counts.cells));
  if (!of_samples) return;
  const auto last =
      std::find_if(findings.rbegin(), findings.rend(), [](const TestFindings& f) { return f.row && f.row->of_cells; });
  std::rotate(mass, mass + 1, last.base());
}

} // namespace mc

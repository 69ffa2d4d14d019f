#include <mc/check/fit/explanations/coarse_axes.h>
#include <mc/check/fit/explanations/rounding.h>
#include <mc/check/fit/tests/fit_test.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {

namespace {
// Relative change of the density when a point moves by one rounding step: the median over the pilot. A formula that
// cancels errs by as much at every point, and so may its integral.
double density_rounding(const Subject& s, const Pilot& pilot) {
  const std::size_t stride = pilot.points.size() / 1000 + 1;
  std::vector<double> changes;
  for (std::size_t i = 0; i < pilot.points.size(); i += stride) {
    double change = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
      Subject::Coordinates v = pilot.points[i];
      v[d] += (v[d] < 0.5 ? 1 : -1) * rounding_step(s, v, d);
      change += std::abs(s.density(v) / pilot.densities[i] - 1);
    }
    if (std::isfinite(change)) changes.push_back(change);
  }
  if (changes.empty()) return 0;
  const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
  std::nth_element(changes.begin(), middle, changes.end());
  return *middle;
}
} // namespace

void explain_mass_by_rounding(const Subject& s, const Pilot& pilot, const ClaimedMass& mass, Check& test) {
  if (test.verdict != Verdict::fail || test.fault != Fault::mass || s.dim == 0) return;
  const double rounding = density_rounding(s, pilot);
  if (std::abs(mass.value - 1) > mass.error + s.mass_tolerance + rounding) return;
  test.verdict = Verdict::inconclusive;
  test.fault = Fault::rounding;
  test.detail =
      fmt::format("the density changes by {:.2g} % between neighbouring points, and so its integral, {:.6g} +- "
                  "{:.2g}, cannot be told from 1: compute it without cancellation, or use a wider scalar",
                  100 * rounding, mass.value, mass.error);
}

// The first test of the mass, if it fails because the density rounds.
void explain_mass_by_rounding(const FitCounts& counts, std::vector<TestFindings>& findings) {
  for (TestFindings& f : findings)
    for (Check& c : f.checks) explain_mass_by_rounding(counts.setup.subject, counts.setup.pilot, counts.mass, c);
}

// Inserts a warning for each axis of find_coarse_axes(). It explains failed statistical tests of the density, except
// along other axes: they are inconclusive.
void explain_by_coarse_axes(const FitCounts& counts, std::vector<TestFindings>& findings) {
  const Subject& s = counts.setup.subject;
  const std::vector<CoarseAxis> coarse = find_coarse_axes(s, counts.setup.pilot);
  if (coarse.empty()) return;
  const auto is_of_another_axis = [&](const Check& c) {
    for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d)
      if (c.name.ends_with(", " + axis_name(s.axes, d)))
        return std::none_of(coarse.begin(), coarse.end(), [&](const CoarseAxis& a) { return a.axis == d; });
    return false;
  };
  bool any = false;
  for (TestFindings& f : findings)
    for (Check& c : f.checks) {
      const bool density = c.fault == Fault::shape || c.fault == Fault::local || c.fault == Fault::atom;
      if (c.verdict != Verdict::fail || !c.p || !density || is_of_another_axis(c)) continue;
      c.verdict = Verdict::inconclusive;
      any = true;
    }
  TestFindings warnings;
  for (const CoarseAxis& axis : coarse) {
    warnings.checks.push_back(axis.finding);
    warnings.checks.back().verdict = any ? Verdict::inconclusive : Verdict::warning;
  }
  findings.insert(findings.begin(), std::move(warnings));
}

} // namespace mc

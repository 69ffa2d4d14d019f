#include <mc/check/fit/expected/mass.h>

#include <mc/check/fit/interior_density.h>
#include <mc/core/sum.h>
#include <mc/core/types.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

// Returns the cuts of a box along an axis on which the pilot fills only [lo, hi]. The steps grow by a factor of four,
// so that a lobe much narrower than the box cannot hide between the nodes.
std::vector<double> cuts_beside(double lo, double hi, const UnitBox& box, std::size_t axis) {
  std::vector<double> cuts;
  const double size = hi - lo;
  if (!(size > 0)) return cuts;
  double step = size, at = lo - size;
  while (at > box.lo[axis] + step) {
    cuts.push_back(at);
    step *= 4;
    at -= step;
  }
  std::reverse(cuts.begin(), cuts.end());
  step = size;
  at = hi + size;
  while (at < box.hi[axis] - step) {
    cuts.push_back(at);
    step *= 4;
    at += step;
  }
  return cuts;
}

// Cuts boxes along an axis, at the ascending cuts inside each box.
std::vector<UnitBox> cut_boxes(const std::vector<UnitBox>& boxes, std::size_t axis, const std::vector<double>& cuts) {
  std::vector<UnitBox> finer;
  for (UnitBox box : boxes) {
    for (const double at : cuts) {
      if (!(at > box.lo[axis] && at < box.hi[axis])) continue;
      finer.push_back(box);
      finer.back().hi[axis] = box.lo[axis] = at;
    }
    finer.push_back(box);
  }
  return finer;
}

PerAxis<double> filled(double x) {
  PerAxis<double> all;
  all.fill(x);
  return all;
}

// Returns the smallest box around the pilot's points in each aligned run of 2^level cells.
std::vector<UnitBox> extents(const PilotCells& cells, const Pilot& pilot, int level) {
  std::vector<UnitBox> extent(static_cast<std::size_t>(cells.partition.size() >> level),
                              UnitBox{filled(2), filled(-1)});
  for (std::size_t i = 0; i < pilot.points.size(); ++i) {
    UnitBox& e = extent[cells.cell_of_point[i] >> level];
    for (std::size_t d = 0; d < max_chart_dim; ++d) {
      e.lo[d] = std::min(e.lo[d], pilot.points[i][d]);
      e.hi[d] = std::max(e.hi[d], pilot.points[i][d]);
    }
  }
  return extent;
}

double sum_of_outcomes(const Subject& s) {
  CompensatedSum sum;
  for (const double p : s.atoms) sum.add(p);
  return sum.value();
}

// A table of n probabilities was divided by a sum of n terms, which rounding changes by up to n epsilons. The bound
// stops at the tolerance for printed probabilities.
double rounding_of_outcomes(const Subject& s) {
  return std::min(static_cast<double>(s.atoms.size()) * s.epsilon, 1e-4);
}

// Returns "1 + 2e-9" for a number whose six digits do not show its distance from 1.
std::string near_one(double x) {
  const double off = x - 1;
  if (off == 0 || std::abs(off) > 1e-3) return fmt::format("{:.6g}", x);
  return fmt::format("1 {} {:.3g}", off < 0 ? '-' : '+', std::abs(off));
}

} // namespace

CubatureResult integrate_density(const Subject& s, const Pilot& pilot, const PilotCells& cells, double n,
                                 std::size_t max_evaluations) {
  CubatureResult unknown;
  unknown.total.error = HUGE_VAL;
  if (s.dim > max_cubature_dim) return unknown;
  // Few boxes: the cubature halves them as needed.
  const int depth = std::min(cells.partition.depth(), 6);
  const std::vector<UnitBox> extent = extents(cells, pilot, cells.partition.depth() - depth);
  std::vector<UnitBox> pieces;
  for (std::size_t i = 0; i < extent.size(); ++i) {
    const UnitBox box = cells.partition.box(static_cast<int>(i), depth);
    std::vector<UnitBox> parts{box};
    for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d)
      parts = cut_boxes(parts, d, cuts_beside(extent[i].lo[d], extent[i].hi[d], box, d));
    pieces.insert(pieces.end(), parts.begin(), parts.end());
  }
  CubatureGoal goal;
  goal.total_error = 0.01 / std::sqrt(n);
  goal.max_evaluations = max_evaluations;
  const double each = goal.total_error / static_cast<double>(pieces.size());
  goal.box_error = [each](double value) { return std::max(each, 1e-3 * value); };
  const BatchFunction density = [&s](std::span<Subject::Coordinates> v, std::span<double> densities) {
    interior_densities(s, v, densities);
  };
  return integrate_boxes(density, s.dim, pieces, goal);
}

ClaimedMass claimed_mass(const Subject& s, const CubatureResult& cubature, const EstimatedMass& reference,
                         const EstimatedMass& uncapped, const SampleWeights& samples) {
  ClaimedMass mass;
  const double n = samples.draws, outcomes = sum_of_outcomes(s);
  // The samples themselves estimate the mass above the caps of the reference.
  const double clipped = (samples.points - samples.sum) / n;
  const double clipped_variance = (samples.points - 2 * samples.sum + samples.squares) / (n * n);
  const double sampled = (samples.squares - sqr(samples.sum) / n) / (n * n);
  mass.estimated = reference.value + clipped + outcomes;
  mass.estimated_error = std::sqrt(std::max(sampled, 0.0) + reference.worst_case_variance() + sqr(s.mass_tolerance));
  mass.z = (samples.sum / n - reference.value) / std::max(mass.estimated_error, 1e-300);
  mass.from_points = uncapped.value + outcomes;
  mass.from_points_error = std::sqrt(uncapped.worst_case_variance()) + s.mass_tolerance;
  if (s.dim == 0) {
    mass.value = outcomes;
    mass.error = rounding_of_outcomes(s);
    return mass;
  }
  // Cubature that missed a jump or a lobe has a larger error than its bound. Its value is accepted within `agreed`
  // standard deviations of an estimate, and the mass may then be wrong by `conceded` of them. A correct density thus
  // fails only if the estimate is off by the difference of 3.5 and the cubature is wrong as well. A jump that no pair
  // of random points shows moves the estimate by at most one pair, rarely by half a pair. The points detect mass where
  // no samples are; the samples detect a lobe that the points miss.
  constexpr double conceded = 5, agreed = 1.5;
  const double by_points = std::sqrt(uncapped.conservative_variance());
  const double by_samples = std::sqrt(reference.conservative_variance() + std::max(clipped_variance, 0.0));
  const double rounding = std::max(s.mass_tolerance, 1e-12); // rounding of sums of many terms
  const double total = cubature.total.value + outcomes, bound = cubature.total.error + rounding;
  mass.by_cubature = !cubature.invalid_point && cubature.total.error <= 1 / std::sqrt(n) &&
                     std::abs(total - outcomes - uncapped.value) <= bound + agreed * by_points + uncapped.jump / 2 &&
                     mass.estimated - total <= bound + agreed * by_samples + reference.jump / 2;
  mass.value = mass.by_cubature ? total : mass.estimated;
  if (!mass.by_cubature) {
    mass.error = 4 * mass.estimated_error;
    return mass;
  }
  mass.error = cubature.total.error + conceded * by_points + std::max(uncapped.jump, reference.jump);
  // A lobe that no point hits adds mass and removes none. Either it fits into one box, below its cap, or no sample hit
  // it. In the latter case it contains at most 4.6 samples with probability .99.
  if (total < 1)
    mass.error = std::max(mass.error, cubature.total.error + conceded * by_samples + reference.jump) +
                 reference.largest + 4.6 / samples.total_points;
  return mass;
}

Check test_mass(const Subject& s, const ClaimedMass& mass, double share, double alpha) {
  const double excess = mass.value - 1, off = s.may_fail ? std::max(excess, 0.0) : std::abs(excess);
  Check c{"mass", Verdict::pass, {}, 0, off, mass.error + s.mass_tolerance, Fault::mass, {}};
  if (mass.by_cubature) {
    if (!(off <= c.limit)) c.verdict = Verdict::fail;
  } else {
    c.p = normal_tail(mass.z);
    c.share = share;
    c.statistic = mass.z;
    if (*c.p <= sidak_level(alpha, c.share)) c.verdict = Verdict::fail;
    else if (!(mass.estimated_error <= 0.03)) c.verdict = Verdict::inconclusive;
  }
  if (c.verdict == Verdict::pass) return c;
  if (s.dim == 0) {
    c.detail = fmt::format("the {} probabilities add up to {}, should be {}1", s.atoms.size(), near_one(mass.value),
                           s.may_fail ? "at most " : "");
    return c;
  }
  c.detail = fmt::format("the density integrates to {:.10g} +- {:.2g}, should be {}1", mass.value, mass.error,
                         s.may_fail ? "at most " : "");
  // Wrong samples where the density is high do not imply a wrong integral.
  if (mass.by_cubature || c.verdict != Verdict::fail || !(mass.from_points_error <= 0.03) ||
      !(std::abs(mass.from_points - 1) <= 4 * mass.from_points_error))
    return c;
  c.fault = Fault::shape;
  c.detail = fmt::format("the samples do not follow the density where it is high; from random points it integrates to "
                         "{:.6g} +- {:.2g}",
                         mass.from_points, mass.from_points_error);
  return c;
}

} // namespace mc

#include <mc/check/fit/explanations/coarse_axes.h>

#include <mc/check/fit/expected/interval_mass.h>
#include <mc/random/hash.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mc {

namespace {

// Returns "cos theta has steps of 3e-7: compute 1 - cos theta, or ...".
std::string describe_step(const std::vector<Axis>& axes, std::size_t axis, double at, double step) {
  if (axis < axes.size() && axes[axis].scale == Axis::Scale::polar)
    return fmt::format("cos {} has steps of {:.2g}: compute 1 - cos {} without cancellation, or use a wider scalar",
                       axes[axis].name, axes[axis].b * step, axes[axis].name);
  const auto value = [&](double v) { return axis < axes.size() ? axes[axis].value(v) : v; };
  return fmt::format("{} has steps of {:.2g}: use a wider scalar, or a domain nearer to 0", axis_name(axes, axis),
                     std::abs(value(std::min(at + step, 1.0)) - value(at)));
}

// Returns the ends of the shortest interval of an axis that contains a quarter of the sorted coordinates.
std::pair<double, double> densest_quarter(const std::vector<double>& sorted) {
  const std::size_t quarter = sorted.size() / 4;
  std::pair<double, double> best{sorted.front(), sorted.back()};
  for (std::size_t i = 0; i + quarter < sorted.size(); ++i)
    if (sorted[i + quarter] - sorted[i] < best.second - best.first) best = {sorted[i], sorted[i + quarter]};
  return best;
}

// Whether the density claims an eighth or more for the interval. Else the samples crowd there against the density.
bool is_claimed(const Subject& s, const Pilot& pilot, std::size_t axis, double lo, double hi) {
  IntervalQuery query{.axis = axis, .lo = std::max(lo, 0.0), .hi = std::min(hi, 1.0), .near = {}, .mass = 0.25};
  for (std::uint32_t i = 0; i < pilot.points.size(); ++i)
    if (pilot.points[i][axis] >= query.lo && pilot.points[i][axis] <= query.hi) query.near.push_back(i);
  const EstimatedMass mass = interval_mass(s, pilot, query, hash(axis, 17), Effort::quick);
  return mass.value + 4 * std::sqrt(mass.conservative_variance()) >= 0.125;
}

} // namespace

std::vector<CoarseAxis> find_coarse_axes(const Subject& s, const Pilot& pilot) {
  std::vector<CoarseAxis> coarse;
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim) && !pilot.points.empty(); ++d) {
    const auto [lo, hi] = densest_quarter(pilot.sorted[d]);
    double step = 0;
    for (const std::uint32_t i : pilot.nearest(d, 0.5 * (lo + hi), 16))
      step = std::max(step, rounding_step(s, pilot.points[i], d));
    const double steps = (hi - lo) / step, margin = min_resolved_steps * step;
    if (!(steps < min_resolved_steps) || !is_claimed(s, pilot, d, lo - margin, hi + margin)) continue;
    Check c{"resolution, " + axis_name(s.axes, d),
            Verdict::inconclusive,
            {},
            0,
            steps,
            min_resolved_steps,
            Fault::rounding,
            {}};
    c.detail = fmt::format("{}; a quarter of the samples lie in {}, {:.2g} steps wide, where the density cannot be "
                           "tested",
                           describe_step(s.axes, d, hi, step), describe_range(s.axes, d, lo, hi), steps);
    coarse.push_back({d, std::move(c)});
  }
  return coarse;
}

} // namespace mc

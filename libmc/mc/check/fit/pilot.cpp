#include <mc/check/fit/pilot.h>

#include <mc/stats/sort_numbers.h>

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

} // namespace

double Pilot::rank(std::size_t axis, double v) const {
  const std::vector<double>& s = sorted[axis];
  const auto below = std::lower_bound(s.begin(), s.end(), v) - s.begin();
  return static_cast<double>(below) / static_cast<double>(std::max<std::size_t>(s.size(), 1));
}

std::vector<std::uint32_t> Pilot::nearest(std::size_t axis, double v, std::size_t count) const {
  const std::vector<double>& s = sorted[axis];
  std::size_t hi = static_cast<std::size_t>(std::lower_bound(s.begin(), s.end(), v) - s.begin()), lo = hi;
  while (hi - lo < std::min(count, s.size())) {
    const bool down = hi == s.size() || (lo > 0 && v - s[lo - 1] < s[hi] - v);
    if (down) --lo;
    else ++hi;
  }
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < points.size() && found.size() < hi - lo; ++i)
    if (points[i][axis] >= s[lo] && points[i][axis] <= s[hi - 1]) found.push_back(static_cast<std::uint32_t>(i));
  return found;
}

Pilot draw_pilot(const Subject& s, std::uint64_t seed, std::uint64_t samples) {
  Pilot pilot;
  pilot.stats = draw_samples(s, seed, pilot_samples(samples),
                             [&](std::span<const Subject::Coordinates> v, std::span<const double> densities) {
                               pilot.points.insert(pilot.points.end(), v.begin(), v.end());
                               pilot.densities.insert(pilot.densities.end(), densities.begin(), densities.end());
                             });
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    for (const Subject::Coordinates& v : pilot.points) pilot.sorted[d].push_back(v[d]);
    sort_numbers(pilot.sorted[d]);
  }
  return pilot;
}

std::vector<Check> find_unresolved(const Subject& s, const Pilot& pilot) {
  constexpr double least = 2 * min_resolved_steps;
  std::vector<Check> checks;
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    double step = 1;
    for (const Subject::Coordinates& v : pilot.points) step = std::min(step, rounding_step(s, v, d));
    if (pilot.points.empty() || !(step * least > 1)) continue;
    Check c{"resolution, " + axis_name(s.axes, d), Verdict::inconclusive, {}, 0, 1 / step, least, Fault::none, {}};
    c.detail = fmt::format("{} has too few distinct values to test a density along it; compute it in double, or on a "
                           "domain nearer to 0",
                           describe_range(s.axes, d, 0, 1));
    checks.push_back(std::move(c));
  }
  return checks;
}

namespace {

// Returns the ends of the shortest interval of an axis that contains a quarter of the sorted coordinates.
std::pair<double, double> densest_quarter(const std::vector<double>& sorted) {
  const std::size_t quarter = sorted.size() / 4;
  std::pair<double, double> best{sorted.front(), sorted.back()};
  for (std::size_t i = 0; i + quarter < sorted.size(); ++i)
    if (sorted[i + quarter] - sorted[i] < best.second - best.first) best = {sorted[i], sorted[i + quarter]};
  return best;
}

} // namespace

std::vector<Check> find_coarse(const Subject& s, const Pilot& pilot) {
  std::vector<Check> checks;
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim) && !pilot.points.empty(); ++d) {
    const auto [lo, hi] = densest_quarter(pilot.sorted[d]);
    double step = 0;
    for (const std::uint32_t i : pilot.nearest(d, 0.5 * (lo + hi), 16))
      step = std::max(step, rounding_step(s, pilot.points[i], d));
    // A quarter of equal samples is an atom, unless the other samples nearby lie on the lattice, too.
    const std::vector<double>& sorted = pilot.sorted[d];
    const auto above = std::upper_bound(sorted.begin(), sorted.end(), hi);
    const bool is_atom = lo == hi && (above == sorted.end() || *above - hi > 4 * step);
    const double steps = (hi - lo) / step;
    if (is_atom || !(steps < min_resolved_steps)) continue;
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
    checks.push_back(std::move(c));
  }
  return checks;
}

std::uint64_t pilot_samples(std::uint64_t samples) { return std::clamp<std::uint64_t>(samples / 8, 1000, 1 << 20); }

} // namespace mc

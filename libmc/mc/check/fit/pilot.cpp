#include <mc/check/fit/pilot.h>

#include <mc/stats/sort_numbers.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {
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

std::uint64_t pilot_samples(std::uint64_t samples) { return std::clamp<std::uint64_t>(samples / 8, 1000, 1 << 20); }

} // namespace mc

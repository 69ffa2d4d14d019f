#include <mc/check/fit/pilot.h>

#include <algorithm>

namespace mc {

double Pilot::rank(std::size_t axis, double v) const {
  const std::vector<double>& s = sorted[axis];
  const auto below = std::lower_bound(s.begin(), s.end(), v) - s.begin();
  return static_cast<double>(below) / static_cast<double>(std::max<std::size_t>(s.size(), 1));
}

Pilot draw_pilot(const Subject& s, std::uint64_t seed, std::uint64_t samples) {
  Pilot pilot;
  pilot.tally =
      draw_samples(s, seed, pilot_samples(samples), [&](const Subject::Coordinates& v) { pilot.points.push_back(v); });
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    for (const Subject::Coordinates& v : pilot.points) pilot.sorted[d].push_back(v[d]);
    std::sort(pilot.sorted[d].begin(), pilot.sorted[d].end());
  }
  return pilot;
}

std::uint64_t pilot_samples(std::uint64_t samples) { return std::clamp<std::uint64_t>(samples / 8, 1000, 1 << 20); }

} // namespace mc

#include <mc/check/fit/pilot.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace mc {

double Pilot::rank(std::size_t axis, double v) const {
  const std::vector<double>& s = sorted[axis];
  const auto below = std::lower_bound(s.begin(), s.end(), v) - s.begin();
  return static_cast<double>(below) / static_cast<double>(std::max<std::size_t>(s.size(), 1));
}

std::vector<Subject::Coordinates> Pilot::nearest(std::size_t axis, double v) const {
  std::vector<Subject::Coordinates> found(std::min<std::size_t>(16, points.size()));
  std::partial_sort_copy(points.begin(), points.end(), found.begin(), found.end(),
                         [&](const auto& a, const auto& b) { return std::abs(a[axis] - v) < std::abs(b[axis] - v); });
  return found;
}

Pilot draw_pilot(const Subject& s, std::uint64_t seed, std::uint64_t samples) {
  Pilot pilot;
  pilot.tally = draw_samples(s, seed, pilot_samples(samples), [&](const Subject::Coordinates& v, double density) {
    pilot.points.push_back(v);
    pilot.densities.push_back(density);
  });
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    for (const Subject::Coordinates& v : pilot.points) pilot.sorted[d].push_back(v[d]);
    sort_numbers(pilot.sorted[d]);
  }
  return pilot;
}

std::uint64_t pilot_samples(std::uint64_t samples) { return std::clamp<std::uint64_t>(samples / 8, 1000, 1 << 20); }

void sort_numbers(std::vector<double>& values) {
  if (values.size() < 1 << 14) return std::sort(values.begin(), values.end());
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  std::vector<std::uint64_t> keys, other(values.size());
  keys.reserve(values.size());
  // Bits that order as the numbers do.
  for (const double v : values) {
    const auto bits = std::bit_cast<std::uint64_t>(v);
    keys.push_back(bits & sign ? ~bits : bits | sign);
  }
  for (int shift = 0; shift < 64; shift += 11) {
    std::array<std::size_t, 2049> first{};
    for (const std::uint64_t k : keys) ++first[(k >> shift & 2047) + 1];
    for (std::size_t d = 1; d < first.size(); ++d) first[d] += first[d - 1];
    for (const std::uint64_t k : keys) other[first[k >> shift & 2047]++] = k;
    keys.swap(other);
  }
  for (std::size_t i = 0; i < keys.size(); ++i)
    values[i] = std::bit_cast<double>(keys[i] & sign ? keys[i] & ~sign : ~keys[i]);
}

} // namespace mc

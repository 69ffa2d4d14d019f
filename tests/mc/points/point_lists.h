#pragma once
/// Point lists for tests.

#include <mc/points/point_list.h>
#include <mc/sampler/concept.h>

#include <cstdint>
#include <vector>

namespace test {

/// Multiples of 1 / 1021 that have no pattern: in Python, [[((i+1) * a[k] * (k+3) % 1021) / 1021 for k in range(dim)]
/// for i in range(n)].
inline std::vector<double> scattered(std::uint64_t n, std::uint64_t dim) {
  constexpr std::uint64_t a[] = {1, 377, 610, 233, 89, 144, 55, 34};
  std::vector<double> points;
  for (std::uint64_t i = 0; i < n; ++i)
    for (std::uint64_t k = 0; k < dim; ++k)
      points.push_back(static_cast<double>((i + 1) * a[k] * (k + 3) % 1021) / 1021);
  return points;
}

template <mc::Sampler T> std::vector<double> points_of(const T& sampler, std::uint64_t n, std::uint32_t dim) {
  std::vector<double> points;
  for (std::uint64_t i = 0; i < n; ++i)
    for (std::uint32_t k = 0; k < dim; ++k) points.push_back(mc::coordinate<double>(sampler, i, k));
  return points;
}

/// i / 8 and its three bits reversed, plus a shift.
inline std::vector<double> hammersley(double shift) {
  std::vector<double> points;
  for (const int i : {0, 4, 2, 6, 1, 5, 3, 7}) {
    const std::size_t place = points.size() / 2;
    points.push_back(static_cast<double>(place) / 8 + shift);
    points.push_back(i / 8.0 + shift);
  }
  return points;
}

} // namespace test

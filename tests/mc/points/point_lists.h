#pragma once
/// Point lists for tests.

#include <mc/points/point_list.h>
#include <mc/sampler/concept.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace test {

/// Multiples of 1 / 1021 without a pattern. In Python: [[((i+1) * a[k] * (k+3) % 1021) / 1021 for k in range(dim)] for
/// i in range(n)].
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

/// Hammersley points (i / 8, reversed bits of i / 8), shifted.
inline std::vector<double> hammersley(double shift) {
  std::vector<double> points;
  for (const int i : {0, 4, 2, 6, 1, 5, 3, 7}) {
    const std::size_t place = points.size() / 2;
    points.push_back(static_cast<double>(place) / 8 + shift);
    points.push_back(i / 8.0 + shift);
  }
  return points;
}

/// Star discrepancy by enumeration of all open and closed boxes with corners on the coordinates.
inline double star_by_all_boxes(mc::PointList p) {
  std::vector<std::vector<double>> grid(p.dim);
  for (std::size_t k = 0; k < p.dim; ++k) {
    for (std::size_t i = 0; i < p.size(); ++i) grid[k].push_back(p[i][k]);
    grid[k].push_back(1);
  }
  double worst = 0;
  std::vector<std::size_t> at(p.dim, 0);
  for (;;) {
    double volume = 1, open = 0, closed = 0;
    for (std::size_t k = 0; k < p.dim; ++k) volume *= grid[k][at[k]];
    for (std::size_t i = 0; i < p.size(); ++i) {
      bool below = true, within = true;
      for (std::size_t k = 0; k < p.dim; ++k) {
        below = below && p[i][k] < grid[k][at[k]];
        within = within && p[i][k] <= grid[k][at[k]];
      }
      open += below;
      closed += within;
    }
    const double n = static_cast<double>(p.size());
    worst = std::max({worst, volume - open / n, closed / n - volume});
    std::size_t k = 0;
    while (k < p.dim && ++at[k] == grid[k].size()) at[k++] = 0;
    if (k == p.dim) return worst;
  }
}

} // namespace test

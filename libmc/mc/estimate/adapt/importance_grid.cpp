#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/estimate/adapt/importance_grid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace mc {

namespace {
constexpr double uniform_share = 0.05; // of the probability, in each dimension
constexpr double jump_share = 0.5;     // share of the height of a jump that counts as mass
constexpr double enough = 8;           // effective points behind each estimate of the power of a bin

// Index of entry j in a row of n entries that is mirrored at its ends.
std::size_t mirrored(std::ptrdiff_t j, std::ptrdiff_t n) {
  if (j < 0) j = -1 - j;
  if (j >= n) j = 2 * n - 1 - j;
  return static_cast<std::size_t>(j);
}

// Weighted mean over neighbours up to distance `reach`, with linearly decreasing weights.
std::array<double, ImportanceGrid::bins> pooled(std::span<const double> row, std::ptrdiff_t reach) {
  std::array<double, ImportanceGrid::bins> out;
  const auto n = static_cast<std::ptrdiff_t>(row.size());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::ptrdiff_t j = i - reach; j <= i + reach; ++j)
      sum += static_cast<double>(reach + 1 - std::abs(j - i)) * row[mirrored(j, n)];
    out[static_cast<std::size_t>(i)] = sum / sqr(static_cast<double>(reach + 1));
  }
  return out;
}

// Limits the growth of bin widths in one direction. A bin more than `ratio` times wider than its predecessor is cut, so
// that each new bin is at most ratio / 2 times wider than the bin before it.
std::vector<double> widened(std::vector<double> edges, double ratio, bool upwards) {
  constexpr double least = 0x1p-50;
  if (!upwards) std::reverse(edges.begin(), edges.end());
  std::vector<double> cut = {edges[0], edges[1]};
  for (std::size_t i = 1; i + 1 < edges.size(); ++i) {
    double width = std::max(std::abs(edges[i] - edges[i - 1]), least);
    while (std::abs(edges[i + 1] - cut.back()) > ratio * width) {
      width *= ratio / 2;
      cut.push_back(cut.back() + (upwards ? width : -width));
    }
    cut.push_back(edges[i + 1]);
  }
  if (!upwards) std::reverse(cut.begin(), cut.end());
  return cut;
}

// Makes bin widths grow gradually away from narrow bins. The flanks of a peak lie in the neighbouring bins. If these
// are hundreds of times wider, hardly any point hits the flanks. Creates at most a quarter more bins, then
// redistributes the edges over the original number of bins.
void grade(std::array<double, ImportanceGrid::bins + 1>& edges) {
  constexpr std::size_t bins = ImportanceGrid::bins;
  const std::vector<double> plain(edges.begin(), edges.end());
  std::vector<double> cut = plain;
  for (int bits = 3; bits < 50; bits += 3) {
    const double ratio = std::ldexp(1.0, bits);
    cut = widened(widened(plain, ratio, true), ratio, false);
    if (cut.size() <= bins + bins / 4) break;
    cut = plain;
  }
  for (std::size_t k = 1; k < bins; ++k) {
    const std::size_t place = k * (cut.size() - 1), i = place / bins;
    const double share = static_cast<double>(place % bins) / bins;
    edges[k] = std::max(edges[k - 1], cut[i] + share * (cut[i + 1] - cut[i]));
  }
}
} // namespace

ImportanceGrid::ImportanceGrid(int dim) : dim_(dim), edges_(static_cast<std::size_t>(dim) * (bins + 1)) {
  require(dim >= 1, "ImportanceGrid: dimension {} must be at least 1", dim);
  for (std::size_t i = 0; i < edges_.size(); ++i) edges_[i] = static_cast<double>(i % (bins + 1)) / bins;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) index(d);
}

ImportanceGrid::ImportanceGrid(std::vector<double> edges)
    : dim_(static_cast<int>(edges.size() / (bins + 1))), edges_(std::move(edges)) {
  require(!edges_.empty() && edges_.size() % (bins + 1) == 0, "ImportanceGrid: {} edges; {} are needed for each axis",
          edges_.size(), bins + 1);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const std::size_t axis = i / (bins + 1), at = i % (bins + 1);
    require(at > 0 ? edges_[i] >= edges_[i - 1] : edges_[i] == 0,
            "ImportanceGrid: edge {} of axis {} is {}; they must go from 0 to 1 without falling", at, axis, edges_[i]);
    require(at < bins || edges_[i] == 1, "ImportanceGrid: the last edge of axis {} is {}; it must be 1", axis,
            edges_[i]);
  }
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim_); ++d) index(d);
}

void ImportanceGrid::index(std::size_t d) {
  const auto n = static_cast<std::size_t>(dim_);
  heights_.resize(n * bins);
  first_.resize(n * (cells + 1));
  const double* e = edges_.data() + d * (bins + 1);
  for (std::size_t i = 0; i < bins; ++i) heights_[d * bins + i] = 1 / (bins * (e[i + 1] - e[i]));
  for (std::size_t c = 0; c <= cells; ++c) {
    const double* above = std::upper_bound(e + 1, e + bins, static_cast<double>(c) / cells);
    first_[d * (cells + 1) + c] = static_cast<std::uint8_t>(above - e - 1);
  }
}

std::size_t ImportanceGrid::bin(std::size_t d, double x) const {
  const double* e = edges_.data() + d * (bins + 1);
  const std::uint8_t* cell = first_.data() + d * (cells + 1) + static_cast<std::size_t>(x * cells);
  return static_cast<std::size_t>(std::upper_bound(e + cell[0] + 1, e + cell[1] + 1, x) - e - 1);
}

std::span<const double> ImportanceGrid::edges(int d) const {
  return {edges_.data() + static_cast<std::size_t>(d) * (bins + 1), bins + 1};
}

double ImportanceGrid::map(std::span<double> u) const {
  double jacobian = 1;
  const double* e = edges_.data();
  for (double& coordinate : u) {
    const double scaled = coordinate * bins;
    const auto i = static_cast<std::size_t>(scaled);
    const double width = e[i + 1] - e[i];
    coordinate = std::min(e[i] + (scaled - static_cast<double>(i)) * width, one_minus_epsilon<double>);
    jacobian *= bins * width;
    e += bins + 1;
  }
  return jacobian;
}

double ImportanceGrid::density(std::span<const double> x) const {
  double density = 1;
  for (std::size_t d = 0; d < x.size(); ++d) density *= heights_[d * bins + bin(d, x[d])];
  return density;
}

double ImportanceGrid::invert(std::span<double> x) const {
  double density = 1;
  for (std::size_t d = 0; d < x.size(); ++d) {
    const std::size_t i = bin(d, x[d]);
    const double height = heights_[d * bins + i], above = x[d] - edges_[d * (bins + 1) + i];
    x[d] = std::min(static_cast<double>(i) / bins + above * height, one_minus_epsilon<double>);
    density *= height;
  }
  return density;
}

void ImportanceGrid::refine(std::span<const double> power, double points) {
  MC_ASSERT(power.size() == static_cast<std::size_t>(dim_) * bins);
  std::array<double, bins> mass;
  std::array<double, bins + 1> edges;
  // Few points give a noisy estimate for each bin. A density that follows the noise has huge weights where it is too
  // low, and the next sums would err by more than their error bar. Bins are therefore pooled with neighbours until they
  // have enough points.
  const auto reach = static_cast<std::ptrdiff_t>(std::clamp(std::ceil(enough * bins / points) - 1, 0.0, bins / 2.0));
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim_); ++d) {
    const std::array<double, bins> p = pooled(power.subspan(d * bins, bins), reach);
    double* e = edges_.data() + d * (bins + 1);
    double total = 0;
    for (std::size_t i = 0; i < bins; ++i) {
      const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, bins - 1);
      // Neighbours damp the noise of a round. A density cannot follow a jump of the integrand inside a bin, so
      // additional edges move to the jump.
      const auto size = [&](std::size_t j) { return std::sqrt(p[j]) / std::max(e[j + 1] - e[j], 1e-300); };
      const double jump =
          std::max(std::abs(size(i) - size(before)), std::abs(size(after) - size(i))) * (e[i + 1] - e[i]);
      total += mass[i] = std::sqrt((p[before] + 2 * p[i] + p[after]) / 4) + jump_share * jump;
    }
    if (!(total > 0) || !std::isfinite(total)) continue; // no nonzero values: keep the edges
    for (std::size_t i = 0; i < bins; ++i)
      mass[i] = (1 - uniform_share) * mass[i] / total + uniform_share * (e[i + 1] - e[i]);
    edges[0] = 0;
    edges[bins] = 1;
    double below = 0; // mass of the old bins below i
    for (std::size_t i = 0, k = 1; k < bins; ++k) {
      const double target = static_cast<double>(k) / bins;
      while (i + 1 < bins && below + mass[i] < target) below += mass[i++];
      const double share = std::clamp((target - below) / mass[i], 0.0, 1.0);
      edges[k] = std::max(edges[k - 1], e[i] + share * (e[i + 1] - e[i]));
    }
    grade(edges);
    std::copy(edges.begin(), edges.end(), e);
    index(d);
  }
}

} // namespace mc

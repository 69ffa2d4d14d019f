#include <mc/check/fit/expected/partition.h>

#include <mc/core/error.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace mc {

double shortest_binary_fraction(double a, double b) {
  double step = 1;
  while (step > 0) {
    const double candidate = std::floor(b / step) * step;
    if (candidate > a) return candidate;
    step /= 2;
  }
  return b;
}

// Splits nodes; `points` are the pilot points in a node.
struct Partition::Builder {
  Partition& partition;
  const MaySplit& may_split;
  using Points = std::span<Coordinates>;

  // Returns the split of an axis; no value if it cannot divide the pilot.
  static std::optional<double> quantile(Points points, const UnitBox& box, std::size_t axis) {
    if (points.size() < 2) return {};
    // A thousand points locate the quantiles accurately enough.
    const std::size_t every = std::max<std::size_t>(points.size() / 1024, 1);
    std::vector<double> values;
    for (std::size_t i = 0; i < points.size(); i += every) values.push_back(points[i][axis]);
    const auto n = static_cast<std::ptrdiff_t>(values.size());
    const auto k_lo = std::min(static_cast<std::ptrdiff_t>(0.45 * static_cast<double>(n)), n - 2);
    const auto k_hi = std::max(k_lo + 1, static_cast<std::ptrdiff_t>(0.55 * static_cast<double>(n)));
    const auto at = values.begin();
    std::nth_element(at, at + k_lo, values.end());
    const double lo = at[k_lo];
    std::nth_element(at + k_lo + 1, at + k_hi, values.end());
    const double hi = at[k_hi];
    if (lo < hi) return shortest_binary_fraction(lo, hi);
    // A tenth of the pilot has one value: cuts the atom off, below it or just above.
    if (std::any_of(points.begin(), points.end(), [&](const Coordinates& v) { return v[axis] < lo; })) return lo;
    const double above = std::nextafter(hi, 2.0);
    if (above < box.hi[axis]) return above;
    return {};
  }

  // Axes alternate, except axes along which the box cannot be cut.
  Split place(const UnitBox& box, Points points, int level) const {
    const auto dim = static_cast<std::uint32_t>(partition.dim_), first = static_cast<std::uint32_t>(level) % dim;
    bool refused = false;
    for (std::uint32_t i = 0; i < dim; ++i) {
      const std::uint32_t axis = (first + i) % dim;
      const auto at = quantile(points, box, axis);
      if (!at || !(*at > box.lo[axis] && *at < box.hi[axis])) continue;
      if (!may_split || may_split(box, axis, *at, points[points.size() / 2])) return {*at, axis};
      refused = true;
    }
    const double middle = 0.5 * (box.lo[first] + box.hi[first]);
    if (may_split && !points.empty()) refused = refused || !may_split(box, first, middle, points[points.size() / 2]);
    return {refused ? no_split : middle, first};
  }

  void split(int node, const UnitBox& box, Points points, int level) {
    if (level == partition.depth_) return;
    const Split s = partition.splits_[static_cast<std::size_t>(node)] = place(box, points, level);
    const auto upper =
        std::partition(points.begin(), points.end(), [&](const Coordinates& v) { return v[s.axis] < s.position; });
    const auto below = static_cast<std::size_t>(upper - points.begin());
    const auto [left, right] = halves(box, s);
    split(2 * node, left, points.first(below), level + 1);
    split(2 * node + 1, right, points.subspan(below), level + 1);
  }
};

Partition::Partition(std::vector<Coordinates> pilot, int dim, int depth, const MaySplit& may_split)
    : dim_(dim), depth_(depth) {
  require(dim >= 1 && dim <= int(max_chart_dim), "Partition: dim {} must lie in 1..{}", dim, max_chart_dim);
  require(depth >= 0 && depth <= 24, "Partition: depth {} must lie in 0..24", depth);
  splits_.resize(static_cast<std::size_t>(size()));
  Builder{*this, may_split}.split(1, UnitBox{}, pilot, 0);
}

std::array<UnitBox, 2> Partition::halves(const UnitBox& box, const Split& s) {
  std::array<UnitBox, 2> half{box, box};
  half[0].hi[s.axis] = half[1].lo[s.axis] = std::min(s.position, box.hi[s.axis]);
  return half;
}

std::vector<std::uint32_t> Partition::find_cells(const std::vector<Coordinates>& points) const {
  std::vector<std::uint32_t> cells(points.size(), 1);
  for (int level = 0; level < depth_; ++level)
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Split& s = splits_[cells[i]];
      cells[i] = 2 * cells[i] + (points[i][s.axis] >= s.position);
    }
  for (std::uint32_t& c : cells) c -= static_cast<std::uint32_t>(size());
  return cells;
}

UnitBox Partition::box(int run, int depth) const {
  UnitBox b;
  for (int level = 0, node = 1; level < depth; ++level) {
    const bool upper = (run >> (depth - 1 - level)) & 1;
    b = halves(b, splits_[static_cast<std::size_t>(node)])[upper];
    node = 2 * node + upper;
  }
  return b;
}

} // namespace mc

#include <mc/check/fit/expected/partition.h>

#include <mc/core/error.h>

#include <algorithm>
#include <cmath>
#include <optional>

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

Partition::Partition(std::vector<Coordinates> pilot, int dim, int depth) : dim_(dim), depth_(depth) {
  require(dim >= 1 && dim <= 3, "Partition: dim {} must lie in 1..3", dim);
  require(depth >= 0 && depth <= 24, "Partition: depth {} must lie in 0..24", depth);
  splits_.resize(static_cast<std::size_t>(size()));
  split(1, UnitBox{}, pilot.data(), pilot.data() + pilot.size(), 0);
}

void Partition::split(int node, const UnitBox& box, Coordinates* begin, Coordinates* end, int level) {
  if (level == depth_) return;
  // The place for a split of this axis; none when the pilot cannot be divided there.
  const auto place = [&](std::uint32_t axis) -> std::optional<double> {
    if (end - begin < 2) return {};
    // A thousand of the points place the quantiles well enough.
    const std::ptrdiff_t every = std::max<std::ptrdiff_t>((end - begin) / 1024, 1);
    std::vector<double> values;
    for (std::ptrdiff_t i = 0; i < end - begin; i += every) values.push_back(begin[i][axis]);
    const auto n = static_cast<std::ptrdiff_t>(values.size());
    const auto k_lo = std::min(static_cast<std::ptrdiff_t>(0.45 * static_cast<double>(n)), n - 2);
    const auto k_hi = std::max(k_lo + 1, static_cast<std::ptrdiff_t>(0.55 * static_cast<double>(n)));
    const auto at = values.begin();
    std::nth_element(at, at + k_lo, values.end());
    const double lo = at[k_lo];
    std::nth_element(at + k_lo + 1, at + k_hi, values.end());
    const double hi = at[k_hi];
    if (lo < hi) return shortest_binary_fraction(lo, hi);
    // A tenth of the pilot on one value: cut the atom off, below it or just above.
    const bool below = std::any_of(begin, end, [&](const Coordinates& v) { return v[axis] < lo; });
    if (below) return lo;
    const double above = std::nextafter(hi, 2.0);
    if (above < box.hi[axis]) return above;
    return {};
  };

  const auto first = static_cast<std::uint32_t>(level % dim_);
  Split& s = splits_[static_cast<std::size_t>(node)];
  s = {0.5 * (box.lo[first] + box.hi[first]), first};
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(dim_); ++i) {
    const std::uint32_t axis = (first + i) % static_cast<std::uint32_t>(dim_);
    if (const auto at = place(axis); at && *at > box.lo[axis] && *at < box.hi[axis]) {
      s = {*at, axis};
      break;
    }
  }
  const double at = s.at;
  const std::uint32_t axis = s.axis;
  Coordinates* middle = std::partition(begin, end, [&](const Coordinates& v) { return v[axis] < at; });
  UnitBox left = box, right = box;
  left.hi[axis] = right.lo[axis] = at;
  split(2 * node, left, begin, middle, level + 1);
  split(2 * node + 1, right, middle, end, level + 1);
}

std::vector<std::uint32_t> Partition::find_cells(const std::vector<Coordinates>& points) const {
  std::vector<std::uint32_t> cells(points.size(), 1);
  for (int level = 0; level < depth_; ++level)
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Split& s = splits_[cells[i]];
      cells[i] = 2 * cells[i] + (points[i][s.axis] >= s.at);
    }
  for (std::uint32_t& c : cells) c -= static_cast<std::uint32_t>(size());
  return cells;
}

UnitBox Partition::box(int run, int depth) const {
  UnitBox b;
  for (int level = 0, node = 1; level < depth; ++level) {
    const Split& s = splits_[static_cast<std::size_t>(node)];
    const bool right = (run >> (depth - 1 - level)) & 1;
    (right ? b.lo : b.hi)[s.axis] = s.at;
    node = 2 * node + right;
  }
  return b;
}

} // namespace mc

#include <mc/check/fit/expected/partition.h>

#include <mc/core/error.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace mc {

double shortest_binary_fraction(double a, double b) {
  for (double step = 1; step > 0; step /= 2) {
    const double candidate = std::floor(b / step) * step;
    if (candidate > a) return candidate;
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
    const auto n = end - begin;
    if (n < 2) return {};
    const auto less = [axis](const Coordinates& a, const Coordinates& b) { return a[axis] < b[axis]; };
    const auto k_lo = std::min(static_cast<std::ptrdiff_t>(0.45 * static_cast<double>(n)), n - 2);
    const auto k_hi = std::max(k_lo + 1, static_cast<std::ptrdiff_t>(0.55 * static_cast<double>(n)));
    std::nth_element(begin, begin + k_lo, end, less);
    const double lo = begin[k_lo][axis];
    std::nth_element(begin + k_lo + 1, begin + k_hi, end, less);
    const double hi = begin[k_hi][axis];
    if (lo < hi) return shortest_binary_fraction(lo, hi);
    // A tenth of the pilot on one value: cut the atom off, below it or just above.
    const bool below = std::any_of(begin, begin + k_lo, [&](const Coordinates& v) { return v[axis] < lo; });
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

UnitBox Partition::box(int cell) const {
  UnitBox b;
  for (int level = 0, node = 1; level < depth_; ++level) {
    const Split& s = splits_[static_cast<std::size_t>(node)];
    const bool right = (cell >> (depth_ - 1 - level)) & 1;
    (right ? b.lo : b.hi)[s.axis] = s.at;
    node = 2 * node + right;
  }
  return b;
}

} // namespace mc

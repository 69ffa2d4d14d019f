#include <mc/points/net.h>

#include <bit>
#include <cmath>
#include <vector>

namespace mc {

namespace {

// Whether each box of a grid with 2^halvings[k] intervals along axis k contains `expected` points.
bool is_even(PointList p, const std::vector<int>& halvings, std::uint32_t expected,
             std::vector<std::uint32_t>& counts) {
  std::fill(counts.begin(), counts.end(), 0u);
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::size_t box = 0;
    for (std::size_t k = 0; k < p.dim; ++k)
      box = (box << halvings[k]) + static_cast<std::size_t>(std::ldexp(p[i][k], halvings[k]));
    if (++counts[box] > expected) return false;
  }
  return true; // no box has more than `expected`, so none has fewer
}

// Enumerates all grids with a given total number of halvings.
class Shapes {
 public:
  Shapes(PointList p, int halvings, std::uint64_t& work)
      : p_(p), work_(work), expected_(static_cast<std::uint32_t>(p.size() >> halvings)),
        counts_(std::size_t{1} << halvings), shape_(p.dim, 0) {}

  // Whether all grids with `left` halvings of the axes from `axis` on are even. Returns nullopt if the work does not
  // suffice.
  std::optional<bool> all_even(std::size_t axis, int left) {
    if (axis + 1 == p_.dim) {
      shape_[axis] = left;
      if (work_ < p_.size()) return {};
      work_ -= p_.size();
      return is_even(p_, shape_, expected_, counts_);
    }
    for (shape_[axis] = 0; shape_[axis] <= left; ++shape_[axis]) {
      const std::optional<bool> rest = all_even(axis + 1, left - shape_[axis]);
      if (rest != true) return rest;
    }
    return true;
  }

 private:
  PointList p_;
  std::uint64_t& work_;
  std::uint32_t expected_;
  std::vector<std::uint32_t> counts_;
  std::vector<int> shape_;
};

} // namespace

std::optional<int> net_quality(PointList points, std::uint64_t work) {
  require_unit_points(points);
  if (!std::has_single_bit(points.size())) return {};
  const int m = std::countr_zero(points.size());
  for (int t = 0; t < m; ++t) {
    const std::optional<bool> even = Shapes(points, m - t, work).all_even(0, m - t);
    if (!even) return {};
    if (*even) return t;
  }
  return m;
}

} // namespace mc

#pragma once
/// Points of the unit cube side by side in memory.

#include <cstddef>
#include <span>

namespace mc {

/// A finite point set that is looked at and not owned: coordinate k of point i is values[i * dim + k], in [0,1).
struct PointList {
  std::span<const double> values;
  std::size_t dim;

  std::size_t size() const { return values.size() / dim; }
  const double* operator[](std::size_t i) const { return values.data() + i * dim; }
};

/// Throws Error unless there is a point, 1 <= dim, the length is a multiple of dim, and every coordinate lies in [0,1).
void require_unit_points(PointList points);

} // namespace mc

#pragma once
/// Points of the unit cube in contiguous memory.

#include <cstddef>
#include <span>

namespace mc {

/// Non-owning view of a finite point set. Coordinate k of point i is values[i * dim + k], in [0,1).
struct PointList {
  std::span<const double> values; ///< Coordinates, point after point.
  std::size_t dim;                ///< Number of dimensions.

  /// Number of points.
  std::size_t size() const { return values.size() / dim; }
  /// Pointer to the coordinates of point i.
  const double* operator[](std::size_t i) const { return values.data() + i * dim; }
};

/// Throws Error unless there is at least one point, dim >= 1, the length is a multiple of dim, and every coordinate is
/// in [0,1).
void require_unit_points(PointList points);

} // namespace mc

#pragma once
/// The map from the unit cube to a box, whose sides may be infinite.

#include <integrands/variable_bounds.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace carlo {

/// Maps each coordinate as map_to_bounds.
class BoxMap {
 public:
  /// throws : Error if the product of the finite sides overflows or underflows.
  explicit BoxMap(std::vector<VariableBounds> bounds);

  const std::vector<VariableBounds>& bounds() const { return bounds_; }
  std::size_t dim() const { return bounds_.size(); }
  /// Product of the finite sides.
  double volume() const { return volume_; }

  /// Sets x to the image of u, and returns the determinant of dx/du.
  double map(std::span<const double> u, std::span<double> x) const;
  /// Sets u to the point of (0,1)^dim that is mapped to x, and returns the determinant of dx/du; 0 if x lies outside of
  /// the open box.
  double unmap(std::span<const double> x, std::span<double> u) const;
  /// "x = 0.5, y = 1": the image of u; the first eight variables.
  std::string describe(std::span<const double> u) const;

 private:
  double slope(std::span<const double> u) const;

  std::vector<VariableBounds> bounds_;
  double volume_;
};

/// The unit cube with variables u0, u1, ...
std::vector<VariableBounds> unit_cube_bounds(int dim);

} // namespace carlo

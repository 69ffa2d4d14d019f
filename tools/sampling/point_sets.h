#pragma once
/// Names of libmc's point sets.

#include <integrands/unit_cube_integral.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// A generator of points in the unit cube. Different seeds give independent randomisations.
struct PointSet {
  std::string name;
  std::string title; ///< one line
  /// Coordinate k of point i is at i * dim + k.
  std::function<std::vector<double>(std::uint32_t count, std::uint32_t dim, std::uint64_t seed)> make;
  /// The mean of the integrand over the points, and over the points rounded to float.
  using Mean = std::function<double(const UnitCubeIntegral& e, std::uint32_t count, std::uint64_t seed)>;
  Mean mean, mean_in_float;
};

/// The mean of the integrand over n points. fill(first, points) writes consecutive points from index `first` on.
///   throws : the errors of `evaluate`.
double mean_over(const UnitCubeIntegral& e, std::uint64_t n,
                 const std::function<void(std::uint64_t first, std::span<double> points)>& fill);

const std::vector<PointSet>& point_sets();

/// The point set with this name. Throws Error that suggests the nearest name if there is none.
const PointSet& point_set(const std::string& name);

} // namespace carlo

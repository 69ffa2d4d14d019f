#pragma once
/// The point sets of libmc by name.

#include <integrands/unit_cube_integral.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// A way to make points of the unit cube. Another seed is an independent randomisation.
struct PointSet {
  std::string name;
  std::string title; ///< one line
  /// Coordinate k of point i at i * dim + k.
  std::function<std::vector<double>(std::uint32_t count, std::uint32_t dim, std::uint64_t seed)> make;
  /// The mean of the integrand over them, and over them rounded to float.
  using Mean = std::function<double(const UnitCubeIntegral& e, std::uint32_t count, std::uint64_t seed)>;
  Mean mean, mean_in_float;
};

/// The mean of the integrand over n points; fill(first, points) writes those from `first` on, one after another.
///   throws : what evaluate throws
double mean_over(const UnitCubeIntegral& e, std::uint64_t n,
                 const std::function<void(std::uint64_t first, std::span<double> points)>& fill);

const std::vector<PointSet>& point_sets();

/// The one of that name. Throws Error naming the nearest for an unknown one.
const PointSet& point_set(const std::string& name);

} // namespace carlo

#pragma once
/// Names of all methods of libmc that estimate an integral over the unit cube.

#include <integrands/unit_cube_integral.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// An estimate and its number of evaluations.
struct MethodEstimate {
  double value = 0;
  double calls = 0;
};

/// A point set or an estimator. Different seeds give independent randomisations.
struct SamplingMethod {
  std::string name;
  std::string title;            ///< one line
  std::uint64_t min_calls = 16; ///< fewest evaluations that the method works with
  std::uint64_t max_calls = 1 << 28;
  int max_dimensions = 0;     ///< largest number of dimensions; 0: unlimited
  bool is_adaptive = false;   ///< its density depends on earlier samples
  std::string points_file;    ///< file that its points come from; empty: none
  std::string points_rescale; ///< range of its coordinates, see PointsFileOptions
  std::string note;           ///< a line for the user about its points; empty: none
  bool scalar_calls = false;  ///< calls integrands with one point at a time, even if they accept many
  /// An estimate from about n evaluations.
  ///   throws : Error with the point at which the integrand is not finite.
  std::function<MethodEstimate(const UnitCubeIntegral& e, std::uint64_t n, std::uint64_t seed)> estimate;
};

/// The point sets of point_sets.h, then the methods of integrate(): stratified_rounds, rqmc, vegas, tree, auto.
const std::vector<SamplingMethod>& sampling_methods();

/// The point sets with coordinates rounded to float, named NAME_float.
const std::vector<SamplingMethod>& float_sampling_methods();

/// The method with this name. Throws Error that suggests the nearest name if there is none.
const SamplingMethod& sampling_method(const std::string& name);

/// The points of a file, one in each row. Each seed shifts them modulo 1 by a random vector (Cranley-Patterson), which
/// preserves their distances on the torus. An estimate with n points uses the first n rows.
///   throws : Error for a file that read_points refuses.
///   rescale : see PointsFileOptions.
SamplingMethod points_file_method(const std::string& file, const std::string& rescale = {});

} // namespace carlo

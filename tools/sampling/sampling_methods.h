#pragma once
/// Every way of libmc to estimate an integral over the unit cube, by name.

#include <integrands/unit_cube_integral.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// An estimate, and how often the integrand was evaluated for it.
struct MethodEstimate {
  double value = 0;
  double calls = 0;
};

/// A point set or an estimator. Another seed is an independent randomisation.
struct SamplingMethod {
  std::string name;
  std::string title;            ///< one line
  std::uint64_t min_calls = 16; ///< fewest evaluations it can work with
  std::uint64_t max_calls = 1 << 28;
  int max_dimensions = 0;    ///< how many it has at most; 0: any
  bool is_adaptive = false;  ///< its estimate depends on what it measured before
  std::string points_file;   ///< of its points; empty: none
  bool scalar_calls = false; ///< integrands that take many points at once are given one
  /// An estimate from about n evaluations.
  ///   throws : Error with the place for an integrand that is not finite
  std::function<MethodEstimate(const UnitCubeIntegral& e, std::uint64_t n, std::uint64_t seed)> estimate;
};

/// The point sets of point_sets.h, then integrate() by its methods: stratified_rounds, rqmc, vegas, tree, auto.
const std::vector<SamplingMethod>& sampling_methods();

/// The point sets again, their coordinates rounded to float: NAME_float.
const std::vector<SamplingMethod>& float_sampling_methods();

/// The way of that name. Throws Error naming the nearest for an unknown one.
const SamplingMethod& sampling_method(const std::string& name);

/// The points of a file, a row each, moved round the cube by a random vector for each seed (Cranley-Patterson), which
/// keeps their distances on the torus. n of them are its first n.
///   throws : Error for a file that read_points refuses
SamplingMethod points_file_method(const std::string& file);

} // namespace carlo

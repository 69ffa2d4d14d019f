#pragma once
/// Every way of libmc to estimate an integral over the unit cube, by name.

#include <integrands/experiments.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// An estimate, and how often the integrand was evaluated for it.
struct Sampled {
  double value = 0;
  double calls = 0;
};

/// A point set or an estimator. Another seed is an independent randomisation.
struct Way {
  std::string name;
  std::string title;        ///< one line
  std::uint64_t least = 16; ///< fewest evaluations it can work with
  std::uint64_t most = 1 << 28;
  int dimensions = 0;      ///< how many it has at most; 0: any
  bool adapts = false;     ///< its estimate depends on what it measured before
  std::string file;        ///< of its points; empty: none
  bool one_by_one = false; ///< integrands that take many points at once are given one
  /// An estimate from about n evaluations.
  ///   throws : Error with the place for an integrand that is not finite
  std::function<Sampled(const Experiment& e, std::uint64_t n, std::uint64_t seed)> estimate;
};

/// The point sets of point_sets.h, then integrate() by its methods: stratified_rounds, rqmc, vegas, tree, auto.
const std::vector<Way>& ways();

/// The point sets again, their coordinates rounded to float: NAME_float.
const std::vector<Way>& float_ways();

/// The way of that name. Throws Error naming the nearest for an unknown one.
const Way& way(const std::string& name);

/// The points of a file, a row each, moved round the cube by a random vector for each seed (Cranley-Patterson), which
/// keeps their distances on the torus. n of them are its first n.
///   throws : Error for a file that read_points refuses
Way way_of_points(const std::string& file);

} // namespace carlo

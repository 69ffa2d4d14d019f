#pragma once
/// What a law of samplers is: one function in a file of its own, one row of the table in laws.cpp.

#include <mc/check/laws/worst_error.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/any_distribution.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace mc {

/// Bounds are those of the sampler's contract, in machine epsilons of its scalar.
struct LawOptions {
  std::string name = "warp";
  std::uint64_t samples = 1'000'000; ///< for the counts; 0 leaves the statistical tests out
  std::uint64_t seed = 1;
  double alpha = 0.001;       ///< see SubjectOptions
  std::uint64_t points = 256; ///< random points of the deterministic laws over the 50-digit oracle
  double invert_eps = 16;     ///< |invert(sample(u)) - u|
  double sample_eps = 16;     ///< |sample(u) - exact| beyond what 4 steps of u make, relative to max(1, |exact|)
  double pdf_eps = 64;        ///< |pdf(x) / exact - 1|
  double mass_eps = 64;       ///< |mass - 1| beyond the bound on the quadrature error
  std::size_t max_evaluations = 12'000'000;
  bool evidence = false;      ///< see SubjectOptions
  bool open_interval = false; ///< u in (0,1): the sampler may break at single u, see boundary in laws.h
  const std::function<void()>* before_draws = nullptr; ///< called again and again; what it throws ends the check
};

/// A deterministic law: its checks, or none where the sampler lacks what it needs.
using Law = std::vector<Check>(const AnyDistribution& distribution, const LawOptions& options);

Law inverse_law, determinism_law; ///< those that are asked for alone, too

/// A random point of the unit cube for a law: the same numbers in double, rounded to the sampler's scalar.
AnyDistribution::Uniforms rounded_uniforms(const AnyDistribution& distribution, Pcg& random);
/// The same, not rounded.
OracleDistribution::Point oracle_uniforms(const AnyDistribution& distribution, Pcg& random);

} // namespace mc

#pragma once
/// Interface of the laws of distributions. Each law is one function in a file of its own and one row of the table in
/// laws.cpp.

#include <mc/check/laws/worst_error.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/any_distribution.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace mc {

/// Options of the laws. Error bounds are the contract of the distribution, in machine epsilons of its scalar.
struct LawOptions {
  std::string name = "warp";         ///< name in the report
  std::uint64_t samples = 1'000'000; ///< number of counted samples; 0 skips the statistical tests
  std::uint64_t seed = 1;            ///< seed of all random numbers
  double alpha = 0.001;              ///< family-wise level of the statistical tests
  std::uint64_t points = 256;        ///< number of random points for the laws over the 50-digit oracle
  double invert_eps = 16;            ///< bound on |invert(sample(u)) - u|
  double sample_eps = 16; ///< |sample(u) - exact| / max(1, |exact|), beyond the effect of 4 rounding steps of u
  double pdf_eps = 64;    ///< bound on |pdf(x) / exact - 1|
  double mass_eps = 64;   ///< bound on |mass - 1| beyond the quadrature error
  std::size_t max_evaluations = 12'000'000; ///< largest number of evaluations of the density
  bool evidence = false;                    ///< keep all counts and intermediate p-values
  bool open_interval = false;               ///< u in (0,1): accepts faults of measure zero, like SubjectOptions
  /// Called before each batch of draws; an exception that it throws ends the check.
  const std::function<void()>* before_draws = nullptr;
};

/// A deterministic law. Returns its checks; none if the distribution lacks a required function.
using Law = std::vector<Check>(const AnyDistribution& distribution, const LawOptions& options);

Law inverse_law, determinism_law; ///< laws that other files call directly

/// Returns a random point of the unit cube: the same numbers in double for all scalars, rounded to the distribution's
/// scalar.
AnyDistribution::Uniforms rounded_uniforms(const AnyDistribution& distribution, Pcg& random);
/// The same without rounding.
OracleDistribution::Point oracle_uniforms(const AnyDistribution& distribution, Pcg& random);

} // namespace mc

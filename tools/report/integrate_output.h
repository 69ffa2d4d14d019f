#pragma once
/// What carlo integrate says of its integrals, as text and as JSON.

#include <integrands/experiments.h>

#include <mc/estimate/integrate.h>
#include <mc/estimate/values/quantiles.h>

#include <string>
#include <vector>

namespace carlo {

/// The part of an integral that comes from one bin.
struct Bin {
  std::string name; ///< "[0, 0.5) of x"
  double lo, hi;
  mc::Integral part;
};

/// All that a run found.
struct Integrals {
  std::vector<Experiment> integrands;
  mc::VectorIntegral results;
  std::vector<Bin> histogram = {};
  std::vector<mc::Quantile> quantiles = {};
};

/// "1.3075 ± ..." and what a user can do where there is no error bar, calls and time, the truth where it is known, and
/// of several the correlations of their errors.
std::string about(const Integrals& found);
/// A row for each round, of the first integrand.
std::string round_table(const mc::Integral& r);
/// A row for each bin with its share of the integral; a row for each quantile.
std::string histogram_table(const Integrals& found);
std::string quantile_table(const Integrals& found);

/// Everything, for a file.
std::string integrals_json(const Integrals& found, const std::string& command, std::uint64_t seed);

} // namespace carlo

#pragma once
/// What carlo integrate says of its integrals, as text and as JSON.

#include <integrands/unit_cube_integral.h>

#include <mc/estimate/integrate.h>
#include <mc/estimate/values/quantiles.h>

#include <string>
#include <vector>

namespace carlo {

/// The part of an integral that comes from one bin.
struct HistogramBin {
  std::string name; ///< "[0, 0.5) of x"
  double lo, hi;
  mc::Integral integral;
};

/// All that a run found.
struct IntegrateResults {
  std::vector<UnitCubeIntegral> integrands;
  mc::VectorIntegral results;
  std::vector<HistogramBin> histogram = {};
  std::vector<mc::Quantile> quantiles = {};
};

/// "1.3075 ± ..." and what a user can do where there is no error bar, calls and time, the truth where it is known, and
/// of several the correlations of their errors.
std::string integrate_summary(const IntegrateResults& found);
/// A row for each round, of the first integrand.
std::string round_table(const mc::Integral& r);
/// A row for each bin with its share of the integral; a row for each quantile.
std::string histogram_table(const IntegrateResults& found);
std::string quantile_table(const IntegrateResults& found);

/// Everything, for a file.
std::string integrals_json(const IntegrateResults& found, const std::string& command, std::uint64_t seed);

} // namespace carlo

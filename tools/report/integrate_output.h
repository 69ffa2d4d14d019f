#pragma once
/// Results of carlo integrate as text and as JSON.

#include <integrands/unit_cube_integral.h>

#include <mc/estimate/integrate.h>
#include <mc/estimate/values/quantiles.h>

#include <string>
#include <vector>

namespace carlo {

/// The part of an integral in one bin.
struct HistogramBin {
  std::string name; ///< for example "[0, 0.5) of x"
  double lo, hi;
  mc::Integral integral;
};

/// All results of a run.
struct IntegrateResults {
  std::vector<UnitCubeIntegral> integrands;
  mc::VectorIntegral results;
  std::vector<HistogramBin> histogram = {};
  std::vector<mc::Quantile> quantiles = {};
};

/// Returns "1.3075 ± ...", or a remedy if there is no error bar; then calls and time, the true value if available, and
/// the correlations of the errors of several integrands.
std::string integrate_summary(const IntegrateResults& found);
/// Returns a table with one row per round, for the first integrand.
std::string round_table(const mc::Integral& r);
/// Returns a table with one row per bin and its share of the integral, or one row per quantile.
std::string histogram_table(const IntegrateResults& found);
std::string quantile_table(const IntegrateResults& found);

/// Returns all results, for a file.
std::string integrals_json(const IntegrateResults& found, const std::string& command, std::uint64_t seed);

} // namespace carlo

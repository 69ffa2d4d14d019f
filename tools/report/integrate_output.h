#pragma once
/// Results of carlo integrate as text and as JSON.

#include <integrands/unit_cube_integral.h>

#include <mc/estimate/integrate.h>
#include <mc/estimate/values/quantiles.h>

#include <string>
#include <utility>
#include <vector>

namespace carlo {

/// The part of an integral in one bin.
struct HistogramBin {
  std::string name; ///< for example "[0, 0.5) of x"
  double lo, hi;
  mc::Integral integral;
};

/// A function of integrals, such as their ratio.
struct DerivedValue {
  std::string expression;
  double value;
  double std_error; ///< infinite unless error_bar is known and the function has no pole
  mc::Estimate::Interval interval;
  mc::ErrorBar error_bar = mc::ErrorBar::known;
  bool has_pole = false; ///< whether the function is not finite within the errors
  bool is_linear = true; ///< whether the function is nearly linear within the errors, as its error assumes
};

/// The values of the swept parameters, by name.
using SweptValues = std::vector<std::pair<std::string, double>>;

/// All results of a run. Integrands, results and derived values of the first point of a sweep come before those of the
/// next.
struct IntegrateResults {
  std::vector<UnitCubeIntegral> integrands;
  mc::VectorIntegral results;
  std::vector<SweptValues> points = {SweptValues()}; ///< one without values if nothing is swept
  std::vector<DerivedValue> derived = {};
  std::vector<std::string> names = {}; ///< short names of the integrands of a point; may be empty
  std::vector<HistogramBin> histogram = {};
  std::vector<mc::Quantile> quantiles = {};
  std::uint64_t replaced = 0; ///< how many values were not a number, see ExpressionContext::nan
  double replacement = 0;     ///< taken instead

  bool is_sweep() const { return !points.front().empty(); }
  std::size_t integrands_per_point() const { return integrands.size() / points.size(); }
};

/// Returns "1.3075 ± ...", or a remedy if there is no error bar; then calls and time, the true value if available, and
/// the correlations of the errors of several integrands, and the derived values.
std::string integrate_summary(const IntegrateResults& found);
/// Returns how many calls there were, the time, the method and the reason to stop, and the number of replaced values.
std::string calls_text(const IntegrateResults& found);
/// Returns a table with one row per round, for the first integrand.
std::string round_table(const mc::Integral& r);
/// Returns a table with one row per bin and its share of the integral, or one row per quantile.
std::string histogram_table(const IntegrateResults& found);
std::string quantile_table(const IntegrateResults& found);

/// Returns all results, for a file.
std::string integrals_json(const IntegrateResults& found, const std::string& command, std::uint64_t seed);

} // namespace carlo

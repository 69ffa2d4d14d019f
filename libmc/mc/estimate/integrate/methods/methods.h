#pragma once
/// The table of integration methods.

#include <mc/estimate/integrate/replicates.h>
#include <mc/estimate/integrate/run.h>

#include <span>
#include <string_view>

namespace mc::detail {

/// A row of the table: what users choose by name.
struct MethodRow {
  Method method;            ///< Value of IntegrateOptions::method.
  std::string_view name;    ///< Name in options and results.
  bool adaptive;            ///< Learns a density.
  Outcome (*run)(Run& run); ///< Integrates.
};

/// All methods, in the order of Method.
std::span<const MethodRow> method_rows();

/// integrate_unit() with other constants of the error bar, for tests of what each is needed for.
VectorIntegral integrate(const Integrand& f, int outputs, int dim, const IntegrateOptions& options,
                         const Tuning& tuning = detail::default_tuning);

Outcome run_plain(Run& run);      ///< Independent points.
Outcome run_stratified(Run& run); ///< Independent rounds of jittered points.
Outcome run_rqmc(Run& run);       ///< Replicated Sobol' sequences.
Outcome run_vegas(Run& run);      ///< The same through a learned grid.
Outcome run_tree(Run& run);       ///< The same through a learned grid and tree.
Outcome run_automatic(Run& run);  ///< The best of rqmc, vegas and tree.

/// The next step of replicates. A few replicates are added where these reach the wanted errors; else the length is
/// doubled. The last calls pay for longer sequences, if dropping some of the replicates makes these possible and the
/// rate says that it is worth it, else for more replicates. The points of a longer length may be recorded. Returns
/// whether there were calls left.
bool extend_or_add(Run& run, Replicates& r, bool record = false);

} // namespace mc::detail

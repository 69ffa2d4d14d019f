#pragma once
/// Integrates several sets of integrands by the same points.

#include <integrands/find.h>
#include <integrate/histogram.h>

#include <mc/estimate/integrate.h>

#include <string>
#include <vector>

namespace carlo {

/// The integrands at each point of a sweep; one set if nothing is swept. All sets have the same dimension.
using IntegrandSets = std::vector<IntegrandSet>;

/// All integrals, set by set, or the integral of the only integrand and then those of its histogram's bins. A finite
/// sum is exact. The relative error of a complex integral is relative to its modulus, which a short run estimates
/// first; a run that converged too early because the modulus was smaller is repeated. Leaves the absolute error that
/// was used in `o`.
///   throws : Error as mc::integrate_unit, and for a finite sum with a term that is not finite.
mc::VectorIntegral integrate_sets(const IntegrandSets& sets, const Histogram& histogram, mc::IntegrateOptions& o);

/// The message about a point where an integrand is not finite, in the variables of that integrand.
std::string in_variables(const mc::NotFinite& e, const IntegrandSets& sets);

} // namespace carlo

#pragma once
/// Importance sampling of integrands over the unit cube.

#include <integrands/joint_integrand.h>

#include <functional>
#include <span>

namespace carlo {

/// A density over the unit cube and its samples.
struct ImportanceDensity {
  int uniforms = 0; ///< coordinates of one u
  /// Sets v to one sample for each u, and densities to the density there; 0 means that the sample contributes nothing.
  /// It may be called from several threads at once.
  std::function<void(std::span<const double> u, std::span<double> v, std::span<double> densities)> draw;
};

/// f(v) / density(v) at the samples v of the density: the same integrals, in the dimension of its uniforms.
///   needs : a density above 0 wherever the integrand is not 0.
JointIntegrand importance_sampled(JointIntegrand f, const ImportanceDensity& density);

} // namespace carlo

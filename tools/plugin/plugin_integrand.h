#pragma once
/// An integrand of a loaded plugin as a function over the unit cube. It exists only in the child.

#include <integrands/joint_integrand.h>
#include <plugin/run_isolated.h>

#include <mc/check/plugin.h>

#include <cstddef>
#include <string>

namespace carlo {

/// Number of values at each point.
std::size_t output_count(const mc_integrand& f);
/// "Name", or "Name.output" where it has several outputs.
std::string output_name(const mc_integrand& f, std::size_t output);
/// The exact integral; NaN if the plugin states none.
double truth_of(const mc_integrand& f, std::size_t output);
/// Coordinates of the unit cube: those of the box, or the uniforms of the importance density.
int unit_dimension(const mc_integrand& f);

/// All outputs. With an importance density they are eval(x) / pdf(x) at samples x, and 0 outside of the box. The
/// monitor records every call.
///   one_by_one : eval_many is not used.
///   throws     : when it is evaluated: Error for a sample or a density that is not finite, or a density that is not
///                above 0.
JointIntegrand joint_of(const mc_integrand& f, CallMonitor& monitor, bool one_by_one = false);

/// A sample of the importance density, and the value of the density at x.
///   throws : as above.
double sample_density(const mc_integrand& f, CallMonitor& monitor, std::span<const double> u, std::span<double> x);

/// Throws Error if the integrand is no function of x alone, or if eval_many differs from eval.
void require_pure(const mc_integrand& f, CallMonitor& monitor);

/// Throws Error, with the place, unless x is finite and the density is finite and above 0.
void require_density(double density, std::span<const double> u, std::span<const double> x);

} // namespace carlo

#pragma once
/// Integrands that are evaluated together, at the same points.

#include <integrands/unit_cube_integral.h>

#include <functional>
#include <span>
#include <vector>

namespace carlo {

/// Integrals over the same unit cube, and one function for all their integrands.
struct JointIntegrand {
  std::vector<UnitCubeIntegral> outputs; ///< at least one; all have the same dimension
  /// Sets values[i outputs + k] to output k at point i. It may be called from several threads at once.
  std::function<void(UnitCubeIntegral::UnitPoint points, std::span<double> values)> f;

  int dim() const { return outputs.front().dim; }
};

/// All outputs of all parts.
///   throws : Error if their dimensions differ.
JointIntegrand joined(std::vector<JointIntegrand> parts);

/// Integrands that are evaluated one after another.
JointIntegrand joined(std::vector<UnitCubeIntegral> integrals);

/// Sets f and f_batch of each output by the joint function, which evaluates the other outputs as well.
void bind_outputs(JointIntegrand& integrand);

} // namespace carlo

#pragma once
/// Importance densities of plugins and programs, evaluated in separate processes.
///
/// A plugin offers the densities of its integrands, and its distributions on an interval, a box or another set of
/// points in as many coordinates as dimensions. A program answers "sample" and "pdf" as for carlo validate, see
/// command.h. The density need not be 0 outside of the bounds; samples there contribute 0.

#include <integrands/importance.h>
#include <integrands/variable_bounds.h>
#include <plugin/worker.h>

#include <string>
#include <vector>

namespace carlo {

struct ForeignDensityOptions {
  std::string plugin, command;        ///< one of them
  std::string name = {};              ///< of the plugin's density; empty: its only one
  int uniforms = 0;                   ///< of a command: uniform numbers for one sample; 0: one for each variable
  std::vector<VariableBounds> bounds; ///< the variables, in the order of a sample's coordinates
  WorkerOptions worker;
};

/// The density over the unit cube that is mapped to the bounds.
///   throws : Error for an unknown name, a density on another number of variables or of another measure. When it draws:
///            Error with the place where a sample or its density is not finite, or the density is not above 0.
ImportanceDensity foreign_density(const ForeignDensityOptions& options);

/// Answers the requests of this file in the worker.
nlohmann::json run_density_task(const nlohmann::json& request, CallMonitor& monitor);

} // namespace carlo

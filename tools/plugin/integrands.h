#pragma once
/// Integrands of plugins, evaluated in separate processes.

#include <converge/integral_target.h>
#include <integrands/joint_integrand.h>
#include <plugin/run_isolated.h>
#include <plugin/worker.h>

#include <string>
#include <vector>

namespace carlo {

/// The named integrands of the shared object, or all of them; each output is a target. Their replicates run like
/// plugins' samplers, one task at a time, under the worker's limits. A few hundred points are checked before the first
/// replicates.
///   throws : Error for a plugin that load_plugin refuses or that misbehaves, for one without integrands, and for an
///            unknown name. When a target runs: Error with the place of a crash, an exception or a hang. The same if
///            the check shows that the integrand is no function of x alone, or that eval_many differs from eval.
std::vector<IntegralTarget> plugin_targets(const std::string& path, const std::vector<std::string>& names,
                                           const WorkerOptions& worker);

/// The named integrands of the shared object with all their outputs, which sessions evaluate; without a name its only
/// integrand. Each integrand is checked like a target. The time limit is for one call.
///   throws : as plugin_targets and a target's run; for several integrands without a name, or of different dimensions.
JointIntegrand plugin_integrand(const std::string& path, const std::vector<std::string>& names,
                                const WorkerOptions& worker);

/// Answers the requests of this file in the worker.
nlohmann::json run_integrand_task(const nlohmann::json& request, CallMonitor& monitor);

} // namespace carlo

#pragma once
/// Integrands of plugins, measured in a process of their own.

#include <converge/integral_target.h>
#include <plugin/run_isolated.h>
#include <plugin/worker.h>

#include <string>
#include <vector>

namespace carlo {

/// The integrands of the shared object, those named or all. Their replicates run like plugins' samplers, a task at a
/// time, under the worker's limits.
///   throws : Error for a plugin that load_plugin refuses or that misbehaves, one without integrands, or an unknown
///            name; when it runs, Error that says where it crashed, threw or hung, or where a few hundred points before
///            the first replicates show that it is no function of x alone, or that its eval_many is not its eval
std::vector<IntegralTarget> plugin_targets(const std::string& path, const std::vector<std::string>& names,
                                           const WorkerOptions& worker);

/// What the worker does with the requests of plugin_targets.
nlohmann::json run_integrand_task(const nlohmann::json& request, CallMonitor& monitor);

} // namespace carlo

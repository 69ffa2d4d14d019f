/// carlo worker: started by carlo itself, see plugin/worker.h.

#include <options/subcommand.h>
#include <plugin/command.h>
#include <plugin/command_integrand.h>
#include <plugin/foreign_density.h>
#include <plugin/integrands.h>
#include <plugin/plugin.h>
#include <plugin/worker.h>

#include <nlohmann/json.hpp>

namespace carlo {

namespace {

nlohmann::json run_task(const nlohmann::json& request, CallMonitor& monitor) {
  const std::string task = request["task"];
  if (task == "command") return run_command_task(request, monitor);
  if (task.ends_with("densities") || task.starts_with("density")) return run_density_task(request, monitor);
  if (task == "integrand command") return run_command_integrand_task(request, monitor);
  if (task.find("integrand") != task.npos) return run_integrand_task(request, monitor);
  return run_plugin_task(request, monitor);
}

} // namespace

Subcommand worker_subcommand() {
  Subcommand c{.about = {.name = "worker",
                         .summary = "Run foreign code for carlo, which starts it",
                         .examples = {},
                         .hidden = true},
               .options = {},
               .run = {}};
  c.run = [](const std::string&) {
    serve(run_task);
    return static_cast<int>(exit_ok);
  };
  return c;
}

} // namespace carlo

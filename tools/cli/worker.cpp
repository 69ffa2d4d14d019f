/// carlo worker: started by carlo itself, see plugin/worker.h.

#include <options/subcommand.h>
#include <plugin/command.h>
#include <plugin/integrands.h>
#include <plugin/plugin.h>
#include <plugin/worker.h>

#include <nlohmann/json.hpp>

namespace carlo {

namespace {

nlohmann::json run_task(const nlohmann::json& request, CallMonitor& monitor) {
  const std::string task = request["task"];
  if (task == "command") return run_command_task(request, monitor);
  if (task == "integrand" || task == "describe integrands" || task == "check integrand")
    return run_integrand_task(request, monitor);
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

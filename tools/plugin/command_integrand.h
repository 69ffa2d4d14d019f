#pragma once
/// The integrand of a program that answers over pipes, see program.h.
///
/// Question: "eval N D\n" and N D numbers, N points x of the domain. Answer: N C numbers, the C outputs at each point.
/// examples/program-python/integrand.py is an example in 20 lines.

#include <converge/integral_target.h>
#include <integrands/joint_integrand.h>
#include <integrands/variable_bounds.h>
#include <plugin/worker.h>

#include <string>
#include <vector>

namespace carlo {

struct CommandIntegrandOptions {
  std::string command;
  std::vector<std::string> outputs = {}; ///< names of the values at each point; empty: one value
  std::vector<VariableBounds> bounds;    ///< the variables, up to 1024
  WorkerOptions worker;                  ///< the time limit is for one question
};

/// Every thread that evaluates it uses a process of its own. A few hundred points are checked first.
///   throws : Error for bounds whose volume overflows, for a name that is no word or is repeated, and where the program
///            misbehaves. Also where the check shows that a value depends on more than its point x, such as the other
///            points of a question.
JointIntegrand command_integrand(const CommandIntegrandOptions& options);

/// Each output as a target. The CPU seconds are those of the program.
std::vector<IntegralTarget> command_targets(const CommandIntegrandOptions& options);

/// Answers the requests of this file in the worker.
nlohmann::json run_command_integrand_task(const nlohmann::json& request, CallMonitor& monitor);

} // namespace carlo

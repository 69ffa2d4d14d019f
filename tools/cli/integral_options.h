#pragma once
/// What the subcommands that measure integrals are asked for alike.

#include <cli/subcommand.h>
#include <converge/target.h>

#include <string>
#include <vector>

namespace carlo {

struct IntegralOptions {
  std::vector<std::string> integrands; ///< names, groups, or an expression
  std::string domain;                  ///< of an expression
  std::string plugin;                  ///< or the integrands of this shared object
  double timeout = 60, memory = 4;     ///< of its process
  bool list = false;
};

std::vector<Option> integral_rows(IntegralOptions& o);

/// The integrands asked for; those of the books when none is.
///   throws : Error for what means nothing, and for what find_integrand and plugin_targets refuse
std::vector<Target> targets_of(const IntegralOptions& o);

/// Prints the integrands and the ways to sample them.
int list_integrals();

} // namespace carlo

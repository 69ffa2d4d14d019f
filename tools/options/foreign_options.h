#pragma once
/// Options for integrands and densities of the user's own code.

#include <converge/integral_target.h>
#include <integrands/expression_integral.h>
#include <integrands/joint_integrand.h>
#include <options/subcommand.h>
#include <plugin/run_isolated.h>

#include <optional>
#include <string>
#include <vector>

namespace carlo {

struct ForeignOptions {
  std::string plugin;            ///< shared object with integrands
  std::string command;           ///< program that evaluates the integrand
  std::optional<int> dim;        ///< variables of the program, on the unit cube
  std::optional<double> timeout; ///< seconds, see ResourceLimits
  std::optional<double> memory;  ///< GiB
  bool operator==(const ForeignOptions&) const = default;

  bool is_given() const { return !plugin.empty() || !command.empty(); }
};

OptionGroup foreign_group(ForeignOptions& o);

/// The integrands of a plugin with these names, or the program's outputs.
///   context : its domain bounds the program's variables; without one they are o.dim variables of the unit cube.
///   throws : Error for a combination of options that makes no sense, and as plugin_integrand and command_integrand.
JointIntegrand foreign_integrand(const ForeignOptions& o, const std::vector<std::string>& names,
                                 const ExpressionContext& context);

/// The same as targets.
///   throws : as plugin_targets and command_targets.
std::vector<IntegralTarget> foreign_targets(const ForeignOptions& o, const std::vector<std::string>& names,
                                            const ExpressionContext& context);

struct ImportanceOptions {
  std::vector<std::string> peaks; ///< see PeakMixture
  std::string plugin, command;    ///< see ForeignDensityOptions
  std::string name;
  std::optional<int> uniforms;

  bool is_given() const { return !peaks.empty() || !plugin.empty() || !command.empty(); }
};

OptionGroup importance_group(ImportanceOptions& o);

/// Throws Error for a combination of options that makes no sense.
void require_importance_options(const ImportanceOptions& o);

/// The integrand with points from the density of the options.
///   needs  : options that are given.
///   throws : Error as PeakMixture and foreign_density.
JointIntegrand with_importance(JointIntegrand f, const ImportanceOptions& o, const ResourceLimits& limits);

} // namespace carlo

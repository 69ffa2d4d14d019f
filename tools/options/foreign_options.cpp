#include <integrands/box_map.h>
#include <integrands/peaks.h>
#include <options/foreign_options.h>
#include <plugin/command_integrand.h>
#include <plugin/foreign_density.h>
#include <plugin/integrands.h>

#include <mc/core/error.h>

namespace carlo {

namespace {

WorkerOptions worker_of(const ForeignOptions& o, const char* reduce_option) {
  ResourceLimits limits = resource_limits(o.timeout, o.memory, true);
  limits.reduce_option = reduce_option;
  return {.limits = limits};
}

CommandIntegrandOptions command_options(const ForeignOptions& o, const std::vector<std::string>& names,
                                        const ExpressionContext& context, const char* reduce_option) {
  const std::string& domain = context.domain;
  mc::require(!o.dim || (*o.dim >= 1 && *o.dim <= 1024), "--dim {} must lie in 1 to 1024", o.dim.value_or(0));
  mc::require(!o.dim || domain.empty(), "give --dim or --domain: --dim {} is the unit cube", o.dim.value_or(0));
  mc::require(o.dim || !domain.empty(),
              "--command needs the variables: --domain \"x=0:1,y=-1:2\", or --dim N for the unit cube");
  return {.command = o.command,
          .outputs = names,
          .bounds = o.dim ? unit_cube_bounds(*o.dim) : parse_bounds(domain),
          .worker = worker_of(o, reduce_option)};
}

void refuse_expression_options(ExpressionContext context) {
  context.domain = {};
  mc::require(context == ExpressionContext(), "--where, --let, --set and --nan are for an expression");
}

void refuse_bounds(const ForeignOptions& o, const ExpressionContext& context) {
  mc::require(context.domain.empty() && !o.dim,
              "{} is for an expression or a --command; a plugin states its own bounds", o.dim ? "--dim" : "--domain");
}

} // namespace

OptionGroup foreign_group(ForeignOptions& o) {
  return {
      "Your own integrands",
      {
          input_file({"--plugin",
                      "FILE",
                      &o.plugin,
                      "Take the integrands of this shared object, compiled against <mc/check/plugin.h>. INTEGRAND "
                      "chooses some by name.",
                      false,
                      {{"--command", "the integrand comes from one of them"}}}),
          {"--command", "COMMAND", &o.command,
           "Ask this program for the integrand, as in \"python3 mine.py\". Each thread starts its own. INTEGRAND "
           "names the program's outputs, if it has several. tools/plugin/README.md describes questions and answers."},
          {"--dim", "N", &o.dim, "Variables of a --command over the unit cube, 1 to 1024, instead of --domain."},
          {"--timeout", "SECONDS", &o.timeout,
           "Wall-clock time for one call of the code, or for the repetitions of a plugin at one N. Default: 60."},
          {"--memory", "GIB", &o.memory, "Memory for the code of one thread, in GiB. Default: 4."},
      }};
}

JointIntegrand foreign_integrand(const ForeignOptions& o, const std::vector<std::string>& names,
                                 const ExpressionContext& context) {
  refuse_expression_options(context);
  if (!o.command.empty()) return command_integrand(command_options(o, names, context, "--max-calls"));
  refuse_bounds(o, context);
  return plugin_integrand(o.plugin, names, worker_of(o, "--max-calls"));
}

std::vector<IntegralTarget> foreign_targets(const ForeignOptions& o, const std::vector<std::string>& names,
                                            const ExpressionContext& context) {
  refuse_expression_options(context);
  if (!o.command.empty()) return command_targets(command_options(o, names, context, "--max-n"));
  refuse_bounds(o, context);
  return plugin_targets(o.plugin, names, worker_of(o, "--max-n"));
}

OptionGroup importance_group(ImportanceOptions& o) {
  return {"Importance sampling",
          {
              {"--peak",
               "PLACE",
               &o.peaks,
               "A place where points must be dense: \"x=0.3,y=0.6 width 0.01\", in units of the variables. Half of the "
               "points remain uniform. Give it again for another peak.",
               false,
               {{"--importance-plugin", "the density is that of one of them"},
                {"--importance-command", "the density is that of one of them"}}},
              input_file({"--importance-plugin",
                          "FILE",
                          &o.plugin,
                          "Draw the points from a density of this shared object: the mean of integrand / density.",
                          false,
                          {{"--importance-command", "the density is that of one of them"}}}),
              {"--importance-command", "COMMAND", &o.command,
               "Draw the points from this program, which answers sample and pdf as for carlo validate --command."},
              {"--importance-name", "NAME", &o.name, "The density of the plugin, if it has several."},
              {"--uniforms", "N", &o.uniforms,
               "Uniform numbers for one sample of --importance-command. Default: one for each variable."},
          }};
}

void require_importance_options(const ImportanceOptions& o) {
  mc::require(o.name.empty() || !o.plugin.empty(), "--importance-name is for --importance-plugin");
  mc::require(!o.uniforms || !o.command.empty(), "--uniforms is for --importance-command");
  mc::require(!o.uniforms || (*o.uniforms >= 1 && *o.uniforms <= 1024), "--uniforms {} must lie in 1 to 1024",
              o.uniforms.value_or(0));
}

JointIntegrand with_importance(JointIntegrand f, const ImportanceOptions& o, const ResourceLimits& limits) {
  const std::vector<VariableBounds> own = f.outputs.front().bounds,
                                    bounds = own.empty() ? unit_cube_bounds(f.dim()) : own;
  if (!o.peaks.empty()) return importance_sampled(std::move(f), PeakMixture(o.peaks, bounds).density());
  return importance_sampled(std::move(f), foreign_density({.plugin = o.plugin,
                                                           .command = o.command,
                                                           .name = o.name,
                                                           .uniforms = o.uniforms.value_or(0),
                                                           .bounds = bounds,
                                                           .worker = {.limits = limits}}));
}

} // namespace carlo

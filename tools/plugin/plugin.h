#pragma once
/// Samplers and integrands compiled by the user against <mc/check/plugin.h>.

#include <catalogue/catalogue.h>
#include <plugin/worker.h>

#include <mc/check/plugin.h>
#include <mc/check/subject/any_distribution.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace carlo {

/// A sampler of a loaded shared object with its parameters set: the functions of mc_sampler, each call noted in the
/// watch. Lives in the child only.
class PluginDistribution {
 public:
  /// throws : Error when create rejects the parameters
  PluginDistribution(const mc_sampler& distribution, std::vector<double> parameters, CallMonitor& monitor);

  const mc_sampler& operator*() const { return distribution_; }
  const mc_sampler* operator->() const { return &distribution_; }
  int coordinates() const { return coordinates_; } ///< of a point
  int uniforms() const { return uniforms_; }       ///< of a sample

  int sample(const double* u, double* x) const; ///< one of mc_drawn
  double pdf(const double* x) const;
  bool invert(const double* x, double* u) const;
  double eval(const double* x) const;
  double weight(const double* u, const double* x) const;
  double probability(int outcome) const;
  std::vector<double> breaks(int axis) const; ///< in the quantity of the axis

 private:
  mc_sampler distribution_;
  int coordinates_, uniforms_;
  std::shared_ptr<std::vector<double>> parameters_;
  std::shared_ptr<void> self_;
  CallMonitor* monitor_;
};

/// What a shared object holds; its functions and texts live as long as the process.
struct Plugin {
  std::vector<mc_sampler> samplers;
  std::vector<mc_integrand> integrands;
};

/// Loads the shared object and checks its tables against the contracts of the header.
///   throws : Error for a file that is no shared object, lacks mc_plugin or one that it needs itself, is made for a
///            later version of the header, or holds a sampler or an integrand without a function, or with a domain, a
///            number or a parameter that means nothing
Plugin load_plugin(const std::string& path, CallMonitor& monitor);

/// The sampler's domain in the words of parse_domain.
std::string domain_text(const mc_sampler& distribution);

/// The plugin's sampler as the laws see it. Charts of infinite intervals are centred on samples of `seed`.
mc::AnyDistribution plugin_distribution(const PluginDistribution& plugin, const std::string& title, std::uint64_t seed);

/// Every law of check_laws that the sampler's functions allow.
mc::Report check_plugin(const PluginDistribution& distribution, const std::string& title, const CaseOptions& options);

/// One case per sampler of the shared object and per set of parameters that names only parameters of the sampler; where
/// there is none, one at the defaults. Loading and checking run in processes of their own, see worker.h.
///   sets   : "alpha=0.1, n=3"; lists and ranges stand for every combination, see parameters.h
///   names  : of those that are asked for, empty for all; the ranges of the others refuse no set
///   throws : Error for a plugin that load_plugin refuses, that crashes or goes beyond a limit, or a set that no
///            sampler can take
Catalogue plugin_cases(const std::string& path, const std::vector<std::string>& sets,
                       const std::vector<std::string>& names, const WorkerOptions& worker);

/// What the worker does with a request of plugin_cases.
nlohmann::json run_plugin_task(const nlohmann::json& request, CallMonitor& monitor);

} // namespace carlo

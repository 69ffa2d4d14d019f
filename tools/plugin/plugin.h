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

constexpr int most_integrand_dimensions = 1024; ///< of mc_integrand

/// A sampler of a loaded shared object with its parameters set. It wraps the functions of mc_sampler; the monitor
/// records each call. It exists only in the child.
class PluginDistribution {
 public:
  /// throws : Error if `create` rejects the parameters
  PluginDistribution(const mc_sampler& distribution, std::vector<double> parameters, CallMonitor& monitor);

  const mc_sampler& operator*() const { return distribution_; }
  const mc_sampler* operator->() const { return &distribution_; }
  int coordinates() const { return coordinates_; } ///< numbers per point
  int uniforms() const { return uniforms_; }       ///< uniform numbers per sample

  int sample(const double* u, double* x) const; ///< returns a value of mc_drawn
  int sample(mc::Pcg& random, double* x) const; ///< the same by sample_stream
  double pdf(const double* x) const;
  bool invert(const double* x, double* u) const;
  double eval(const double* x) const;
  double weight(const double* u, const double* x) const;
  double probability(int outcome) const;
  std::vector<double> breaks(int axis) const; ///< in the unit of the axis

 private:
  int checked(int drawn) const;

  mc_sampler distribution_;
  int coordinates_, uniforms_;
  std::shared_ptr<std::vector<double>> parameters_;
  std::shared_ptr<void> self_;
  CallMonitor* monitor_;
};

/// The contents of a shared object. Its functions and strings stay valid until the process ends.
struct Plugin {
  std::vector<mc_sampler> samplers;
  std::vector<mc_integrand> integrands;
};

/// Loads the shared object and checks its tables against the contracts of the header.
///   throws : Error for a file that is no shared object, lacks mc_plugin or a library that it depends on, or was made
///            for a later version of the header. Error for a sampler or integrand without a function, or with an
///            invalid domain, number or parameter.
Plugin load_plugin(const std::string& path, CallMonitor& monitor);

/// The sampler's domain in the syntax of parse_domain.
std::string domain_text(const mc_sampler& distribution);

/// The plugin's sampler as a distribution for check_laws. Charts of infinite intervals are centred on samples of
/// `seed`.
mc::AnyDistribution plugin_distribution(const PluginDistribution& plugin, const std::string& title, std::uint64_t seed);

/// Checks every law of check_laws that the sampler's functions support.
mc::Report check_plugin(const PluginDistribution& distribution, const std::string& title, const CaseOptions& options);

/// Parameters that are drawn at random.
struct RandomParameters {
  int cases = 0; ///< for each sampler and set; 0: none are random
  std::uint64_t seed = 1;
};

/// One case for each sampler of the shared object and each parameter set that contains only parameters of this sampler.
/// A sampler without a matching set has one case with its defaults. Loading and checking run in separate processes, see
/// worker.h.
///   sets   : "alpha=0.1, n=3"; lists and ranges stand for every combination, see parameters.h.
///   random : the parameters that a set leaves out are random in their ranges, uniform, or log-uniform if 0 < lo and hi
///            >= 100 lo. A sampler without parameters is checked once.
///   names  : the requested samplers, empty for all; a set out of range of any other sampler is no error.
///   throws : Error for a plugin that load_plugin refuses, that crashes or exceeds a limit, or for a set that no
///            sampler accepts.
Catalogue plugin_cases(const std::string& path, const std::vector<std::string>& sets,
                       const std::vector<std::string>& names, const WorkerOptions& worker,
                       const RandomParameters& random = {});

/// Answers the requests of plugin_cases in the worker.
nlohmann::json run_plugin_task(const nlohmann::json& request, CallMonitor& monitor);

} // namespace carlo

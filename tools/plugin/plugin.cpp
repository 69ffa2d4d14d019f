#include <input/parsed_domain.h>
#include <plugin/plugin.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <fmt/format.h>

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string_view>

namespace carlo {

namespace {

bool is_word(const char* text) {
  if (!text || !*text) return false;
  return std::all_of(text, text + std::string_view(text).size(),
                     [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

void require_valid(const mc_sampler& s, std::size_t index) {
  mc::require(is_word(s.name), "sampler {} has no name of letters, digits and _", index);
  mc::with_context(fmt::format("sampler {}", s.name), [&] {
    mc::require(s.domain >= MC_INTERVAL && s.domain <= MC_PRODUCT, "domain = {} is none of mc_domain, 1 to 8",
                s.domain);
    mc::require(s.domain != MC_BOX || (s.dim >= 1 && s.dim <= 3),
                "dim = {}; MC_BOX has 1 to 3 dimensions, MC_PRODUCT up to 6", s.dim);
    mc::require(s.domain != MC_INTERVAL || s.lo[0] < s.hi[0] || (s.lo[0] == 0 && s.hi[0] == 0),
                "interval [{}, {}] needs lo < hi", s.lo[0], s.hi[0]);
    mc::require(s.domain != MC_DISCRETE || (s.hi[0] >= 1 && s.hi[0] <= 1 << 24 && s.hi[0] == std::floor(s.hi[0])),
                "hi[0] = {} outcomes; 1 to 2^24 are needed", s.hi[0]);
    mc::require(s.domain != MC_DISCRETE || (!s.invert && !s.eval), "discrete outcomes have neither invert nor eval");
    mc::require(s.domain != MC_PRODUCT || s.parts, "domain is MC_PRODUCT, but parts is NULL");
    const ParsedDomain domain = parse_domain(domain_text(s));
    mc::require(s.domain != MC_PRODUCT || !domain.outcomes.any(), "parts = '{}'; outcomes alone are MC_DISCRETE",
                s.parts);
    mc::require(s.outcomes >= 0 && s.outcomes <= 1000, "outcomes = {} must lie in 0 to 1000", s.outcomes);
    mc::require(s.outcomes == 0 || s.domain != MC_DISCRETE, "outcomes beside a density, but domain is MC_DISCRETE");
    mc::require((s.outcomes > 0) == (s.probability != nullptr), "outcomes = {}, but probability is {}", s.outcomes,
                s.probability ? "given" : "NULL");
    mc::require(s.uniforms >= 0 && s.uniforms <= CallMonitor::max_arguments, "uniforms = {} must lie in 0 to {}",
                s.uniforms, CallMonitor::max_arguments);
    mc::require(s.scalar == MC_DOUBLE || s.scalar == MC_FLOAT, "scalar = {} is none of mc_scalar, 0 or 1", s.scalar);
    mc::require(s.sample || s.sample_stream, "it has no function sample");
    mc::require(!s.sample || !s.sample_stream, "it has sample and sample_stream; leave one out");
    mc::require(!s.sample_stream || (!s.invert && !s.weight && s.uniforms == 0),
                "it has sample_stream; invert, weight and uniforms need sample");
    mc::require(s.pdf, "it has no function pdf");
    mc::require(!s.weight || s.eval, "it states a weight, but has no eval to compare it with");
    mc::require(!s.invert || s.uniforms == 0 || s.uniforms == domain.chart.dim,
                "it has invert, but takes {} uniforms in {} dimensions; invert needs equal numbers", s.uniforms,
                domain.chart.dim);
    for (const double t : {s.pdf_tolerance, s.weight_tolerance, s.invert_tolerance})
      mc::require(t >= 0 && t < 1, "a tolerance is {}; it must lie in [0, 1)", t);
    mc::require(s.parameter_count >= 0 && s.parameter_count <= 64, "parameter_count = {} must lie in 0 to 64",
                s.parameter_count);
    mc::require(s.parameter_count == 0 || s.parameters, "parameters is NULL, parameter_count is {}", s.parameter_count);
    for (int i = 0; i < s.parameter_count; ++i) {
      const mc_parameter& p = s.parameters[i];
      mc::require(is_word(p.name), "parameter {} has no name of letters, digits and _", i);
      mc::require(std::isfinite(p.value) && p.lo <= p.value && p.value <= p.hi,
                  "parameter {} = {} does not lie in its range [{}, {}]", p.name, p.value, p.lo, p.hi);
    }
  });
}

void require_valid_outputs(const mc_integrand& f) {
  mc::require(f.outputs >= 0 && f.outputs <= 64, "outputs = {} must lie in 0 to 64", f.outputs);
  const bool several = f.outputs > 1;
  mc::require(!several || f.eval_outputs, "outputs = {}, but eval_outputs is NULL", f.outputs);
  mc::require(!several || !f.eval, "outputs = {}, but eval returns one value; leave eval out", f.outputs);
  mc::require(several || f.eval, "it has no function eval");
  mc::require(several || !f.eval_outputs, "it has eval_outputs, but outputs = {}; state how many", f.outputs);
  for (int k = 0; f.output_names && k < std::max(f.outputs, 1); ++k)
    mc::require(is_word(f.output_names[k]), "output {} has no name of letters, digits and _", k);
  mc::require(!f.truths || f.has_truth, "it has truths, but has_truth = 0");
  for (int k = 0; f.truths && k < std::max(f.outputs, 1); ++k)
    mc::require(std::isfinite(f.truths[k]), "truths[{}] = {} is not finite", k, f.truths[k]);
  mc::require(!several || !f.has_truth || f.truths, "has_truth = 1 with outputs = {}, but truths is NULL", f.outputs);
}

void require_valid(const mc_integrand& f, std::size_t index) {
  mc::require(is_word(f.name), "integrand {} has no name of letters, digits and _", index);
  mc::with_context(fmt::format("integrand {}", f.name), [&] {
    mc::require(f.dim >= 1 && f.dim <= most_integrand_dimensions, "dim = {} must lie in 1 to {}", f.dim,
                most_integrand_dimensions);
    require_valid_outputs(f);
    mc::require(!f.has_truth || std::isfinite(f.truth), "truth = {} is not finite", f.truth);
    mc::require(!f.lo == !f.hi, "give both lo and hi, or neither");
    for (int i = 0; f.lo && i < f.dim; ++i)
      mc::require(std::isfinite(f.lo[i]) && std::isfinite(f.hi[i]) && f.lo[i] < f.hi[i],
                  "bounds [{}, {}] of axis {} must be finite, with lo < hi", f.lo[i], f.hi[i], i);
    mc::require(!f.sample == !f.pdf, "give both sample and pdf, or neither");
    mc::require(f.uniforms >= 0 && f.uniforms <= most_integrand_dimensions, "uniforms = {} must lie in 0 to {}",
                f.uniforms, most_integrand_dimensions);
    mc::require(f.uniforms == 0 || f.sample, "uniforms = {}, but sample is NULL", f.uniforms);
  });
}

// Copies an array of structs of `size` bytes each. Older plugins have shorter structs without the last fields.
template <class T> std::vector<T> copy_structs(const T* first, std::size_t count, std::size_t size) {
  std::vector<T> all(count);
  for (std::size_t i = 0; i < count; ++i) std::memcpy(&all[i], reinterpret_cast<const char*>(first) + i * size, size);
  return all;
}

template <class T>
std::vector<T> table(const char* what, const T* first, std::size_t count, std::size_t size, std::size_t expected) {
  mc::require(size == expected, "its mc_{} has {} bytes, that of its version of <mc/check/plugin.h> {}", what, size,
              expected);
  mc::require(count <= 1000, "it lists {} {}s; at most 1000 are possible", count, what);
  mc::require(count == 0 || first, "{}_count = {}, but {}s is NULL", what, count, what);
  std::vector<T> all = copy_structs(first, count, size);
  for (std::size_t i = 0; i < count; ++i) require_valid(all[i], i);
  return all;
}

double next_uniform(void* random) { return static_cast<mc::Pcg*>(random)->uniform<double>(); }

std::string interval_text(const char* name, double lo, double hi) {
  return fmt::format("{}={:.17g}:{:.17g}", name, lo, hi);
}

std::string box_text(const mc_sampler& s) {
  const auto is_zero = [](double x) { return x == 0; };
  const bool unit = std::all_of(s.lo, s.lo + 3, is_zero) && std::all_of(s.hi, s.hi + 3, is_zero);
  constexpr const char* names[] = {"x", "y", "z"};
  std::string text;
  for (int i = 0; i < (s.domain == MC_INTERVAL ? 1 : s.dim); ++i)
    text += (i > 0 ? "," : "") + interval_text(names[i], s.lo[i], unit ? 1 : s.hi[i]);
  return text;
}

} // namespace

std::string domain_text(const mc_sampler& s) {
  switch (s.domain) {
  case MC_INTERVAL:
  case MC_BOX: return box_text(s);
  case MC_DISK: return "disk";
  case MC_TRIANGLE: return "triangle";
  case MC_SPHERE: return "sphere";
  case MC_HEMISPHERE: return "hemisphere";
  case MC_DISCRETE: return fmt::format("discrete={:.0f}", s.hi[0]);
  default: return s.parts;
  }
}

PluginDistribution::PluginDistribution(const mc_sampler& distribution, std::vector<double> parameters,
                                       CallMonitor& monitor)
    : distribution_(distribution), parameters_(std::make_shared<std::vector<double>>(std::move(parameters))),
      monitor_(&monitor) {
  const ParsedDomain domain = parse_domain(domain_text(distribution));
  coordinates_ = static_cast<int>(domain.columns.size());
  uniforms_ = distribution.uniforms > 0 ? distribution.uniforms : std::max(domain.chart.dim, 1);
  if (!distribution.create) {
    self_ = {parameters_, parameters_->data()};
    return;
  }
  monitor.enter("create");
  void* self = distribution.create(parameters_->data());
  monitor.leave();
  mc::require(self != nullptr, "create rejects the parameters");
  const auto destroy = [destroy = distribution.destroy, &monitor](void* made) {
    if (!destroy) return;
    monitor.enter("destroy");
    destroy(made);
    monitor.leave();
  };
  self_ = {self, destroy};
}

int PluginDistribution::sample(const double* u, double* x) const {
  monitor_->enter("sample", "u", u, uniforms());
  const int drawn = distribution_.sample(self_.get(), u, x);
  monitor_->leave();
  return checked(drawn);
}

int PluginDistribution::sample(mc::Pcg& random, double* x) const {
  monitor_->enter("sample_stream");
  const int drawn = distribution_.sample_stream(self_.get(), next_uniform, &random, x);
  monitor_->leave();
  return checked(drawn);
}

int PluginDistribution::checked(int drawn) const {
  mc::require(drawn >= 0, "sample returned {}; it is MC_FAILED, MC_POINT or MC_OUTCOME + k", drawn);
  mc::require(drawn < MC_OUTCOME || distribution_.outcomes > 0 || distribution_.domain == MC_DISCRETE,
              "sample returned {}, MC_OUTCOME + {}, but it declares no outcomes; set outcomes and probability, or "
              "return MC_POINT",
              drawn, drawn - MC_OUTCOME);
  return drawn;
}

double PluginDistribution::pdf(const double* x) const {
  monitor_->enter("pdf", "x", x, coordinates());
  const double density = distribution_.pdf(self_.get(), x);
  monitor_->leave();
  return density;
}

bool PluginDistribution::invert(const double* x, double* u) const {
  monitor_->enter("invert", "x", x, coordinates());
  const bool ok = distribution_.invert(self_.get(), x, u) != 0;
  monitor_->leave();
  return ok;
}

double PluginDistribution::eval(const double* x) const {
  monitor_->enter("eval", "x", x, coordinates());
  const double f = distribution_.eval(self_.get(), x);
  monitor_->leave();
  return f;
}

double PluginDistribution::weight(const double* u, const double* x) const {
  monitor_->enter("weight", "u", u, uniforms());
  const double w = distribution_.weight(self_.get(), u, x);
  monitor_->leave();
  return w;
}

double PluginDistribution::probability(int outcome) const {
  monitor_->enter("probability");
  const double p = distribution_.probability(self_.get(), outcome);
  monitor_->leave();
  return p;
}

std::vector<double> PluginDistribution::breaks(int axis) const {
  if (!distribution_.breaks) return {};
  const double* places = nullptr;
  monitor_->enter("breaks");
  const int count = distribution_.breaks(self_.get(), axis, &places);
  monitor_->leave();
  mc::require(count >= 0 && count <= 1 << 24 && (count == 0 || places), "breaks returned {} places of axis {}", count,
              axis);
  return {places, places + count};
}

Plugin load_plugin(const std::string& path, CallMonitor& monitor) {
  // dlopen would search a name without a slash among the system's libraries.
  const std::string file = std::filesystem::absolute(path).string();
  monitor.enter("loading");
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  monitor.leave();
  if (!library) {
    std::string why = dlerror();
    if (why.starts_with(file + ": ")) why.erase(0, file.size() + 2);
    throw mc::Error(fmt::format("it cannot be loaded: {}", why));
  }
  const auto entry = reinterpret_cast<const mc_plugin_info* (*)()>(dlsym(library, "mc_plugin"));
  mc::require(entry != nullptr,
              "it has no function mc_plugin; end the source with MC_PLUGIN(samplers) of <mc/check/plugin.h>");
  monitor.enter("mc_plugin");
  const mc_plugin_info* const info = entry();
  monitor.leave();
  mc::require(info != nullptr, "mc_plugin returned NULL");
  mc::require(info->abi >= 1 && info->abi <= MC_PLUGIN_ABI,
              "it is made for version {} of <mc/check/plugin.h>, this carlo for 1 to {}; use the header of this carlo",
              info->abi, MC_PLUGIN_ABI);
  constexpr std::size_t sampler_sizes[] = {offsetof(mc_sampler, parts), offsetof(mc_sampler, sample_stream),
                                           offsetof(mc_sampler, sample_stream), sizeof(mc_sampler)};
  constexpr std::size_t integrand_sizes[] = {0, offsetof(mc_integrand, outputs), sizeof(mc_integrand),
                                             sizeof(mc_integrand)};
  static_assert(std::size(sampler_sizes) == MC_PLUGIN_ABI && std::size(integrand_sizes) == MC_PLUGIN_ABI);
  const std::size_t version = info->abi - 1;
  Plugin plugin;
  plugin.samplers = table("sampler", info->samplers, info->sampler_count, info->sampler_size, sampler_sizes[version]);
  if (version > 0)
    plugin.integrands =
        table("integrand", info->integrands, info->integrand_count, info->integrand_size, integrand_sizes[version]);
  mc::require(!plugin.samplers.empty() || !plugin.integrands.empty(), "it lists neither distributions nor integrands");
  return plugin;
}

} // namespace carlo

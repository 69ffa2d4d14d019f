#include <plugin/plugin.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <fmt/format.h>

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

namespace carlo {

namespace {

int dimension(const mc_sampler& s) {
  return s.domain == MC_INTERVAL || s.domain == MC_DISCRETE ? 1 : s.domain == MC_BOX ? s.dim : 2;
}

bool is_word(const char* text) {
  if (!text || !*text) return false;
  return std::all_of(text, text + std::string_view(text).size(),
                     [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

void require_sound(const mc_sampler& s, std::size_t index) {
  mc::require(is_word(s.name), "sampler {} has no name of letters, digits and _", index);
  mc::with_context(fmt::format("sampler {}", s.name), [&] {
    mc::require(s.domain >= MC_INTERVAL && s.domain <= MC_DISCRETE, "domain = {} is none of mc_domain, 1 to 7",
                s.domain);
    mc::require(s.domain != MC_BOX || (s.dim >= 1 && s.dim <= 3), "dim = {}; a box has 1 to 3 dimensions", s.dim);
    mc::require(s.domain != MC_INTERVAL || s.lo[0] < s.hi[0] || (s.lo[0] == 0 && s.hi[0] == 0),
                "interval [{}, {}] needs lo < hi", s.lo[0], s.hi[0]);
    mc::require(s.domain != MC_DISCRETE || (s.hi[0] >= 1 && s.hi[0] <= 1 << 24 && s.hi[0] == std::floor(s.hi[0])),
                "hi[0] = {} outcomes; 1 to 2^24 are needed", s.hi[0]);
    mc::require(s.domain != MC_DISCRETE || (!s.invert && !s.eval), "discrete outcomes have neither invert nor eval");
    mc::require(s.uniforms >= 0 && s.uniforms <= Watch::max_arguments, "uniforms = {} must lie in 0 to {}", s.uniforms,
                Watch::max_arguments);
    mc::require(s.scalar == MC_DOUBLE || s.scalar == MC_FLOAT, "scalar = {} is none of mc_scalar, 0 or 1", s.scalar);
    mc::require(s.sample, "it has no function sample");
    mc::require(s.pdf, "it has no function pdf");
    mc::require(!s.weight || s.eval, "it states a weight, but no eval to hold it against");
    mc::require(!s.invert || s.uniforms == 0 || s.uniforms == dimension(s),
                "it has invert, but takes {} uniforms in {} dimensions; invert needs as many", s.uniforms,
                dimension(s));
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

} // namespace

PluginSampler::PluginSampler(const mc_sampler& sampler, std::vector<double> parameters, Watch& watch)
    : sampler_(&sampler), parameters_(std::make_shared<std::vector<double>>(std::move(parameters))), watch_(&watch) {
  if (!sampler.create) {
    self_ = {parameters_, parameters_->data()};
    return;
  }
  watch.enter("create");
  void* self = sampler.create(parameters_->data());
  watch.leave();
  mc::require(self != nullptr, "create refuses the parameters");
  self_ = {self, [destroy = sampler.destroy, &watch](void* made) {
             if (!destroy) return;
             watch.enter("destroy");
             destroy(made);
             watch.leave();
           }};
}

int PluginSampler::coordinates() const {
  switch (sampler_->domain) {
  case MC_INTERVAL:
  case MC_DISCRETE: return 1;
  case MC_BOX: return sampler_->dim;
  case MC_DISK:
  case MC_TRIANGLE: return 2;
  default: return 3;
  }
}

int PluginSampler::uniforms() const { return sampler_->uniforms > 0 ? sampler_->uniforms : dimension(*sampler_); }

bool PluginSampler::sample(const double* u, double* x) const {
  watch_->enter("sample", "u", u, uniforms());
  const bool ok = sampler_->sample(self_.get(), u, x) != 0;
  watch_->leave();
  return ok;
}

double PluginSampler::pdf(const double* x) const {
  watch_->enter("pdf", "x", x, coordinates());
  const double density = sampler_->pdf(self_.get(), x);
  watch_->leave();
  return density;
}

bool PluginSampler::invert(const double* x, double* u) const {
  watch_->enter("invert", "x", x, coordinates());
  const bool ok = sampler_->invert(self_.get(), x, u) != 0;
  watch_->leave();
  return ok;
}

double PluginSampler::eval(const double* x) const {
  watch_->enter("eval", "x", x, coordinates());
  const double f = sampler_->eval(self_.get(), x);
  watch_->leave();
  return f;
}

double PluginSampler::weight(const double* u, const double* x) const {
  watch_->enter("weight", "u", u, uniforms());
  const double w = sampler_->weight(self_.get(), u, x);
  watch_->leave();
  return w;
}

std::span<const mc_sampler> load_plugin(const std::string& path, Watch& watch) {
  // A name without a slash would be searched for among the system's libraries.
  const std::string file = std::filesystem::absolute(path).string();
  watch.enter("loading");
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  watch.leave();
  if (!library) {
    std::string why = dlerror();
    if (why.starts_with(file + ": ")) why.erase(0, file.size() + 2);
    throw mc::Error(fmt::format("it cannot be loaded: {}", why));
  }
  const auto entry = reinterpret_cast<const mc_plugin_info* (*)()>(dlsym(library, "mc_plugin"));
  mc::require(entry != nullptr,
              "it has no function mc_plugin; end the source with MC_PLUGIN(samplers) of <mc/check/plugin.h>");
  watch.enter("mc_plugin");
  const mc_plugin_info* const info = entry();
  watch.leave();
  mc::require(info != nullptr, "mc_plugin returned NULL");
  mc::require(info->abi == MC_PLUGIN_ABI,
              "it is made for version {} of <mc/check/plugin.h>, this carlo for {}; compile it again", info->abi,
              MC_PLUGIN_ABI);
  mc::require(info->sampler_size == sizeof(mc_sampler), "its mc_sampler has {} bytes, that of <mc/check/plugin.h> {}",
              info->sampler_size, sizeof(mc_sampler));
  mc::require(info->sampler_count >= 1 && info->sampler_count <= 1000 && info->samplers,
              "it lists {} samplers; 1 to 1000 are needed", info->sampler_count);
  const std::span<const mc_sampler> samplers(info->samplers, info->sampler_count);
  for (std::size_t i = 0; i < samplers.size(); ++i) require_sound(samplers[i], i);
  return samplers;
}

} // namespace carlo

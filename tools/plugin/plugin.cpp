#include <plugin/bytes.h>
#include <plugin/plugin.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <fmt/format.h>

#include <dlfcn.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>

namespace mc {

template <class A> void each(A& a, Check& check) {
  auto& [name, verdict, p, share, statistic, limit, fault, detail] = check;
  a(name, verdict, p, share, statistic, limit, fault, detail);
}

template <class A> void each(A& a, WorstCell& cell) {
  auto& [lo, hi, observed, expected, z, where] = cell;
  a(lo, hi, observed, expected, z, where);
}

template <class A> void each(A& a, Axis& axis) {
  auto& [name, scale, from, to] = axis;
  a(name, scale, from, to);
}

template <class A> void each(A& a, CellCount& cell) {
  auto& [lo, hi, observed, expected] = cell;
  a(lo, hi, observed, expected);
}

template <class A> void each(A& a, Evidence::After& after) {
  auto& [samples, p] = after;
  a(samples, p);
}

template <class A> void each(A& a, Evidence& evidence) {
  auto& [cells, outcomes, p_after] = evidence;
  a(cells, outcomes, p_after);
}

template <class A> void each(A& a, Figure& figure) {
  auto& [name, value, std_error, where] = figure;
  a(name, value, std_error, where);
}

template <class A> void each(A& a, Report& report) {
  auto& [subject, alpha, samples, mass, mass_error, detectable, detectable_cell, seconds, ns_per_sample, checks, axes,
         worst, evidence, figures] = report;
  a(subject, alpha, samples, mass, mass_error, detectable, detectable_cell, seconds, ns_per_sample, checks, axes, worst,
    evidence, figures);
}

} // namespace mc

namespace carlo {

namespace {

// What the parent learns about a sampler.
struct Parameter {
  std::string name;
  double value, lo, hi;
};
struct Description {
  std::string name, scalar;
  std::vector<Parameter> parameters;
};

template <class A> void each(A& a, Parameter& parameter) {
  auto& [name, value, lo, hi] = parameter;
  a(name, value, lo, hi);
}

template <class A> void each(A& a, Description& description) {
  auto& [name, scalar, parameters] = description;
  a(name, scalar, parameters);
}

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

std::vector<Description> describe(const std::string& path, double timeout) {
  const std::string bytes = run_isolated(path, timeout, [&](Watch& watch) {
    std::vector<Description> all;
    for (const mc_sampler& s : load_plugin(path, watch)) {
      Description& d = all.emplace_back(Description{s.name, s.scalar == MC_FLOAT ? "float" : "double", {}});
      for (int i = 0; i < s.parameter_count; ++i)
        d.parameters.push_back({s.parameters[i].name, s.parameters[i].value, s.parameters[i].lo, s.parameters[i].hi});
    }
    ByteWriter writer;
    writer(all);
    return writer.bytes;
  });
  std::vector<Description> all;
  ByteReader{bytes}(all);
  return all;
}

// "alpha=0.1, n=3"
using Set = std::vector<std::pair<std::string, double>>;
Set parse_set(std::string_view text) {
  Set set;
  for (std::string_view rest = text; !rest.empty();) {
    std::string_view one = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
    while (one.starts_with(' ')) one.remove_prefix(1);
    const std::size_t equals = one.find('=');
    double value = 0;
    const char* end = one.data() + one.size();
    mc::require(equals != std::string_view::npos && equals > 0 &&
                    std::from_chars(one.data() + equals + 1, end, value).ptr == end && std::isfinite(value),
                "--params: '{}' in '{}' is not of the form name=number, as in \"alpha=0.1,n=3\"", one, text);
    set.emplace_back(one.substr(0, equals), value);
  }
  return set;
}

Parameter* find(std::vector<Parameter>& parameters, const std::string& name) {
  const auto it =
      std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == name; });
  return it == parameters.end() ? nullptr : &*it;
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

Catalogue plugin_cases(const std::string& path, const std::vector<std::string>& sets, double timeout) {
  mc::require(timeout > 0 && timeout <= 1e6, "validate: --timeout {} must lie in (0, 1e6] seconds", timeout);
  std::error_code error;
  mc::require(std::filesystem::exists(path, error), "cannot read '{}': no such file", path);
  const std::vector<Description> samplers = describe(path, timeout);

  std::set<std::string> known;
  for (const Description& d : samplers)
    for (const Parameter& p : d.parameters) known.insert(p.name);
  std::vector<Set> parsed;
  for (const std::string& text : sets) {
    parsed.push_back(parse_set(text));
    for (const auto& [name, value] : parsed.back())
      mc::require(known.contains(name), "{}: --params: no sampler has a parameter '{}'{}", path, name,
                  mc::did_you_mean(name, known));
  }

  Catalogue cases;
  const auto add = [&](std::size_t index, const Description& d, const std::vector<Parameter>& parameters,
                       const Set& set) {
    Case& c = cases.emplace_back();
    c.name = d.name, c.scalar = d.scalar;
    for (const auto& [name, value] : set)
      c.parameters += fmt::format("{}{}={}", c.parameters.empty() ? "" : ", ", name, value);
    std::vector<double> values;
    for (const Parameter& p : parameters) values.push_back(p.value);
    c.again = fmt::format("--plugin '{}' {}", path, d.name);
    if (!set.empty()) c.again += fmt::format(" --params '{}'", c.parameters);
    c.check = [=, title = c.title()](const CaseOptions& options) {
      const std::string bytes = run_isolated(path, timeout, [&](Watch& watch) {
        mc::Report report = check_plugin(PluginSampler(load_plugin(path, watch)[index], values, watch), title, options);
        ByteWriter writer;
        writer(report);
        return writer.bytes;
      });
      mc::Report report;
      mc::with_context(path, [&] { ByteReader{bytes}(report); });
      return report;
    };
  };
  std::vector<bool> used(parsed.size());
  for (std::size_t index = 0; index < samplers.size(); ++index) {
    bool any = false;
    for (std::size_t k = 0; k < parsed.size(); ++k) {
      std::vector<Parameter> parameters = samplers[index].parameters;
      if (!std::all_of(parsed[k].begin(), parsed[k].end(),
                       [&](const auto& one) { return find(parameters, one.first); }))
        continue;
      for (const auto& [name, value] : parsed[k]) {
        Parameter& p = *find(parameters, name);
        mc::require(value >= p.lo && value <= p.hi, "{}: --params: {} = {} of {} must lie in [{}, {}]", path, name,
                    value, samplers[index].name, p.lo, p.hi);
        p.value = value;
      }
      add(index, samplers[index], parameters, parsed[k]);
      any = used[k] = true;
    }
    if (!any) add(index, samplers[index], samplers[index].parameters, {});
  }
  for (std::size_t k = 0; k < parsed.size(); ++k)
    mc::require(used[k], "{}: no sampler has all the parameters of --params '{}'", path, sets[k]);
  return cases;
}

} // namespace carlo

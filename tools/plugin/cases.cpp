/// Requests about a plugin: the code that sends them in carlo and the code that answers them in the worker.

#include <input/parameters.h>
#include <plugin/check_request.h>
#include <plugin/plugin.h>
#include <report/report_json.h>

#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/random/pcg.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

namespace carlo {

using nlohmann::json;

namespace {

// Description of a sampler that the worker sends to carlo.
struct Parameter {
  std::string name;
  double value, lo, hi;
};
struct Description {
  std::string name, scalar;
  std::vector<Parameter> parameters;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Parameter, name, value, lo, hi)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Description, name, scalar, parameters)

std::vector<Description> describe(const std::string& path, CallMonitor& monitor) {
  std::vector<Description> all;
  for (const mc_sampler& s : load_plugin(path, monitor).samplers) {
    Description& d = all.emplace_back(Description{s.name, s.scalar == MC_FLOAT ? "float" : "double", {}});
    for (int i = 0; i < s.parameter_count; ++i)
      d.parameters.push_back({s.parameters[i].name, s.parameters[i].value, s.parameters[i].lo, s.parameters[i].hi});
  }
  return all;
}

Parameter* find(std::vector<Parameter>& parameters, const std::string& name) {
  const auto it =
      std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == name; });
  return it == parameters.end() ? nullptr : &*it;
}

// A parameter set and the text that it was parsed from.
struct Asked {
  ParameterSet values;
  std::string text;
};

std::vector<Asked> asked_sets(const std::string& path, const std::vector<std::string>& texts,
                              const std::vector<Description>& samplers) {
  std::set<std::string> known;
  for (const Description& d : samplers)
    for (const Parameter& p : d.parameters) known.insert(p.name);
  std::vector<Asked> all;
  for (const std::string& text : texts)
    for (ParameterSet& set : parse_parameters(text)) {
      for (const auto& [name, value] : set)
        mc::require(known.contains(name), "{}: --params: no distribution has a parameter '{}'{}", path, name,
                    mc::did_you_mean(name, known));
      all.push_back({std::move(set), text});
    }
  return all;
}

// The sampler's parameters, replaced by the values of the set. Nothing if the sampler lacks one of the names. A value
// out of range throws if the sampler was `asked` for, and returns nothing otherwise.
std::optional<std::vector<double>> values_of(const std::string& path, const Description& d, const ParameterSet& set,
                                             bool asked) {
  std::vector<Parameter> parameters = d.parameters;
  for (const auto& [name, value] : set)
    if (!find(parameters, name)) return {};
  for (const auto& [name, value] : set) {
    Parameter& p = *find(parameters, name);
    const bool fits = value >= p.lo && value <= p.hi;
    if (!fits && !asked) return {};
    mc::require(fits, "{}: --params: {} = {} of {} must lie in [{}, {}]", path, name, value, d.name, p.lo, p.hi);
    p.value = value;
  }
  std::vector<double> values(parameters.size());
  std::ranges::transform(parameters, values.begin(), &Parameter::value);
  return values;
}

// The set with random values for the other parameters of the sampler, rounded to six digits.
ParameterSet completed(const std::string& path, const Description& d, ParameterSet set, mc::Pcg& random) {
  for (const Parameter& p : d.parameters) {
    if (std::ranges::any_of(set, [&](const auto& given) { return given.first == p.name; })) continue;
    mc::require(std::isfinite(p.hi - p.lo), "{}: --random-params: {} of {} has no finite range; set it with --params",
                path, p.name, d.name);
    const double u = random.uniform<double>();
    const bool is_log = p.lo > 0 && p.hi >= 100 * p.lo;
    const double value = is_log ? p.lo * std::pow(p.hi / p.lo, u) : p.lo + (p.hi - p.lo) * u;
    const double rounded = std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
    set.emplace_back(p.name, std::clamp(rounded, p.lo, p.hi));
  }
  return set;
}

Case make_case(const std::string& path, std::size_t index, const Description& d, const ParameterSet& set,
               const std::vector<double>& values, const WorkerOptions& worker) {
  Case c;
  c.name = d.name;
  c.scalar = d.scalar;
  for (const auto& [name, value] : set)
    c.parameters += fmt::format("{}{}={}", c.parameters.empty() ? "" : ", ", name, value);
  c.rerun_arguments = fmt::format("--plugin '{}' {}", path, d.name);
  if (!set.empty()) c.rerun_arguments += fmt::format(" --params '{}'", c.parameters);
  c.check = [=, title = c.title()](const CaseOptions& o) {
    json request = check_request("check", path, title, o);
    request["index"] = index;
    request["parameters"] = values;
    return report_from_json(call_worker(std::move(request), worker));
  };
  return c;
}

} // namespace

json run_plugin_task(const json& request, CallMonitor& monitor) {
  const std::string path = request["who"];
  if (request["task"] == "describe") return describe(path, monitor);
  const mc_sampler distribution = load_plugin(path, monitor).samplers[request["index"].get<std::size_t>()];
  return to_json(check_plugin(PluginDistribution(distribution, request["parameters"], monitor), request["title"],
                              requested_options(request)));
}

Catalogue plugin_cases(const std::string& path, const std::vector<std::string>& texts,
                       const std::vector<std::string>& names, const WorkerOptions& worker,
                       const RandomParameters& random) {
  std::error_code error;
  mc::require(std::filesystem::exists(path, error), "cannot read '{}': no such file", path);
  const std::vector<Description> samplers = call_worker({{"task", "describe"}, {"who", path}}, worker);
  mc::require(!samplers.empty(), "{}: it contains integrands but no distributions; see carlo converge --plugin", path);
  const std::vector<Asked> asked = asked_sets(path, texts, samplers);
  std::set<std::string> used;
  Catalogue cases;
  for (std::size_t index = 0; index < samplers.size(); ++index) {
    const Description& d = samplers[index];
    const std::size_t before = cases.size();
    const auto is_it = [&](const std::string& name) { return name == d.name || name.starts_with(d.name + "("); };
    const bool named = names.empty() || std::any_of(names.begin(), names.end(), is_it);
    mc::Pcg numbers(random.seed, index);
    const auto add = [&](const ParameterSet& set) {
      const int count = random.cases > 0 && set.size() < d.parameters.size() ? random.cases : 0;
      for (int i = 0; i < std::max(count, 1); ++i) {
        const ParameterSet own = count > 0 ? completed(path, d, set, numbers) : set;
        if (const auto values = values_of(path, d, own, named))
          cases.push_back(make_case(path, index, d, own, *values, worker));
      }
    };
    for (const Asked& set : asked)
      if (values_of(path, d, set.values, named)) {
        add(set.values);
        used.insert(set.text);
      }
    if (cases.size() == before) add({});
  }
  for (const Asked& set : asked)
    mc::require(used.contains(set.text), "{}: no distribution has all the parameters of --params '{}'", path, set.text);
  return cases;
}

} // namespace carlo

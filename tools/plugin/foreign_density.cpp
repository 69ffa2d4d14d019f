#include <input/parsed_domain.h>
#include <integrands/box_map.h>
#include <plugin/foreign_density.h>
#include <plugin/foreign_rows.h>
#include <plugin/paced_program.h>
#include <plugin/plugin.h>
#include <plugin/plugin_integrand.h>

#include <mc/core/cpu_time.h>
#include <mc/core/error.h>
#include <mc/core/text.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace carlo {

using nlohmann::json;

namespace {

std::vector<double> default_parameters(const mc_sampler& s) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(s.parameter_count));
  for (int i = 0; i < s.parameter_count; ++i) values.push_back(s.parameters[i].value);
  return values;
}

// The densities of a plugin: those of integrands, then its distributions of points by length, area or volume.
json describe(const Plugin& plugin, CallMonitor& monitor) {
  json all = json::array();
  for (std::size_t i = 0; i < plugin.integrands.size(); ++i) {
    const mc_integrand& f = plugin.integrands[i];
    if (f.sample)
      all.push_back(
          {{"kind", "integrand"}, {"index", i}, {"name", f.name}, {"dim", f.dim}, {"uniforms", unit_dimension(f)}});
  }
  for (std::size_t i = 0; i < plugin.samplers.size(); ++i) {
    const mc_sampler& s = plugin.samplers[i];
    const ParsedDomain domain = parse_domain(domain_text(s));
    const bool is_lebesgue = !domain.outcomes.any() && s.outcomes == 0 &&
                             static_cast<std::size_t>(domain.chart.dim) == domain.columns.size();
    if (!is_lebesgue) continue;
    const PluginDistribution d(s, default_parameters(s), monitor);
    all.push_back(
        {{"kind", "sampler"}, {"index", i}, {"name", s.name}, {"dim", d.coordinates()}, {"uniforms", d.uniforms()}});
  }
  return all;
}

json chosen_density(const ForeignDensityOptions& o) {
  const json all = call_worker({{"task", "describe densities"}, {"who", o.plugin}}, o.worker);
  std::vector<std::string> names;
  for (const json& one : all) names.push_back(one["name"]);
  mc::require(!all.empty(),
              "{}: it contains no importance density: no integrand with sample and pdf, and no "
              "distribution of points by length, area or volume",
              o.plugin);
  mc::require(all.size() == 1 || !o.name.empty(), "{}: it contains {} densities; choose one of {} by --importance-name",
              o.plugin, all.size(), fmt::join(names, ", "));
  if (o.name.empty()) return all[0];
  const auto found = std::find(names.begin(), names.end(), o.name);
  mc::require(found != names.end(), "{}: unknown density '{}'{}; it contains {}", o.plugin, o.name,
              mc::did_you_mean(o.name, names), fmt::join(names, ", "));
  return all[static_cast<std::size_t>(found - names.begin())];
}

// A sample and its density, which is 0 where the sampler failed.
using DrawOne = std::function<double(std::span<const double> u, std::span<double> x)>;

DrawOne draw_of(const Plugin& plugin, const json& request, CallMonitor& monitor) {
  const std::size_t index = request["index"];
  if (request["kind"] == "integrand")
    return [&f = plugin.integrands[index], &monitor](std::span<const double> u, std::span<double> x) {
      return sample_density(f, monitor, u, x);
    };
  const mc_sampler& s = plugin.samplers[index];
  return [d = PluginDistribution(s, default_parameters(s), monitor)](std::span<const double> u, std::span<double> x) {
    if (d.sample(u.data(), x.data()) == MC_FAILED) return 0.0;
    const double density = d.pdf(x.data());
    require_density(density, u, x);
    return density;
  };
}

// Rows of a result: the coordinates of a sample, then its density.
void answer_samples(const json& request, CallMonitor& monitor) {
  const RowShape shape{request["uniforms"], request["dim"].get<std::size_t>() + 1};
  if (request["task"] == "density command") {
    PacedProgram program(request["who"], monitor);
    const std::size_t dim = shape.out - 1;
    const auto draw = [&](std::span<const double> u, std::span<double> results) {
      const std::size_t rows = results.size() / shape.out;
      std::vector<double> x(rows * dim), densities(rows);
      program.ask("sample", "u", u, shape.in, x);
      program.ask("pdf", "x", x, dim, densities);
      for (std::size_t i = 0; i < rows; ++i) {
        const std::span<const double> at = std::span(x).subspan(i * dim, dim);
        require_density(densities[i], u.subspan(i * shape.in, shape.in), at);
        std::ranges::copy(at, results.begin() + static_cast<std::ptrdiff_t>(i * shape.out));
        results[i * shape.out + dim] = densities[i];
      }
    };
    return answer_rows(request, monitor, shape, draw, [&] { return program.cpu_seconds(); });
  }
  const Plugin plugin = load_plugin(request["who"], monitor);
  const DrawOne draw_one = draw_of(plugin, request, monitor);
  const auto draw = [&](std::span<const double> u, std::span<double> results) {
    for (std::size_t i = 0; i < results.size() / shape.out; ++i) {
      const std::span<double> row = results.subspan(i * shape.out, shape.out);
      row.back() = draw_one(u.subspan(i * shape.in, shape.in), row.first(shape.out - 1));
    }
  };
  answer_rows(request, monitor, shape, draw, mc::thread_cpu_seconds);
}

} // namespace

ImportanceDensity foreign_density(const ForeignDensityOptions& o) {
  for (const VariableBounds& s : o.bounds)
    mc::require(s.lo < s.hi, "an importance density needs constant bounds; those of {} are not", s.name);
  const BoxMap box(o.bounds);
  const std::size_t dim = box.dim();
  json request = {{"task", "density command"}, {"who", o.command}, {"dim", dim}};
  request["uniforms"] = o.uniforms > 0 ? static_cast<std::size_t>(o.uniforms) : dim;
  if (!o.plugin.empty()) {
    request.update(chosen_density(o));
    mc::require(request["dim"] == dim, "{}: the density {} has {} coordinates, the integrand {} variables", o.plugin,
                request["name"].get<std::string>(), request["dim"].get<std::size_t>(), dim);
    request["task"] = "density plugin";
    request["who"] = o.plugin;
  }
  const RowShape shape{request["uniforms"], dim + 1};
  const auto rows = std::make_shared<ForeignRows>(request, shape, o.worker);
  return {static_cast<int>(shape.in),
          [rows, box, shape](std::span<const double> u, std::span<double> v, std::span<double> densities) {
            const std::size_t n = shape.out - 1;
            std::vector<double> drawn(densities.size() * shape.out);
            (*rows)(u, drawn);
            for (std::size_t i = 0; i < densities.size(); ++i) {
              const std::span<const double> row = std::span(drawn).subspan(i * shape.out, shape.out);
              densities[i] = row.back() * box.unmap(row.first(n), v.subspan(i * n, n));
            }
          }};
}

json run_density_task(const json& request, CallMonitor& monitor) {
  if (request["task"] == "describe densities") return describe(load_plugin(request["who"], monitor), monitor);
  answer_samples(request, monitor);
  return {};
}

} // namespace carlo

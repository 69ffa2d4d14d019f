#include <input/parsed_domain.h>
#include <plugin/plugin.h>

#include <mc/check/laws.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

using mc::PointArray, mc::AnyDistribution;

// Rounds to the plugin's scalar type.
double rounded(const PluginDistribution& p, double x) {
  return p->scalar == MC_FLOAT ? static_cast<double>(static_cast<float>(x)) : x;
}

// The points of pilot samples.
std::vector<PointArray> pilot(const PluginDistribution& plugin, std::uint64_t seed) {
  mc::Pcg random(seed, 34);
  std::vector<PointArray> drawn;
  for (int i = 0; i < 1000; ++i) {
    AnyDistribution::Uniforms u{};
    for (int k = 0; k < plugin.uniforms(); ++k) u[static_cast<std::size_t>(k)] = random.uniform<double>();
    PointArray x{};
    x.fill(std::numeric_limits<double>::quiet_NaN());
    if ((plugin->sample ? plugin.sample(u.data(), x.data()) : plugin.sample(random, x.data())) == MC_POINT)
      drawn.push_back(x);
  }
  return drawn;
}

ParsedDomain domain_of(const PluginDistribution& plugin, std::uint64_t seed) {
  const auto quartiles = [&](std::size_t column) {
    std::vector<double> numbers;
    for (const PointArray& x : pilot(plugin, seed)) numbers.push_back(x[column]);
    return quartiles_of(std::move(numbers));
  };
  return parse_domain(domain_text(*plugin), quartiles,
                      plugin->scalar == MC_FLOAT ? Rounding::floats : Rounding::doubles);
}

// Sets weight to weight pdf / f, which is 1 if they agree.
void set_weight(const PluginDistribution& plugin, const AnyDistribution::Uniforms& u, AnyDistribution::Sample& d) {
  const double f = plugin.eval(d.x.data()), stated = plugin.weight(u.data(), d.x.data());
  d.weight = f == 0 && stated == 0 ? 1.0 : stated * d.pdf / f;
  d.stated.value = stated;
  d.stated.expected = f / d.pdf;
}

// The sample that draw(x) returns, rounded to the plugin's scalar. Coordinates that the plugin does not write stay NaN.
template <class Draw>
std::optional<AnyDistribution::Sample> drawn_by(const PluginDistribution& plugin, const Draw& draw) {
  AnyDistribution::Sample d;
  const auto n = static_cast<std::size_t>(plugin.coordinates());
  std::fill_n(d.x.begin(), n, std::numeric_limits<double>::quiet_NaN());
  const int drawn = draw(d.x.data());
  if (drawn == MC_FAILED) return {};
  if (drawn >= MC_OUTCOME) {
    d.x = {};
    d.atom = drawn - MC_OUTCOME;
    return d;
  }
  for (std::size_t i = 0; i < n; ++i) d.x[i] = rounded(plugin, d.x[i]);
  if (plugin->domain == MC_DISCRETE && d.x[0] >= 0 && d.x[0] < plugin->hi[0] && d.x[0] == std::floor(d.x[0]))
    d.atom = static_cast<int>(d.x[0]);
  return d;
}

// The sample for u, with its weight if it states one.
std::optional<AnyDistribution::Sample> draw(const PluginDistribution& plugin, const mc::AnyDomain& domain,
                                            const AnyDistribution::Uniforms& u) {
  auto d = drawn_by(plugin, [&](double* x) { return plugin.sample(u.data(), x); });
  if (!d || !plugin->weight || d->atom >= 0 || plugin->domain == MC_DISCRETE) return d;
  const bool finite = std::all_of(d->x.begin(), d->x.end(), [](double x) { return std::isfinite(x); });
  if (!finite || !domain.contains(d->x)) return d;
  d->pdf = plugin.pdf(d->x.data());
  set_weight(plugin, u, *d);
  return d;
}

double time_of(const PluginDistribution& plugin, const AnyDistribution& s) {
  mc::Pcg random(3);
  if (!plugin->sample)
    return mc::ns_per_sample(std::vector<int>(mc::timing_inputs / 2), [&](int) {
      PointArray x{};
      plugin.sample(random, x.data());
      return x;
    });
  std::vector<AnyDistribution::Uniforms> u(mc::timing_inputs / 2);
  for (AnyDistribution::Uniforms& one : u) one = random_uniforms(s, random);
  return mc::ns_per_sample(u, [&](const AnyDistribution::Uniforms& one) {
    PointArray x{};
    plugin.sample(one.data(), x.data());
    return x;
  });
}

double invert_tolerance(const PluginDistribution& plugin, double epsilon) {
  return plugin->invert_tolerance > 0 ? plugin->invert_tolerance : std::sqrt(epsilon);
}

} // namespace

mc::AnyDistribution plugin_distribution(const PluginDistribution& plugin, const std::string& title,
                                        std::uint64_t seed) {
  const ParsedDomain domain = domain_of(plugin, seed);
  AnyDistribution s;
  s.name = title;
  s.domain = domain.chart;
  s.is_float = plugin->scalar == MC_FLOAT;
  s.open_interval = plugin->open_interval != 0;
  Breaks places;
  for (int axis = 0; axis < domain.chart.dim; ++axis) places[static_cast<std::size_t>(axis)] = plugin.breaks(axis);
  s.breaks = chart_breaks(domain.chart, places);
  for (int i = 0; i < domain.outcomes.count(); ++i) s.atoms.push_back(plugin.pdf(domain.row_of(i).data()));
  for (int k = 0; k < plugin->outcomes; ++k) s.atoms.push_back(plugin.probability(k));
  s.uniforms = plugin->sample ? plugin.uniforms() : 0;
  s.states_weight = plugin->weight != nullptr;
  s.may_fail = plugin->may_fail != 0;
  if (plugin->pdf_tolerance > 0) s.mass_tolerance = plugin->pdf_tolerance;
  if (plugin->weight_tolerance > 0) s.weight_tolerance = plugin->weight_tolerance;
  if (plugin->sample)
    s.sample = [plugin, domain = s.domain](const AnyDistribution::Uniforms& u) { return draw(plugin, domain, u); };
  else
    s.sample_stream = [plugin](mc::Pcg& random) {
      return drawn_by(plugin, [&](double* x) { return plugin.sample(random, x); });
    };
  const auto exactly = [plugin](PointArray x) {
    for (double& one : x) one = rounded(plugin, one);
    return x;
  };
  if (s.domain.dim == 0) return s;
  s.pdf = [plugin, exactly](const PointArray& x) { return plugin.pdf(exactly(x).data()); };
  if (plugin->eval) s.eval = [plugin, exactly](const PointArray& x) { return plugin.eval(exactly(x).data()); };
  if (!plugin->invert) return s;
  s.invert_tolerance = invert_tolerance(plugin, s.epsilon());
  s.invert = [plugin, exactly](const PointArray& x) -> std::optional<AnyDistribution::Uniforms> {
    AnyDistribution::Uniforms u{};
    std::fill_n(u.begin(), plugin.uniforms(), std::numeric_limits<double>::quiet_NaN());
    if (!plugin.invert(exactly(x).data(), u.data())) return {};
    return u;
  };
  return s;
}

mc::Report check_plugin(const PluginDistribution& plugin, const std::string& title, const CaseOptions& options) {
  AnyDistribution s = plugin_distribution(plugin, title, options.seed);
  s.ns_per_sample = [&] { return time_of(plugin, s); };
  return check_laws(s, {.statistics = options, .invert_eps = invert_tolerance(plugin, s.epsilon()) / s.epsilon()});
}

} // namespace carlo

#include <plugin/plugin.h>

#include <mc/check/laws.h>
#include <mc/domain/triangle.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

using mc::Numbers, mc::AnySampler;

// As the plugin's scalar has it.
double rounded(const PluginSampler& p, double x) {
  return p->scalar == MC_FLOAT ? static_cast<double>(static_cast<float>(x)) : x;
}

// The quartiles of the samples on a line: charts of infinite intervals are centred on them.
std::array<double, 3> quartiles(const PluginSampler& plugin, std::uint64_t seed) {
  mc::Pcg random(seed, 34);
  std::vector<double> drawn;
  for (int i = 0; i < 1000; ++i) {
    AnySampler::Uniforms u{};
    for (int k = 0; k < plugin.uniforms(); ++k) u[static_cast<std::size_t>(k)] = random.uniform<double>();
    double x = std::numeric_limits<double>::quiet_NaN();
    if (plugin.sample(u.data(), &x) && std::isfinite(x)) drawn.push_back(x);
  }
  if (drawn.empty()) return {-1, 0, 1};
  std::sort(drawn.begin(), drawn.end());
  return {drawn[drawn.size() / 4], drawn[drawn.size() / 2], drawn[drawn.size() * 3 / 4]};
}

template <mc::Real S> AnySampler on_line(const PluginSampler& plugin, std::uint64_t seed) {
  const double lo = plugin->lo[0], hi = plugin->hi[0];
  const auto on = [](const auto& domain) { return mc::detail::sampler_on("", domain); };
  if (std::isfinite(lo) && std::isfinite(hi))
    return on(lo == 0 && hi == 0 ? mc::Interval<S>() : mc::Interval<S>(static_cast<S>(lo), static_cast<S>(hi)));
  const auto [low, middle, high] = quartiles(plugin, seed);
  const auto scale = [](double size) { return static_cast<S>(size > 0 ? size : 1.0); };
  if (std::isinf(lo) && std::isinf(hi)) return on(mc::RealLine<S>(static_cast<S>(middle), scale(high - low)));
  if (std::isinf(hi)) return on(mc::HalfLine<S>(static_cast<S>(lo), scale(middle - lo)));
  return on(mc::HalfLine<S>(static_cast<S>(hi), -scale(hi - middle)));
}

template <mc::Real S, int N> AnySampler in_box(const PluginSampler& plugin) {
  const auto is_zero = [](double x) { return x == 0; };
  const bool unit =
      std::all_of(plugin->lo, plugin->lo + 3, is_zero) && std::all_of(plugin->hi, plugin->hi + 3, is_zero);
  mc::Vec<S, N> lo, hi;
  for (int i = 0; i < N; ++i) {
    lo[i] = static_cast<S>(plugin->lo[i]);
    hi[i] = unit ? S(1) : static_cast<S>(plugin->hi[i]);
  }
  return mc::detail::sampler_on("", mc::Box<S, N>(lo, hi));
}

// A sampler of the plugin's domain that draws nothing yet.
template <mc::Real S> AnySampler on_domain(const PluginSampler& plugin, std::uint64_t seed) {
  switch (plugin->domain) {
  case MC_INTERVAL: return on_line<S>(plugin, seed);
  case MC_BOX:
    return plugin->dim == 1 ? on_line<S>(plugin, seed) : plugin->dim == 2 ? in_box<S, 2>(plugin) : in_box<S, 3>(plugin);
  case MC_DISK: return mc::detail::sampler_on("", mc::Disk<S>());
  case MC_TRIANGLE: return mc::detail::sampler_on("", mc::Triangle<S>());
  case MC_SPHERE: return mc::detail::sampler_on("", mc::Sphere<S>());
  case MC_HEMISPHERE: return mc::detail::sampler_on("", mc::Hemisphere<S>());
  default: {
    AnySampler outcomes;
    outcomes.is_float = std::same_as<S, float>;
    outcomes.domain.numbers = 1;
    for (double i = 0; i < plugin->hi[0]; ++i) outcomes.atoms.push_back(plugin.pdf(&i));
    return outcomes;
  }
  }
}

// weight pdf / f, 1 where they agree.
double weight_ratio(const PluginSampler& plugin, const AnySampler::Uniforms& u, const Numbers& x, double pdf) {
  const double f = plugin.eval(x.data()), stated = plugin.weight(u.data(), x.data());
  return f == 0 && stated == 0 ? 1.0 : stated * pdf / f;
}

// The point that the plugin makes of u; what it forgets to write shows as NaN.
std::optional<AnySampler::Drawn> draw(const PluginSampler& plugin, const mc::AnyDomain& domain,
                                      const AnySampler::Uniforms& u) {
  AnySampler::Drawn d;
  const auto n = static_cast<std::size_t>(plugin.coordinates());
  std::fill_n(d.x.begin(), n, std::numeric_limits<double>::quiet_NaN());
  if (!plugin.sample(u.data(), d.x.data())) return {};
  for (std::size_t i = 0; i < n; ++i) d.x[i] = rounded(plugin, d.x[i]);
  if (plugin->domain == MC_DISCRETE) {
    if (d.x[0] >= 0 && d.x[0] < plugin->hi[0] && d.x[0] == std::floor(d.x[0])) d.atom = static_cast<int>(d.x[0]);
    return d;
  }
  const bool finite = std::all_of(d.x.begin(), d.x.end(), [](double x) { return std::isfinite(x); });
  if (!plugin->weight || !finite || !domain.contains(d.x)) return d;
  d.pdf = plugin.pdf(d.x.data());
  d.weight = weight_ratio(plugin, u, d.x, d.pdf);
  return d;
}

double time_of(const PluginSampler& plugin, const AnySampler& s) {
  mc::Pcg random(3);
  std::vector<AnySampler::Uniforms> u(mc::timing_inputs / 2);
  for (AnySampler::Uniforms& one : u) one = random_uniforms(s, random);
  return mc::ns_per_sample(u, [&](const AnySampler::Uniforms& one) {
    Numbers x{};
    plugin.sample(one.data(), x.data());
    return x[0];
  });
}

double invert_tolerance(const PluginSampler& plugin, double epsilon) {
  return plugin->invert_tolerance > 0 ? plugin->invert_tolerance : std::sqrt(epsilon);
}

} // namespace

mc::AnySampler sampler_of(const PluginSampler& plugin, const std::string& title, std::uint64_t seed) {
  AnySampler s = plugin->scalar == MC_FLOAT ? on_domain<float>(plugin, seed) : on_domain<double>(plugin, seed);
  s.name = title;
  s.uniforms = plugin.uniforms();
  s.may_fail = plugin->may_fail != 0;
  if (plugin->pdf_tolerance > 0) s.mass_tolerance = plugin->pdf_tolerance;
  if (plugin->weight_tolerance > 0) s.weight_tolerance = plugin->weight_tolerance;
  s.sample = [plugin, domain = s.domain](const AnySampler::Uniforms& u) { return draw(plugin, domain, u); };
  const auto exactly = [plugin](Numbers x) {
    for (double& one : x) one = rounded(plugin, one);
    return x;
  };
  if (s.domain.dim == 0) return s;
  s.pdf = [plugin, exactly](const Numbers& x) { return plugin.pdf(exactly(x).data()); };
  if (plugin->eval) s.eval = [plugin, exactly](const Numbers& x) { return plugin.eval(exactly(x).data()); };
  if (!plugin->invert) return s;
  s.invert_tolerance = invert_tolerance(plugin, s.epsilon());
  s.invert = [plugin, exactly](const Numbers& x) -> std::optional<AnySampler::Uniforms> {
    AnySampler::Uniforms u{};
    std::fill_n(u.begin(), plugin.uniforms(), std::numeric_limits<double>::quiet_NaN());
    if (!plugin.invert(exactly(x).data(), u.data())) return {};
    return u;
  };
  return s;
}

mc::Report check_plugin(const PluginSampler& plugin, const std::string& title, const CaseOptions& options) {
  AnySampler s = sampler_of(plugin, title, options.seed);
  s.ns_per_sample = [&] { return time_of(plugin, s); };
  const mc::LawOptions bounds{.invert_eps = invert_tolerance(plugin, s.epsilon()) / s.epsilon()};
  return check_laws(s, mc::with_statistics(bounds, options));
}

} // namespace carlo

#include <mc/check/laws/bsdf/roughness_limit.h>

#include <mc/estimate/moments.h>

namespace mc {
namespace {

double excess(const Moments& m, double allowed, const RoughnessLimitOptions& options) {
  return m.non_finite_count() ? HUGE_VAL
                              : std::max(std::abs(m.mean()) - allowed - options.noise - 5 * m.std_error(), 0.0);
}

// Features of one draw: weight and weight * wi of each channel (missing channels repeat the last one), and absorption.
constexpr std::size_t per_channel = 4, feature_count = per_channel * Channels::max_count + 1;
using Features = std::array<double, feature_count>;

Features features(const std::optional<AnyBsdf::Sample>& drawn, const RoughnessLimitOptions& options) {
  Features all{};
  if (!drawn) all.back() = 1;
  if (!drawn) return all;
  const Channels weight = throughput(*drawn, options.bsdf);
  for (int c = 0; c < Channels::max_count; ++c) {
    double* at = &all[per_channel * static_cast<std::size_t>(c)];
    *at = weight[c];
    for (int i = 0; i < 3; ++i) *++at = weight[c] * drawn->wi[i];
  }
  return all;
}

std::string name_of(std::size_t feature) {
  constexpr std::array<const char*, per_channel> names{"weight", "weight x", "weight y", "weight z"};
  if (feature + 1 == feature_count) return "absorbed fraction";
  return fmt::format("{} of channel {}", names[feature % per_channel], feature / per_channel);
}

void compare_samples(const AnyBsdf& rough, const AnyBsdf& limit, double r, const AnyBsdf::Direction& wo,
                     const RoughnessLimitOptions& options, WorstError& sample) {
  std::array<Moments, feature_count> difference;
  Pcg random(options.bsdf.statistics.seed, 25);
  for (int i = 0; i < options.samples; ++i) {
    Pcg again = random;
    const Features a = features(rough.sample_next(wo, random), options),
                   b = features(limit.sample_next(wo, again), options);
    for (std::size_t j = 0; j < feature_count; ++j) difference[j].add(a[j] - b[j]);
  }
  for (std::size_t j = 0; j < feature_count; ++j)
    sample.note(excess(difference[j], options.slope * r, options), [&] {
      return fmt::format("mean {} at roughness {:g} differs from the smooth limit by {:.6g} +- {:.2g}, at wo = {}",
                         name_of(j), r, difference[j].mean(), difference[j].std_error(), rough.format(wo));
    });
}

void compare_evals(const AnyBsdf& here, const AnyBsdf& there, double r, double d, const AnyBsdf::Direction& wo,
                   const RoughnessLimitOptions& options, WorstError& eval) {
  std::array<Moments, Channels::max_count> changes;
  Pcg random(options.bsdf.statistics.seed, 26);
  for (int i = 0; i < options.samples / 4; ++i) {
    const auto drawn = here.sample_next(wo, random);
    if (!drawn || drawn->delta || !(drawn->pdf > 0)) continue;
    const Channels f = here.eval(wo, drawn->wi), g = there.eval(wo, drawn->wi);
    for (int c = 0; c < Channels::max_count; ++c)
      changes[static_cast<std::size_t>(c)].add(std::abs(f[c] - g[c]) *
                                               (cosine_factor(drawn->wi, options.bsdf) / drawn->pdf));
  }
  for (const Moments& change : changes)
    eval.note(change.count() > 1 ? excess(change, options.slope * std::abs(d), options) : 0.0, [&] {
      return fmt::format("f changes by {:.4g} of its integral from roughness {:g} to {:g}, at wo = {}", change.mean(),
                         r, r * (1 + d), here.format(wo));
    });
}

} // namespace

Findings roughness_samples_law(const RoughnessFamily& f) {
  WorstError sample("sample tends to its smooth limit", 0, Fault::physics);
  for (int k = 2; k <= 16; k += 2) {
    const double r = std::ldexp(1.0, -k);
    compare_samples(f.family(r), f.limit, r, f.wo, f.options, sample);
  }
  return {{sample.check()}};
}

Findings roughness_evals_law(const RoughnessFamily& f) {
  WorstError eval("eval is continuous in roughness", 0, Fault::physics);
  for (int k = 0; k <= 10; k += 2)
    for (const double d : {-1.0 / 16, -1.0 / 64, -1.0 / 256}) {
      const double r = std::ldexp(1.0, -k);
      compare_evals(f.family(r), f.family(r * (1 + d)), r, d, f.wo, f.options, eval);
    }
  return {{eval.check()}};
}

} // namespace mc

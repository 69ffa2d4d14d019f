#include <mc/check/laws/bsdf/roughness_limit.h>

#include <mc/estimate/moments.h>

namespace mc {
namespace {

double excess(const Moments& m, double allowed, const LimitOptions& options) {
  return m.non_finite() ? HUGE_VAL : std::max(std::abs(m.mean()) - allowed - options.noise - 5 * m.std_error(), 0.0);
}

// weight, weight wi and absorption of one draw.
std::array<double, 5> features(const std::optional<AnyBsdf::Sample>& drawn, const LimitOptions& options) {
  if (!drawn) return {0, 0, 0, 0, 1};
  const double weight = throughput(*drawn, options.bsdf)[0];
  return {weight, weight * drawn->wi.x(), weight * drawn->wi.y(), weight * drawn->wi.z(), 0};
}

void compare_samples(const AnyBsdf& rough, const AnyBsdf& limit, double r, const AnyBsdf::Direction& wo,
                     const LimitOptions& options, WorstError& sample) {
  std::array<Moments, 5> difference;
  Pcg random(options.bsdf.seed, 25);
  for (int i = 0; i < options.samples; ++i) {
    Pcg again = random;
    const auto a = features(rough.sample_next(wo, random), options),
               b = features(limit.sample_next(wo, again), options);
    for (std::size_t j = 0; j < 5; ++j) difference[j].add(a[j] - b[j]);
  }
  for (std::size_t j = 0; j < 5; ++j)
    sample.note(excess(difference[j], options.slope * r, options), [&] {
      constexpr std::array<const char*, 5> names{"weight", "weight x", "weight y", "weight z", "share absorbed"};
      return fmt::format("mean {} at roughness {:g} is {:.6g} +- {:.2g} off that of the limit, wo = {}", names[j], r,
                         difference[j].mean(), difference[j].std_error(), rough.format(wo));
    });
}

void compare_evals(const AnyBsdf& here, const AnyBsdf& there, double r, double d, const AnyBsdf::Direction& wo,
                   const LimitOptions& options, WorstError& eval) {
  Moments change;
  Pcg random(options.bsdf.seed, 26);
  for (int i = 0; i < options.samples / 4; ++i) {
    const auto drawn = here.sample_next(wo, random);
    if (!drawn || drawn->delta || !(drawn->pdf > 0)) continue;
    const double f = here.eval(wo, drawn->wi)[0], g = there.eval(wo, drawn->wi)[0];
    change.add(std::abs(f - g) * (cosine_factor(drawn->wi, options.bsdf) / drawn->pdf));
  }
  eval.note(change.count() > 1 ? excess(change, options.slope * std::abs(d), options) : 0.0, [&] {
    return fmt::format("f changes by {:.4g} of its mass from roughness {:g} to {:g}, wo = {}", change.mean(), r,
                       r * (1 + d), here.format(wo));
  });
}

} // namespace

std::vector<Check> check_limit(const std::function<AnyBsdf(double r)>& family, const AnyBsdf& limit,
                               const AnyBsdf::Direction& wo, const LimitOptions& options) {
  WorstError sample("sample tends to its smooth limit", 0, Fault::physics);
  WorstError eval("eval is continuous in roughness", 0, Fault::physics);
  for (int k = 2; k <= 16; k += 2) {
    const double r = std::ldexp(1.0, -k);
    compare_samples(family(r), limit, r, wo, options, sample);
  }
  for (int k = 0; k <= 10; k += 2)
    for (const double d : {-1.0 / 16, -1.0 / 64, -1.0 / 256}) {
      const double r = std::ldexp(1.0, -k);
      compare_evals(family(r), family(r * (1 + d)), r, d, wo, options, eval);
    }
  return {sample.check(), eval.check()};
}

} // namespace mc

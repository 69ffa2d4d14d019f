#pragma once
/// Whether a family of rough BSDFs tends to its smooth limit.

#include <mc/check/bsdf_laws.h>

namespace mc {

struct LimitOptions {
  BsdfOptions bsdf;
  double slope = 4; ///< what a roughness of r may change: means by slope r, f by slope times the relative change of r
  double noise = 1e-4; ///< rounding error of the means, conceded to them
  int samples = 20'000;
};

/// Continuity in the limits of roughness, at one wo. family(r) is the BSDF of roughness r in (0, 1], `limit` what it is
/// at 0.
///   sample : the means of weight, of weight wi and of the share that is absorbed tend to those of the limit: at r =
///            2^-2, 2^-4 ... 2^-16 they differ by at most slope r + noise + five standard errors; the same random
///            numbers on both sides keep those small
///   eval   : f at r (1 + d) tends to f at r, for r = 1, 1/4 ... 2^-10 and d = -1/16, -1/64, -1/256: the mean of |f' -
///            f| |cos| / pdf over samples of r is at most slope |d| + noise + five standard errors. With mass 1 at
///            every r (check_bsdf) eval then tends to the limit's lobe, since its samples do
template <Real S, class Family, class Limit>
std::vector<Check> check_roughness_limit(const Family& family, const Limit& limit, const Vec3<S>& wo,
                                         const LimitOptions& options = {}) {
  LawLedger sample("sample tends to its smooth limit", 0, Fault::physics),
      eval("eval is continuous in roughness", 0, Fault::physics);
  const auto excess = [&](const Moments& m, double allowed) {
    return m.non_finite() ? HUGE_VAL : std::max(std::abs(m.mean()) - allowed - options.noise - 5 * m.std_error(), 0.0);
  };
  // weight, weight wi and absorption of one draw.
  const auto features = [&](const auto& bsdf, S uc, const Vec2<S>& u) {
    std::array<double, 5> f{};
    const auto drawn = detail::scatter<S>(bsdf, wo, uc, u);
    if (!drawn) return f[4] = 1, f;
    f[0] = detail::throughput(*drawn, options.bsdf)[0];
    for (int i = 0; i < 3; ++i) f[static_cast<std::size_t>(i) + 1] = f[0] * static_cast<double>(drawn->wi[i]);
    return f;
  };
  for (int k = 2; k <= 16; k += 2) {
    const S r = S(std::ldexp(1.0, -k));
    const auto rough = family(r);
    std::array<Moments, 5> difference;
    Pcg random(options.bsdf.seed, 25);
    for (int i = 0; i < options.samples; ++i) {
      const S uc = random.uniform<S>();
      const Vec2<S> u = random.point<S, 2>();
      const auto a = features(rough, uc, u), b = features(limit, uc, u);
      for (std::size_t j = 0; j < 5; ++j) difference[j].add(a[j] - b[j]);
    }
    for (std::size_t j = 0; j < 5; ++j)
      sample.note(excess(difference[j], options.slope * static_cast<double>(r)), [&] {
        constexpr std::array<const char*, 5> names{"weight", "weight x", "weight y", "weight z", "share absorbed"};
        return fmt::format("mean {} at roughness {:g} is {:.6g} +- {:.2g} off that of the limit, wo = {}", names[j],
                           static_cast<double>(r), difference[j].mean(), difference[j].std_error(),
                           detail::format_point(wo));
      });
  }
  for (int k = 0; k <= 10; k += 2)
    for (const double d : {-1.0 / 16, -1.0 / 64, -1.0 / 256}) {
      const double r = std::ldexp(1.0, -k);
      const auto here = family(S(r)), there = family(S(r * (1 + d)));
      Moments change;
      Pcg random(options.bsdf.seed, 26);
      for (int i = 0; i < options.samples / 4; ++i) {
        const auto drawn = detail::scatter<S>(here, wo, random);
        if (!drawn || detail::is_delta(*drawn) || !(drawn->pdf > 0)) continue;
        const auto f = here.eval(wo, drawn->wi), g = there.eval(wo, drawn->wi);
        const double factor =
            static_cast<double>(detail::cosine_factor(drawn->wi, options.bsdf)) / static_cast<double>(drawn->pdf);
        change.add(std::abs(detail::component(f, 0) - detail::component(g, 0)) * factor);
      }
      eval.note(change.count() > 1 ? excess(change, options.slope * std::abs(d)) : 0.0, [&] {
        return fmt::format("f changes by {:.4g} of its mass from roughness {:g} to {:g}, wo = {}", change.mean(), r,
                           r * (1 + d), detail::format_point(wo));
      });
    }
  return {sample.check(), eval.check()};
}

} // namespace mc

#pragma once
/// Any scattering function, its types erased: what the laws of BSDFs run over.

#include <mc/check/subject/point_array.h>
#include <mc/check/subject/timing.h>
#include <mc/random/pcg.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mc {

/// What is known of a BSDF beforehand.
struct BsdfOptions {
  std::string name = "bsdf";
  std::uint64_t samples = 1'000'000;
  std::uint64_t seed = 1;
  double alpha = 0.001;
  bool reciprocal = true;       ///< f(wo, wi) = f(wi, wo); with eta, f(wo, wi) / eta_i^2 symmetric across the surface
  double eta = 1;               ///< index of the inside (z < 0) over that of the outside
  bool cosine = true;           ///< eval leaves the cosine out; false where it holds it, and for phase functions
  bool lossless = false;        ///< nothing is absorbed: the white furnace value is 1, not only at most 1
  double tolerance = 1e-3;      ///< relative, of f and pdf as sample, eval and pdf state them, and of reciprocity
  double mass_tolerance = 1e-5; ///< rounding error of the density's integral
  std::size_t max_evaluations = 12'000'000;
  bool evidence = false;                               ///< see SubjectOptions
  bool open_interval = false;                          ///< u in (0,1): no random number is exactly 0
  const std::function<void()>* before_draws = nullptr; ///< called again and again; what it throws ends the check
};

/// Values of f, a channel each.
struct Channels {
  static constexpr int max_count = 8;
  int count = 0;
  std::array<double, max_count> value; ///< the first `count` mean something

  /// Of channel c; the last one repeats.
  double operator[](int c) const { return value[static_cast<std::size_t>(std::min(c, count - 1))]; }
};

/// A BSDF or phase function in double, whatever it computes in.
struct AnyBsdf {
  using Direction = Vec3<double>;
  struct Sample {
    Direction wi;
    double pdf = 0;
    bool delta = false, transmission = false;
    Channels f, weight; ///< what the sample states; no channels where it does not
  };

  bool is_float = false;
  bool open_interval = false; ///< sample wants numbers in (0,1), none of them 0
  std::function<std::optional<Sample>(const Direction& wo, double uc, const Vec2<double>& u)> sample;
  std::function<Channels(const Direction& wo, const Direction& wi)> eval;
  std::function<double(const Direction& wo, const Direction& wi)> pdf;
  std::function<double(const Direction& wo)> ns_per_sample;

  std::optional<Sample> sample_next(const Direction& wo, Pcg& random) const;
  double epsilon() const;
  std::string format(const Direction& w) const;
  std::string format(const Channels& f) const;
};

namespace detail {
template <class B, class S> constexpr bool samples_directions = requires(const B bsdf, Vec3<S> wo, S uc, Vec2<S> u) {
  bsdf.sample(wo, uc, u);
}
|| requires(const B bsdf, Vec3<S> wo, Vec2<S> u) { bsdf.sample(wo, u); };
template <class B, class S> constexpr bool has_eval = requires(const B bsdf, Vec3<S> wo, Vec3<S> wi) {
  bsdf.eval(wo, wi);
};
template <class B, class S> constexpr bool has_direction_pdf = requires(const B bsdf, Vec3<S> wo, Vec3<S> wi) {
  { bsdf.pdf(wo, wi) } -> std::convertible_to<double>;
};
} // namespace detail

/// What check_bsdf asks of a BSDF over scalar S: sample(wo, uc, u) or sample(wo, u), eval(wo, wi) and pdf(wo, wi).
template <class B, class S>
concept SamplesDirections = detail::samples_directions<B, S>;
template <class B, class S>
concept BsdfOver = detail::samples_directions<B, S> && detail::has_eval<B, S> && detail::has_direction_pdf<B, S>;

namespace detail {

template <class F> Channels channels_of(const F& f) {
  static_assert(point_size<F>() >= 1 && point_size<F>() <= Channels::max_count, "a BSDF has 1 to 8 channels");
  Channels c;
  c.count = components(f);
  for (int i = 0; i < c.count; ++i) c.value[static_cast<std::size_t>(i)] = component(f, i);
  return c;
}

template <Real S, class Bsdf> auto scatter(const Bsdf& bsdf, const Vec3<S>& wo, S uc, const Vec2<S>& u) {
  if constexpr (requires { bsdf.sample(wo, uc, u); }) return bsdf.sample(wo, uc, u);
  else return bsdf.sample(wo, u);
}

template <Real S, class Bsdf> double ns_per_scatter(const Bsdf& bsdf, const Vec3<S>& wo) {
  Pcg random(3);
  std::vector<Vec3<S>> inputs(timing_inputs);
  for (auto& u : inputs) u = random.point<S, 3>();
  return mc::ns_per_sample(inputs, [&](const Vec3<S>& u) {
    const auto drawn = scatter<S>(bsdf, wo, u[0], Vec2<S>(u[1], u[2]));
    return drawn ? static_cast<double>(drawn->wi.x()) : 0.0;
  });
}

} // namespace detail

/// The BSDF is any object with
///   sample(wo, uc, u) or sample(wo, u) -> optional of {wi, pdf, f or weight, perhaps delta and transmission}
///   eval(wo, wi) -> f,  pdf(wo, wi)
/// where weight = f |cos| / pdf. Without eval and pdf it can only be sampled.
template <Real S, SamplesDirections<S> Bsdf> AnyBsdf any_bsdf(const Bsdf& given) {
  const auto bsdf = std::make_shared<const Bsdf>(given);
  AnyBsdf any;
  any.is_float = std::same_as<S, float>;
  const auto to_s = [](const AnyBsdf::Direction& w) { return Vec3<S>(w.cast<S>()); };
  any.sample = [=](const AnyBsdf::Direction& wo, double uc, const Vec2<double>& u) -> std::optional<AnyBsdf::Sample> {
    const auto drawn = detail::scatter<S>(*bsdf, to_s(wo), static_cast<S>(uc), Vec2<S>(u.cast<S>()));
    if (!drawn) return {};
    const auto& d = *drawn;
    AnyBsdf::Sample s;
    s.wi = d.wi.template cast<double>();
    s.pdf = static_cast<double>(d.pdf);
    if constexpr (requires { d.delta; }) s.delta = d.delta;
    if constexpr (requires { d.transmission; }) s.transmission = d.transmission;
    else s.transmission = s.wi.z() * wo.z() < 0;
    if constexpr (requires { d.f; }) s.f = detail::channels_of(d.f);
    if constexpr (requires { d.weight; }) s.weight = detail::channels_of(d.weight);
    return s;
  };
  if constexpr (BsdfOver<Bsdf, S>) {
    any.eval = [=](const AnyBsdf::Direction& wo, const AnyBsdf::Direction& wi) {
      return detail::channels_of(bsdf->eval(to_s(wo), to_s(wi)));
    };
    any.pdf = [=](const AnyBsdf::Direction& wo, const AnyBsdf::Direction& wi) {
      return static_cast<double>(bsdf->pdf(to_s(wo), to_s(wi)));
    };
  }
  any.ns_per_sample = [=](const AnyBsdf::Direction& w) { return detail::ns_per_scatter<S>(*bsdf, to_s(w)); };
  return any;
}

} // namespace mc

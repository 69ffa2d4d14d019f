#pragma once
/// Type-erased scattering functions, the input of the BSDF laws.

#include <mc/check/subject/field_count.h>
#include <mc/check/subject/options.h>
#include <mc/check/subject/point_array.h>
#include <mc/check/subject/timing.h>
#include <mc/random/pcg.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mc {

/// Properties of a BSDF, and options of check_bsdf.
struct BsdfOptions {
  std::string name = "bsdf";      ///< name in the report
  SubjectOptions statistics = {}; ///< samples and alpha of the statistical tests, and the seed of all random numbers
  bool reciprocal = true;  ///< f(wo, wi) = f(wi, wo); across the surface f(wo, wi) / eta_o^2 = f(wi, wo) / eta_i^2
  double eta = 1;          ///< refractive index of the inside (z < 0) divided by that outside
  bool cosine = true;      ///< eval leaves the cosine out; false if it includes the cosine, and for phase functions
  bool lossless = false;   ///< nothing is absorbed: the white furnace albedo is 1, instead of at most 1
  double tolerance = 1e-3; ///< relative error of reciprocity, and of stated f, weight and pdf against eval and pdf
  double mass_tolerance = 1e-5; ///< rounding error of the density's integral
};

/// Values of f, one per channel.
struct Channels {
  static constexpr int max_count = 8;  ///< largest number of channels
  int count = 0;                       ///< number of channels
  std::array<double, max_count> value; ///< only the first `count` entries are defined

  /// Returns the value of channel c; the last channel repeats for larger c.
  double operator[](int c) const { return value[static_cast<std::size_t>(std::min(c, count - 1))]; }
};

/// A BSDF or phase function as functions of double, for any scalar type of the original.
struct AnyBsdf {
  /// A unit vector; +z is the normal.
  using Direction = Vec3<double>;
  /// A sampled direction.
  struct Sample {
    Direction wi;             ///< the sampled direction
    double pdf = 0;           ///< stated density [1/steradian], or probability of the delta lobe
    bool delta = false,       ///< whether wi comes from a delta lobe
        transmission = false; ///< whether wi and wo are on opposite sides
    Channels f,               ///< the stated f; count = 0 if the sample states none
        weight;               ///< the stated weight; count = 0 if the sample states none
  };

  bool is_float = false;      ///< the original computes in float
  bool open_interval = false; ///< sample requires random numbers in (0,1), without 0
  bool states_value = true;   ///< a sample states f or weight
  /// Samples wi for wo; uc selects the lobe. Returns no value if the light is absorbed.
  std::function<std::optional<Sample>(const Direction& wo, double uc, const Vec2<double>& u)> sample;
  /// Returns f(wo, wi).
  std::function<Channels(const Direction& wo, const Direction& wi)> eval;
  /// Returns the density of wi for wo [1/steradian].
  std::function<double(const Direction& wo, const Direction& wi)> pdf;
  /// Measures the time of one sample [ns].
  std::function<double(const Direction& wo)> ns_per_sample;

  /// Samples wi with the next three numbers of `random`, in the precision of the BSDF's scalar.
  std::optional<Sample> sample_next(const Direction& wo, Pcg& random) const;
  /// Returns the machine epsilon of the BSDF's scalar.
  double epsilon() const;
  /// Returns "(0.6, 0, 0.8)" with all digits of the BSDF's scalar.
  std::string format(const Direction& w) const;
  /// Returns the channels with all digits of the BSDF's scalar.
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

/// A type with sample(wo, uc, u) or sample(wo, u), over scalar S.
template <class B, class S>
concept SamplesDirections = detail::samples_directions<B, S>;
/// A BSDF type over scalar S: samples directions, and has eval(wo, wi) and pdf(wo, wi).
template <class B, class S>
concept BsdfOver = detail::samples_directions<B, S> && detail::has_eval<B, S> && detail::has_direction_pdf<B, S>;

namespace detail {

/// Whether the sample of a BSDF states its value: f, or the weight f |cos| / pdf.
template <class Sample> constexpr bool states_value = requires(const Sample d) { d.f; }
|| requires(const Sample d) { d.weight; };
/// Whether the sample of a BSDF has more members than wi, pdf, delta and transmission, but states no value.
template <class Sample> constexpr bool hides_value() {
  const int known = 2 + int(requires(const Sample d) { d.delta; }) + int(requires(const Sample d) { d.transmission; });
  return !states_value<Sample> && field_count<Sample>() > known;
}

template <Real S, class Bsdf> auto scatter(const Bsdf& bsdf, const Vec3<S>& wo, S uc, const Vec2<S>& u) {
  if constexpr (requires { bsdf.sample(wo, uc, u); }) return bsdf.sample(wo, uc, u);
  else return bsdf.sample(wo, u);
}
/// The sample of a BSDF over scalar S.
template <class Bsdf, class S>
using BsdfSampleOf = std::remove_cvref_t<decltype(*scatter<S>(std::declval<const Bsdf&>(), Vec3<S>(), S(), Vec2<S>()))>;
/// Whether no member of the sample is ignored.
template <class Bsdf, class S> constexpr bool checks_members() {
  if constexpr (samples_directions<Bsdf, S>) return !hides_value<BsdfSampleOf<Bsdf, S>>();
  else return true;
}

template <class F> Channels channels_of(const F& f) {
  static_assert(point_size<F>() >= 1 && point_size<F>() <= Channels::max_count, "a BSDF has 1 to 8 channels");
  Channels c;
  c.count = components(f);
  for (int i = 0; i < c.count; ++i) c.value[static_cast<std::size_t>(i)] = component(f, i);
  return c;
}

template <Real S, class Bsdf> double ns_per_scatter(const Bsdf& bsdf, const Vec3<S>& wo) {
  Pcg random(3);
  std::vector<Vec3<S>> inputs(timing_inputs);
  for (auto& u : inputs) u = random.point<S, 3>();
  return mc::ns_per_sample(inputs, [&](const Vec3<S>& u) { return scatter<S>(bsdf, wo, u[0], Vec2<S>(u[1], u[2])); });
}

} // namespace detail

/// Erases the type of a BSDF, any object with
///   sample(wo, uc, u) or sample(wo, u) -> optional of {wi, pdf, f or weight, perhaps delta and transmission}
///   eval(wo, wi) -> f,  pdf(wo, wi)
/// where weight = f |cos| / pdf. A sample with other members, but without f and weight, does not compile. The result
/// lacks eval and pdf if the BSDF lacks them.
template <Real S, SamplesDirections<S> Bsdf> AnyBsdf any_bsdf(const Bsdf& given) {
  using Drawn = detail::BsdfSampleOf<Bsdf, S>;
  const auto bsdf = std::make_shared<const Bsdf>(given);
  AnyBsdf any;
  any.states_value = detail::states_value<Drawn>;
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
    // The energy of a sample without a stated value comes from eval.
    if constexpr (BsdfOver<Bsdf, S> && !detail::states_value<Drawn>)
      if (!s.delta) s.f = detail::channels_of(bsdf->eval(to_s(wo), d.wi));
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

#pragma once
/// The laws of scattering functions.

#include <mc/check/check_subject.h>
#include <mc/check/laws/law_ledger.h>
#include <mc/check/laws/timing.h>
#include <mc/check/subject/make_subject.h>
#include <mc/domain/sphere.h>
#include <mc/estimate/moments.h>
#include <mc/stats/t_test.h>

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
  bool evidence = false; ///< see SubjectOptions
};

namespace detail {

template <Real S, class Bsdf> auto scatter(const Bsdf& bsdf, const Vec3<S>& wo, S uc, const Vec2<S>& u) {
  if constexpr (requires { bsdf.sample(wo, uc, u); }) return bsdf.sample(wo, uc, u);
  else return bsdf.sample(wo, u);
}
template <Real S, class Bsdf> auto scatter(const Bsdf& bsdf, const Vec3<S>& wo, Pcg& random) {
  const S uc = random.uniform<S>();
  return scatter<S>(bsdf, wo, uc, random.point<S, 2>());
}

template <class Drawn> bool is_delta(const Drawn& d) {
  if constexpr (requires { d.delta; }) return d.delta;
  else return false;
}
template <class Drawn, class W> bool is_transmission(const Drawn& d, const W& wo) {
  if constexpr (requires { d.transmission; }) return d.transmission;
  else return d.wi.z() * wo.z() < 0;
}
/// |cos wi| where eval leaves it out.
template <class W> auto cosine_factor(const W& wi, const BsdfOptions& options) {
  return options.cosine ? std::abs(wi.z()) : typename W::Scalar(1);
}

/// What one sample stands for: f |cos| / pdf, in doubles, one channel repeated; 0 where pdf = 0.
template <class Drawn> std::array<double, 3> throughput(const Drawn& d, const BsdfOptions& options) {
  std::array<double, 3> t{};
  const auto fill = [&](const auto& x, double factor) {
    for (int c = 0; c < 3; ++c) t[static_cast<std::size_t>(c)] = factor * component(x, std::min(c, components(x) - 1));
  };
  if constexpr (requires { d.weight; }) fill(d.weight, 1);
  else if (d.pdf > 0) fill(d.f, static_cast<double>(cosine_factor(d.wi, options)) / static_cast<double>(d.pdf));
  return t;
}

/// How far a sample's own f, weight and pdf are from eval and pdf.
template <class Bsdf, class W, class Drawn>
double sample_disagreement(const Bsdf& bsdf, const W& wo, const Drawn& d, const BsdfOptions& options) {
  const auto density = bsdf.pdf(wo, d.wi);
  double off = 0;
  if constexpr (requires { d.f; }) off = disagreement(d.f, decltype(d.f)(bsdf.eval(wo, d.wi)));
  if constexpr (requires { d.weight; }) {
    using Value = std::remove_cvref_t<decltype(d.weight)>;
    off = std::max(off,
                   disagreement(Value(d.weight * density), Value(bsdf.eval(wo, d.wi) * cosine_factor(d.wi, options))));
  }
  if constexpr (requires { d.pdf; })
    off = std::max(off, disagreement(static_cast<double>(d.pdf), static_cast<double>(density)));
  return off;
}

} // namespace detail

/// A BSDF over scalar S with fixed wo as a subject on the sphere of wi. The BSDF is any object with
///   sample(wo, uc, u) or sample(wo, u) -> optional of {wi, pdf, f or weight, perhaps delta and transmission}
///   eval(wo, wi) -> f,  pdf(wo, wi)
/// where weight = f |cos| / pdf. Delta lobes, at most one on either side, become discrete outcomes: 0 reflection, 1
/// transmission. A phase function is a BSDF without the cosine.
///   weight : 1 where the f, weight and pdf of a sample agree with eval and pdf, or a delta lobe repeats its
///            probability
template <Real S, class Bsdf>
Subject bsdf_subject(const Bsdf& bsdf, const Vec3<S>& wo, const BsdfOptions& options = {}) {
  Subject s;
  s.name = options.name;
  s.may_fail = true;
  s.weight_tolerance = options.tolerance;
  s.mass_tolerance = options.mass_tolerance;
  s.epsilon = static_cast<double>(std::numeric_limits<S>::epsilon());
  // Probabilities of the delta lobes as the first samples state them.
  std::array<double, 2> lobes{};
  bool continuous = false;
  {
    Pcg random(options.seed, 21);
    for (int i = 0; i < 4096; ++i) {
      const auto drawn = detail::scatter<S>(bsdf, wo, random);
      if (!drawn) continue;
      if (detail::is_delta(*drawn))
        lobes[detail::is_transmission(*drawn, wo) ? 1 : 0] = static_cast<double>(drawn->pdf);
      else continuous = true;
    }
  }
  s.dim = continuous ? 2 : 0;
  s.axes = chart_axes(Sphere<double>{});
  if (lobes[0] > 0 || lobes[1] > 0) s.atoms = {lobes[0], lobes[1]};
  const auto draw_one = [bsdf, wo](Pcg& random) { return detail::scatter<S>(bsdf, wo, random); };
  s.draw = [=](std::uint64_t seed, std::size_t n, std::vector<Subject::Draw>& out) {
    using Kind = Subject::Draw::Kind;
    const Sphere<S> sphere;
    const Sphere<double> chart;
    Pcg random(seed);
    for (std::size_t i = 0; i < n; ++i) {
      Subject::Draw& d = out.emplace_back();
      const auto drawn = draw_one(random);
      if (!drawn) {
        d.kind = Kind::failed;
        continue;
      }
      const double pdf = static_cast<double>(drawn->pdf);
      const auto scattered = detail::throughput(*drawn, options);
      const bool finite = std::all_of(scattered.begin(), scattered.end(), [](double x) { return std::isfinite(x); });
      if (!detail::all_finite(drawn->wi) || !finite) d.kind = Kind::not_finite;
      else if (!sphere.contains(drawn->wi)) d.kind = Kind::outside;
      else if (detail::is_delta(*drawn)) {
        d.kind = Kind::atom;
        d.atom = detail::is_transmission(*drawn, wo) ? 1 : 0;
        d.weight = pdf / lobes[static_cast<std::size_t>(d.atom)];
        d.pdf_positive = pdf > 0 && std::isfinite(pdf);
      } else {
        const double density = static_cast<double>(bsdf.pdf(wo, drawn->wi));
        d.pdf_positive = density > 0 && std::isfinite(density) && pdf > 0 && std::isfinite(pdf);
        d.weight = 1 + detail::sample_disagreement(bsdf, wo, *drawn, options);
        const auto v = chart.to_unit(drawn->wi.template cast<double>());
        d.v = {v[0], v[1], 0};
      }
    }
  };
  s.density = [bsdf, wo](const Subject::Coordinates& v) {
    const Sphere<double> chart;
    return static_cast<double>(bsdf.pdf(wo, Vec3<S>(chart.from_unit({v[0], v[1]}).template cast<S>()))) *
           chart.jacobian({v[0], v[1]});
  };
  s.describe_draw = [=](std::uint64_t seed, std::uint64_t index) {
    Pcg random(seed), before(seed);
    auto drawn = draw_one(random);
    for (std::uint64_t i = 0; i < index; ++i) before = random, drawn = draw_one(random);
    std::string text = fmt::format("{}wo = {}, draw {} of Pcg({})", detail::format_uniforms<S>(before, random),
                                   detail::format_point(wo), index, seed);
    if (!drawn) return text + ": absorbed";
    text += fmt::format(": wi = {}, pdf = {:.9g}", detail::format_point(drawn->wi), static_cast<double>(drawn->pdf));
    if constexpr (requires { drawn->f; }) text += fmt::format(", f = {}", detail::format_point(drawn->f));
    if constexpr (requires { drawn->weight; })
      text += fmt::format(", weight = {}", detail::format_point(drawn->weight));
    if (!detail::is_delta(*drawn))
      text += fmt::format("; eval = {}, pdf() = {:.9g}", detail::format_point(bsdf.eval(wo, drawn->wi)),
                          static_cast<double>(bsdf.pdf(wo, drawn->wi)));
    return text;
  };
  s.describe_point = [](const Subject::Coordinates& v) {
    return "wi = " + detail::format_point(Vec3<float>(Sphere<double>{}.from_unit({v[0], v[1]}).template cast<float>()));
  };
  return s;
}

namespace detail {

/// The squared index of the medium that w runs in, which radiance carries.
template <class W> double squared_index(const W& w, const BsdfOptions& options) {
  return w.z() > 0 ? 1.0 : options.eta * options.eta;
}

/// The white furnace: the share of light from everywhere that leaves along wo, the mean of f |cos| / pdf, per channel.
template <Real S, class Bsdf>
std::array<Moments, 3> white_furnace(const Bsdf& bsdf, const Vec3<S>& wo, int n, std::uint64_t seed,
                                     const BsdfOptions& options) {
  std::array<Moments, 3> albedo;
  Pcg random(seed, 22);
  for (int i = 0; i < n; ++i) {
    const auto drawn = scatter<S>(bsdf, wo, random);
    std::array<double, 3> share{};
    if (drawn) {
      share = throughput(*drawn, options);
      if (is_transmission(*drawn, wo))
        for (double& x : share) x *= squared_index(drawn->wi, options) / squared_index(wo, options);
    }
    for (std::size_t c = 0; c < 3; ++c) albedo[c].add(share[c]);
  }
  return albedo;
}

/// Energy at wo; keeps the greatest channel's figure.
inline Figure energy_law(const std::array<Moments, 3>& albedo, const std::string& where, const BsdfOptions& options,
                         LawLedger& ledger) {
  Figure greatest{"white furnace", -1, 0, where};
  for (const Moments& m : albedo) {
    const double slack = 5 * m.std_error() + options.tolerance, mean = m.non_finite() ? HUGE_VAL : m.mean();
    if (mean > greatest.value) greatest.value = mean, greatest.std_error = m.std_error();
    const double off = options.lossless ? std::abs(mean - 1) - slack : mean - 1 - slack;
    ledger.note(std::max(off, 0.0),
                [&] { return fmt::format("white furnace {:.6g} +- {:.2g} at wo = {}", mean, m.std_error(), where); });
  }
  return greatest;
}

/// The same light through a delta lobe both ways: shares of the energy, so that refraction needs no further factor.
template <Real S, class Bsdf>
void delta_reciprocity(const Bsdf& bsdf, const Vec3<S>& wo, std::uint64_t seed, const BsdfOptions& options,
                       LawLedger& ledger) {
  Pcg random(seed, 23);
  std::array<bool, 2> done{};
  for (int i = 0; i < 256; ++i) {
    const auto there = scatter<S>(bsdf, wo, random);
    if (!there || !is_delta(*there)) continue;
    const bool through = is_transmission(*there, wo);
    if (std::exchange(done[through ? 1 : 0], true)) continue;
    const auto share = [&](const auto& d, const Vec3<S>& from) {
      const double scale = through ? squared_index(d.wi, options) / squared_index(from, options) : 1;
      return scale * static_cast<double>(d.pdf) * throughput(d, options)[0];
    };
    const double forth = share(*there, wo);
    std::optional<double> back;
    for (int k = 0; k < 1024 && !back; ++k) {
      const auto d = scatter<S>(bsdf, there->wi, random);
      if (d && is_delta(*d) && is_transmission(*d, there->wi) == through && static_cast<double>(d->wi.dot(wo)) > 0.999)
        back = share(*d, there->wi);
    }
    if (!back && forth < 0.05) continue; // too rare to meet
    ledger.note(std::abs(forth - back.value_or(HUGE_VAL)), [&] {
      return fmt::format("delta lobe: share {:.6g} from wo = {} to wi = {}, {} back", forth, format_point(wo),
                         format_point(there->wi), back ? fmt::format("{:.6g}", *back) : "none");
    });
  }
}

} // namespace detail

/// Everything check_subject finds for one wo, and the physics:
///   sign        : f finite and >= 0, for sampled wi and for uniform ones
///   support     : pdf > 0 wherever f > 0 at uniform wi, or the estimator would miss light
///   reciprocity : f(wo, wi) = f(wi, wo), with the squared index across the surface; delta lobes by their shares of the
///                 energy
///   energy      : at most 1 (exactly 1 where lossless) in every channel, at wo and at 16 more directions a side,
///                 one-sided at five standard errors; the white furnace values are figures of the report
/// Directions on the other side than wo are only looked from where samples cross the surface: a BSDF of one side may be
/// undefined there.
template <Real S, class Bsdf> Report check_bsdf(const Bsdf& bsdf, const Vec3<S>& wo, const BsdfOptions& options = {}) {
  SubjectOptions o;
  o.samples = options.samples, o.seed = options.seed, o.alpha = options.alpha,
  o.max_evaluations = options.max_evaluations, o.evidence = options.evidence;
  const auto start = std::chrono::steady_clock::now();
  Report report = check_subject(bsdf_subject<S>(bsdf, wo, options), o);

  LawLedger sign("f finite and >= 0", 0, Fault::physics), reciprocity("reciprocity", options.tolerance, Fault::physics);
  LawLedger support("pdf > 0 where f > 0", 0, Fault::weight), energy("energy <= 1", 0, Fault::physics);
  bool through = false; // light crosses the surface, so directions on its other side mean something
  const auto pair = [&](const Vec3<S>& wi) {
    const bool across = wo.z() * wi.z() < 0, both_ways = options.reciprocal && (through || !across);
    const auto there = bsdf.eval(wo, wi);
    auto back = there;
    if (both_ways) back = bsdf.eval(wi, wo);
    double negative = 0, scale = 1, greatest = 0;
    if (across) scale = detail::squared_index(wi, options) / detail::squared_index(wo, options);
    for (int c = 0; c < detail::components(there); ++c) {
      const double f = detail::component(there, c);
      if (!(f >= 0 && std::isfinite(f))) negative = 1;
      greatest = std::max(greatest, f);
    }
    const auto describe = [&] {
      return fmt::format("f(wo, wi) = {}, f(wi, wo) = {}, pdf = {:.9g}, wo = {}, wi = {}", detail::format_point(there),
                         detail::format_point(back), static_cast<double>(bsdf.pdf(wo, wi)), detail::format_point(wo),
                         detail::format_point(wi));
    };
    sign.note(negative, describe);
    support.note(greatest > 0 && !(bsdf.pdf(wo, wi) > 0) ? 1 : 0, describe);
    using Value = std::remove_cvref_t<decltype(there)>;
    if (both_ways) reciprocity.note(detail::disagreement(Value(there * static_cast<S>(scale)), back), describe);
  };
  Pcg random(options.seed, 24);
  const int n = static_cast<int>(std::min<std::uint64_t>(options.samples, 100'000));
  for (int i = 0; i < n / 5; ++i) {
    const auto drawn = detail::scatter<S>(bsdf, wo, random);
    if (drawn && wo.z() * drawn->wi.z() < 0) through = true;
    if (drawn && !detail::is_delta(*drawn)) pair(drawn->wi);
    if (i % 4 == 0) {
      const Vec2<S> u = random.point<S, 2>();
      const S z = 1 - 2 * u[0];
      pair(spherical_direction<S>(2 * safe_sqrt<S>(u[0] * (1 - u[0])), z, 2 * pi<S> * u[1]));
    }
  }
  if (options.reciprocal) detail::delta_reciprocity<S>(bsdf, wo, options.seed, options, reciprocity);

  report.figures.push_back(detail::energy_law(detail::white_furnace<S>(bsdf, wo, n, options.seed, options),
                                              detail::format_point(wo), options, energy));
  Figure most{"white furnace, greatest over wo", -1, 0, {}};
  for (int k = 0; k < 32; ++k) {
    constexpr std::array<double, 8> cosines{1, 0.9, 0.7, 0.5, 0.3, 0.1, 0.03, 0.003};
    if (k % 2 && !through) continue;
    const double z = (k % 2 ? -1 : 1) * (wo.z() < 0 ? -1 : 1) * cosines[static_cast<std::size_t>(k / 2 % 8)],
                 phi = k < 16 ? 0.4 : 2.3;
    const Vec3<S> w = spherical_direction<double>(std::sqrt(1 - z * z), z, phi).template cast<S>();
    Figure f = detail::energy_law(
        detail::white_furnace<S>(bsdf, w, 1000, options.seed + static_cast<std::uint64_t>(k) + 1, options),
        detail::format_point(w), options, energy);
    if (f.value > most.value) most.value = f.value, most.std_error = f.std_error, most.where = f.where;
  }
  report.figures.push_back(std::move(most));
  for (const LawLedger* law : {&sign, &support, &reciprocity, &energy})
    if (law != &reciprocity || options.reciprocal) report.checks.push_back(law->check());

  struct Input {
    S uc;
    Vec2<S> u;
  };
  std::vector<Input> inputs;
  for (int i = 0; i < timing_inputs; ++i) {
    const S uc = random.uniform<S>();
    inputs.push_back({uc, random.point<S, 2>()});
  }
  report.ns_per_sample = ns_per_sample(inputs, [&](const Input& in) {
    const auto drawn = detail::scatter<S>(bsdf, wo, in.uc, in.u);
    return drawn ? static_cast<double>(drawn->wi.x()) : 0.0;
  });
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

} // namespace mc

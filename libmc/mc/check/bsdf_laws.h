#pragma once
/// The laws of scattering functions.

#include <mc/check/check_subject.h>
#include <mc/check/law_ledger.h>
#include <mc/check/make_subject.h>
#include <mc/check/t_test.h>
#include <mc/check/timing.h>
#include <mc/domain/sphere.h>

namespace mc {

/// What is known of a BSDF beforehand.
struct BsdfOptions {
  std::string name = "bsdf";
  std::uint64_t samples = 1'000'000;
  std::uint64_t seed = 1;
  double alpha = 0.001;
  bool reciprocal = true;         ///< f(wo, wi) = f(wi, wo); with eta, f(wo, wi) / eta_i^2 symmetric across the surface
  double eta = 1;                 ///< index of the inside (z < 0) over that of the outside
  double tolerance = 1e-3;        ///< relative, of f and pdf as sample, eval and pdf state them, and of reciprocity
  double mass_tolerance = 1e-5;   ///< rounding error of the density's integral
  std::size_t max_evaluations = 12'000'000;
  bool evidence = false;          ///< see SubjectOptions
};

namespace detail {

/// The largest |a / b - 1| over the channels, 0 where both are 0.
template <class F> double disagreement(const F& a, const F& b) {
  double worst = 0;
  for (int i = 0; i < a.size(); ++i) {
    const double x = static_cast<double>(a[i]), y = static_cast<double>(b[i]);
    const double off = x == y ? 0.0 : y != 0 ? std::abs(x / y - 1) : HUGE_VAL;
    worst = off <= worst ? worst : off;
  }
  return worst;
}

} // namespace detail

/// A BSDF over scalar S with fixed wo as a subject on the sphere of wi. The BSDF is any object with
///   sample(wo, uc, u) -> optional of {wi, f, pdf, delta, transmission},  eval(wo, wi) -> f,  pdf(wo, wi)
/// whose delta lobes, at most one on either side, become discrete outcomes: 0 reflection, 1 transmission.
///   weight : 1 where the f and pdf of a sample agree with eval and pdf, or a delta lobe repeats its probability
template <Real S, class Bsdf> Subject bsdf_subject(const Bsdf& bsdf, const Vec3<S>& wo, const BsdfOptions& options = {}) {
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
      const S uc = random.uniform<S>();
      const auto drawn = bsdf.sample(wo, uc, random.point<S, 2>());
      if (!drawn) continue;
      if (drawn->delta) lobes[drawn->transmission ? 1 : 0] = static_cast<double>(drawn->pdf);
      else continuous = true;
    }
  }
  s.dim = continuous ? 2 : 0;
  s.axes = chart_axes(Sphere<double>{});
  if (lobes[0] > 0 || lobes[1] > 0) s.atoms = {lobes[0], lobes[1]};
  const auto draw_one = [bsdf, wo](Pcg& random) {
    const S uc = random.uniform<S>();
    return bsdf.sample(wo, uc, random.point<S, 2>());
  };
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
      if (!detail::all_finite(drawn->wi) || !detail::all_finite(drawn->f)) d.kind = Kind::not_finite;
      else if (!sphere.contains(drawn->wi)) d.kind = Kind::outside;
      else if (drawn->delta) {
        d.kind = Kind::atom;
        d.atom = drawn->transmission ? 1 : 0;
        d.weight = pdf / lobes[drawn->transmission ? 1 : 0];
        d.pdf_positive = pdf > 0 && std::isfinite(pdf);
      } else {
        const double density = static_cast<double>(bsdf.pdf(wo, drawn->wi));
        d.pdf_positive = density > 0 && std::isfinite(density) && pdf > 0 && std::isfinite(pdf);
        const double off = std::max(detail::disagreement(drawn->f, decltype(drawn->f)(bsdf.eval(wo, drawn->wi))), std::abs(pdf / density - 1));
        d.weight = 1 + off;
        const auto v = chart.to_unit(drawn->wi.template cast<double>());
        d.v = {v[0], v[1], 0};
      }
    }
  };
  s.density = [bsdf, wo](const Subject::Coordinates& v) {
    const Sphere<double> chart;
    return static_cast<double>(bsdf.pdf(wo, Vec3<S>(chart.from_unit({v[0], v[1]}).template cast<S>()))) * chart.jacobian({v[0], v[1]});
  };
  s.describe_draw = [=](std::uint64_t seed, std::uint64_t index) {
    Pcg random(seed);
    auto drawn = draw_one(random);
    for (std::uint64_t i = 0; i < index; ++i) drawn = draw_one(random);
    std::string text = fmt::format("wo = {}, draw {} of Pcg({})", detail::format_point(wo), index, seed);
    if (!drawn) return text + ": absorbed";
    text += fmt::format(": wi = {}, f = {}, pdf = {:.9g}", detail::format_point(drawn->wi), detail::format_point(drawn->f), static_cast<double>(drawn->pdf));
    if (!drawn->delta)
      text += fmt::format("; eval = {}, pdf() = {:.9g}", detail::format_point(decltype(drawn->f)(bsdf.eval(wo, drawn->wi))), static_cast<double>(bsdf.pdf(wo, drawn->wi)));
    return text;
  };
  s.describe_point = [](const Subject::Coordinates& v) {
    return "wi = " + detail::format_point(Vec3<float>(Sphere<double>{}.from_unit({v[0], v[1]}).template cast<float>()));
  };
  return s;
}

/// Everything check_subject finds for one wo, and the physics: f finite and >= 0, reciprocity, energy (mean of f |cos| / pdf,
/// the directional albedo, at most 1 in every channel; tested one-sided at five standard errors).
template <Real S, class Bsdf> Report check_bsdf(const Bsdf& bsdf, const Vec3<S>& wo, const BsdfOptions& options = {}) {
  SubjectOptions o;
  o.samples = options.samples, o.seed = options.seed, o.alpha = options.alpha, o.max_evaluations = options.max_evaluations, o.evidence = options.evidence;
  const auto start = std::chrono::steady_clock::now();
  Report report = check_subject(bsdf_subject<S>(bsdf, wo, options), o);

  LawLedger sign("f finite and >= 0", 0, Fault::physics), reciprocity("reciprocity", options.tolerance, Fault::physics);
  std::array<Moments, 3> albedo;
  Pcg random(options.seed, 22);
  const int n = static_cast<int>(std::min<std::uint64_t>(options.samples, 100'000));
  const auto index2 = [&](const Vec3<S>& w) { return w.z() > 0 ? 1.0 : options.eta * options.eta; };
  for (int i = 0; i < n; ++i) {
    const S uc = random.uniform<S>();
    const auto drawn = bsdf.sample(wo, uc, random.point<S, 2>());
    // Radiance carries the squared index of its medium.
    const double scale = drawn && drawn->transmission ? index2(drawn->wi) / index2(wo) : 1.0;
    double least = 0;
    for (int c = 0; c < 3; ++c) {
      const double f = drawn ? static_cast<double>(drawn->f[c]) : 0.0;
      if (!(f >= 0 && std::isfinite(f))) least = 1;
      albedo[static_cast<std::size_t>(c)].add(drawn ? scale * f * std::abs(static_cast<double>(drawn->wi.z())) / static_cast<double>(drawn->pdf) : 0.0);
    }
    sign.note(least, [&] { return fmt::format("wo = {}, wi = {}, f = {}", detail::format_point(wo), detail::format_point(drawn->wi), detail::format_point(drawn->f)); });
    if (!options.reciprocal || !drawn || drawn->delta || i >= 20000) continue;
    auto there = decltype(drawn->f)(bsdf.eval(wo, drawn->wi)), back = decltype(drawn->f)(bsdf.eval(drawn->wi, wo));
    there *= static_cast<S>(scale);
    const double off = detail::disagreement(there, back);
    reciprocity.note(off, [&] { return fmt::format("f(wo, wi) = {}, f(wi, wo) = {}, wo = {}, wi = {}", detail::format_point(there), detail::format_point(back), detail::format_point(wo), detail::format_point(drawn->wi)); });
  }
  LawLedger energy("energy <= 1", 1, Fault::physics);
  for (const Moments& m : albedo) {
    const double mean = m.non_finite() ? HUGE_VAL : m.mean() - 5 * m.std_error() - options.tolerance;
    energy.note(mean, [&] { return fmt::format("directional albedo {:.6g} +- {:.2g} at wo = {}", m.mean(), m.std_error(), detail::format_point(wo)); });
  }
  for (const LawLedger* law : {&sign, &reciprocity, &energy})
    if (law != &reciprocity || options.reciprocal) report.checks.push_back(law->check());

  struct Input { S uc; Vec2<S> u; };
  std::vector<Input> inputs;
  for (int i = 0; i < timing_inputs; ++i) {
    const S uc = random.uniform<S>();
    inputs.push_back({uc, random.point<S, 2>()});
  }
  report.ns_per_sample = ns_per_sample(inputs, [&](const Input& in) {
    const auto drawn = bsdf.sample(wo, in.uc, in.u);
    return drawn ? static_cast<double>(drawn->wi.x()) : 0.0;
  });
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

} // namespace mc

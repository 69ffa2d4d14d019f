#include <mc/check/bsdf_laws.h>

#include <mc/check/laws/law.h>

#include <chrono>

namespace mc {

// Each law is one file of laws/bsdf and one row here.
BsdfLaw bsdf_sign_law, bsdf_support_law, bsdf_reciprocity_law, bsdf_delta_reciprocity_law, bsdf_energy_law;
constexpr BsdfLaw* laws[] = {bsdf_sign_law, bsdf_support_law, bsdf_reciprocity_law, bsdf_delta_reciprocity_law,
                             bsdf_energy_law};

namespace {

DirectionPair pair_of(const BsdfView& view, const AnyBsdf::Direction& wi) {
  DirectionPair p;
  p.wi = wi;
  p.transmitted = view.wo.z() * wi.z() < 0;
  p.has_reverse = view.options.reciprocal && (view.transmissive || !p.transmitted);
  p.f = view.bsdf.eval(view.wo, wi);
  p.f_reverse = p.has_reverse ? view.bsdf.eval(wi, view.wo) : p.f;
  p.pdf = view.bsdf.pdf(view.wo, wi);
  return p;
}

// Evaluates the BSDF at sampled directions and at uniform directions. There is one sampled direction per five requested
// samples, at most 20000, and one uniform direction per four sampled directions.
BsdfView view_from(const AnyBsdf& bsdf, const AnyBsdf::Direction& wo, const BsdfOptions& options) {
  BsdfView view{bsdf, wo, options, {}, false};
  Pcg random(options.seed, 24);
  const auto next = [&] { return bsdf.is_float ? double(random.uniform<float>()) : random.uniform<double>(); };
  const int n = static_cast<int>(std::min<std::uint64_t>(options.samples, 100'000) / 5);
  for (int i = 0; i < n; ++i) {
    const auto drawn = bsdf.sample_next(wo, random);
    if (drawn && wo.z() * drawn->wi.z() < 0) view.transmissive = true;
    if (drawn && !drawn->delta) view.pairs.push_back(pair_of(view, drawn->wi));
    if (i % 4 != 0) continue;
    const double u0 = next(), u1 = next();
    view.pairs.push_back(pair_of(
        view, spherical_direction<double>(2 * safe_sqrt<double>(u0 * (1 - u0)), 1 - 2 * u0, 2 * pi<double> * u1)));
  }
  return view;
}

} // namespace

Subject bsdf_subject(const AnyBsdf& bsdf, const Vec3<double>& wo, const BsdfOptions& options) {
  Subject s = make_subject(bsdf_distribution(bsdf, wo, options));
  s.resolution = {}; // the effect of rounding on wi depends on the lobe, not on the position alone
  return s;
}

Report check_bsdf(const AnyBsdf& given, const Vec3<double>& wo, const BsdfOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  AnyBsdf bsdf = given;
  bsdf.open_interval = bsdf.open_interval || options.open_interval;
  Report report = check_subject(bsdf_subject(bsdf, wo, options), statistics(options));
  for (Check& check : determinism_law(bsdf_distribution(bsdf, wo, options), {.seed = options.seed}))
    report.checks.push_back(std::move(check));
  const BsdfView view = view_from(bsdf, wo, options);
  for (BsdfLaw* law : laws) {
    BsdfFindings found = law(view);
    report.checks.insert(report.checks.end(), found.checks.begin(), found.checks.end());
    report.figures.insert(report.figures.end(), found.figures.begin(), found.figures.end());
  }
  if (!bsdf.states_value)
    report.untried.push_back({"weight = f |cos wi| / pdf", "a sample states neither f nor weight"});
  if (!options.reciprocal) report.untried.push_back({"reciprocity", "reciprocal = false"});
  report.ns_per_sample = bsdf.ns_per_sample(wo);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

} // namespace mc

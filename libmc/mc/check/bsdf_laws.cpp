#include <mc/check/bsdf_laws.h>

#include <mc/check/table.h>

#include <chrono>

namespace mc {

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
BsdfView view_from(const AnyBsdf& bsdf, const AnyBsdf::Direction& wo, const BsdfOptions& options,
                   AnyDistribution distribution) {
  BsdfView view{bsdf, wo, options, std::move(distribution), {}, false};
  Pcg random(options.statistics.seed, 24);
  const auto next = [&] { return bsdf.is_float ? double(random.uniform<float>()) : random.uniform<double>(); };
  const int n = static_cast<int>(std::min<std::uint64_t>(options.statistics.samples, 100'000) / 5);
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

// The effect of rounding on wi depends on the lobe, not on the position alone.
Subject without_resolution(Subject s) {
  s.resolution = {};
  return s;
}

} // namespace

Subject bsdf_subject(const AnyBsdf& bsdf, const Vec3<double>& wo, const BsdfOptions& options) {
  return without_resolution(make_subject(bsdf_distribution(bsdf, wo, options)));
}

Report check_bsdf(const AnyBsdf& given, const Vec3<double>& wo, const BsdfOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  AnyBsdf bsdf = given;
  bsdf.open_interval = bsdf.open_interval || options.statistics.open_interval;
  const AnyDistribution distribution = bsdf_distribution(bsdf, wo, options);
  Report report = check_subject(without_resolution(make_subject(distribution)), options.statistics);
  if (!bsdf.states_value)
    report.untried.push_back({"weight = f |cos wi| / pdf", "a sample states neither f nor weight"});
  run_laws(bsdf_laws(), report, view_from(bsdf, wo, options, distribution));
  report.ns_per_sample = bsdf.ns_per_sample(wo);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::vector<Check> check_limit(const std::function<AnyBsdf(double r)>& family, const AnyBsdf& limit,
                               const AnyBsdf::Direction& wo, const RoughnessLimitOptions& options) {
  require_unit(wo);
  Report report;
  run_laws(roughness_laws(), report, {family, limit, wo, options});
  return report.checks;
}

} // namespace mc

#include <mc/check/laws/bsdf/bsdf_law.h>

#include <mc/check/subject/make_distribution.h>
#include <mc/core/error.h>
#include <mc/domain/sphere.h>

namespace mc {

double relative_difference(double a, double b) {
  if (a == b) return 0;
  return b != 0 ? std::abs(a / b - 1) : HUGE_VAL;
}

double relative_difference(const Channels& a, const Channels& b) {
  double worst = 0;
  for (int c = 0; c < std::max(a.count, b.count); ++c) {
    const double off = relative_difference(a[c], b[c]);
    worst = off <= worst ? worst : off;
  }
  return worst;
}

Channels scaled(Channels f, double factor) {
  for (int c = 0; c < f.count; ++c) f.value[static_cast<std::size_t>(c)] *= factor;
  return f;
}

double cosine_factor(const AnyBsdf::Direction& wi, const BsdfOptions& options) {
  return options.cosine ? std::abs(wi.z()) : 1.0;
}

Channels throughput(const AnyBsdf::Sample& d, const BsdfOptions& options) {
  if (d.weight.count > 0) return d.weight;
  if (d.pdf > 0 && d.f.count > 0) return scaled(d.f, cosine_factor(d.wi, options) / d.pdf);
  return {1, {}};
}

double squared_index(const AnyBsdf::Direction& w, const BsdfOptions& options) {
  return w.z() > 0 ? 1.0 : options.eta * options.eta;
}

std::string describe(const BsdfView& view, const DirectionPair& pair) {
  return fmt::format("wo = {}, wi = {}", describe_direction(view.bsdf, view.wo),
                     describe_direction(view.bsdf, pair.wi));
}

std::string describe_direction(const AnyBsdf& bsdf, const AnyBsdf::Direction& w) {
  const double degrees = 180 / pi<double>;
  const double theta = degrees * std::atan2(std::hypot(w.x(), w.y()), w.z());
  double phi = degrees * std::atan2(w.y(), w.x());
  if (phi < 0) phi += 360;
  return fmt::format("{} [theta {:.4g} deg, phi {:.4g} deg]", bsdf.format(w), theta, phi);
}

namespace {

using Direction = AnyBsdf::Direction;

// Returns the channel with the largest difference.
int worst_channel(const Channels& a, const Channels& b) {
  int worst = 0;
  for (int c = 1; c < std::max(a.count, b.count); ++c)
    if (relative_difference(a[c], b[c]) > relative_difference(a[worst], b[worst])) worst = c;
  return worst;
}

// The largest difference between the stated f, weight and pdf of a sample and eval and pdf.
struct SampleDifference {
  double off = 0;
  AnyDistribution::Stated stated;

  void add(double difference, const char* name, double value, double expected) {
    if (difference > off) stated = {name, value, expected, ""};
    off = std::max(off, difference);
  }
};

const char* cosine_hint(const Channels& stated, const Channels& f, const AnyBsdf::Direction& wi,
                        const BsdfOptions& options) {
  const Channels other = options.cosine ? f : scaled(f, std::abs(wi.z()));
  if (!(relative_difference(stated, other) <= options.tolerance)) return "";
  return options.cosine ? "weight = f / pdf holds without the cosine, so eval seems to include it: set .cosine = false"
                        : "weight = f |cos wi| / pdf holds, so eval seems to leave the cosine out: set .cosine = true";
}

SampleDifference sample_difference(const AnyBsdf& bsdf, const Direction& wo, const AnyBsdf::Sample& d, double density,
                                   const BsdfOptions& options) {
  SampleDifference result{relative_difference(d.pdf, density), {"pdf", d.pdf, density, ""}};
  if (d.f.count == 0 && d.weight.count == 0) return result;
  const Channels f = bsdf.eval(wo, d.wi);
  if (d.f.count > 0) {
    const int c = worst_channel(d.f, f);
    result.add(relative_difference(d.f, f), "f", d.f[c], f[c]);
  }
  if (d.weight.count == 0) return result;
  const Channels given = scaled(d.weight, density), wanted = scaled(f, cosine_factor(d.wi, options));
  const int c = worst_channel(given, wanted);
  const double before = result.off;
  result.add(relative_difference(given, wanted), "weight", d.weight[c], wanted[c] / density);
  if (result.off > before) result.stated.hint = cosine_hint(given, f, d.wi, options);
  return result;
}

// Probabilities of the delta lobes as stated by the first samples, and whether other samples occur.
struct Lobes {
  std::array<double, 2> probability{};
  bool continuous = false;
};
Lobes find_lobes(const AnyBsdf& bsdf, const Direction& wo, const BsdfOptions& options) {
  Lobes lobes;
  Pcg random(options.statistics.seed, 21);
  for (int i = 0; i < 4096; ++i) {
    const auto d = bsdf.sample_next(wo, random);
    if (!d) continue;
    if (d->delta) lobes.probability[d->transmission ? 1 : 0] = d->pdf;
    else lobes.continuous = true;
  }
  return lobes;
}

AnyDistribution::Sample make_sample(const AnyBsdf& bsdf, const AnyDomain& sphere, const Direction& wo,
                                    const AnyBsdf::Sample& d, const std::array<double, 2>& lobes,
                                    const BsdfOptions& options) {
  AnyDistribution::Sample drawn;
  drawn.x = {d.wi.x(), d.wi.y(), d.wi.z()};
  const auto scattered = throughput(d, options);
  const bool finite = std::all_of(scattered.value.begin(), scattered.value.begin() + scattered.count,
                                  [](double t) { return std::isfinite(t); });
  if (!finite) drawn.x[0] = std::numeric_limits<double>::quiet_NaN();
  if (!finite || !detail::all_finite(d.wi) || !sphere.contains(drawn.x)) return drawn;
  if (d.delta) {
    drawn.atom = d.transmission ? 1 : 0;
    drawn.pdf = d.pdf;
    const double probability = lobes[static_cast<std::size_t>(drawn.atom)];
    drawn.weight = d.pdf / probability;
    drawn.stated = {"probability of the delta lobe", d.pdf, probability, ""};
    return drawn;
  }
  const double density = bsdf.pdf(wo, d.wi);
  drawn.pdf = d.pdf > 0 && std::isfinite(d.pdf) ? density : 0.0;
  const SampleDifference difference = sample_difference(bsdf, wo, d, density, options);
  drawn.weight = 1 + difference.off;
  drawn.stated = difference.stated;
  return drawn;
}

std::string describe_sample_at(const AnyBsdf& bsdf, const Direction& wo, const AnyDistribution::Uniforms& u) {
  const auto d = bsdf.sample(wo, u[0], {u[1], u[2]});
  std::string text = "wo = " + describe_direction(bsdf, wo);
  if (!d) return text + ", the sample is absorbed";
  text += fmt::format(", wi = {}, sample.pdf = {:.9g}", describe_direction(bsdf, d->wi), d->pdf);
  if (d->f.count > 0) text += ", sample.f = " + bsdf.format(d->f);
  if (d->weight.count > 0) text += ", sample.weight = " + bsdf.format(d->weight);
  if (!d->delta)
    text += fmt::format(", eval = {}, pdf = {:.9g}", bsdf.format(bsdf.eval(wo, d->wi)), bsdf.pdf(wo, d->wi));
  return text;
}

} // namespace

void require_unit(const AnyBsdf::Direction& wo) {
  const double length = wo.norm();
  require(std::abs(length - 1) <= 1e-5,
          "check_bsdf: wo = ({:.9g}, {:.9g}, {:.9g}) has length {:.9g}, should be 1; "
          "normalise it",
          wo.x(), wo.y(), wo.z(), length);
}

AnyDistribution bsdf_distribution(const AnyBsdf& bsdf, const AnyBsdf::Direction& wo, const BsdfOptions& options) {
  require_unit(wo);
  const Lobes lobes = find_lobes(bsdf, wo, options);
  AnyDistribution s = bsdf.is_float ? detail::distribution_on(options.name, Sphere<float>{})
                                    : detail::distribution_on(options.name, Sphere<double>{});
  if (!lobes.continuous) s.domain.dim = 0;
  s.may_fail = true;
  s.open_interval = bsdf.open_interval || options.statistics.open_interval;
  s.states_weight = true;
  s.weight_tolerance = options.tolerance;
  s.mass_tolerance = options.mass_tolerance;
  if (lobes.probability[0] > 0 || lobes.probability[1] > 0) s.atoms = {lobes.probability[0], lobes.probability[1]};
  s.uniforms = 3;
  s.sample = [=, sphere = s.domain](const AnyDistribution::Uniforms& u) -> std::optional<AnyDistribution::Sample> {
    const auto d = bsdf.sample(wo, u[0], {u[1], u[2]});
    if (!d) return {};
    return make_sample(bsdf, sphere, wo, *d, lobes.probability, options);
  };
  s.pdf = [=](const PointArray& x) { return bsdf.pdf(wo, Direction(x[0], x[1], x[2])); };
  s.describe = [=](const AnyDistribution::Uniforms& u) { return describe_sample_at(bsdf, wo, u); };
  return s;
}

} // namespace mc

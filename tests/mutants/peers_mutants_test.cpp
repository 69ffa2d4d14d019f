// Faults that renderers shipped or that their own tests were measured against, each in our own words.
#include "mutants/mutants.h"

namespace mutants {
namespace {

using V = mc::Vec3<double>;
constexpr double pi = std::numbers::pi;
using mc::Fault, mc::Pcg;

V direction(double z, double phi) { return mc::spherical_direction<double>(mc::safe_sqrt<double>((1 - z) * (1 + z)), z, phi); }
V cosine(Pcg& r) { return mc::CosineHemisphere<double>{}.sample(r.point<double, 2>()); }
double cosine_pdf(const V& w) { return w.z() > 0 ? w.z() / pi : 0.0; }

template <class Sampler, class Pdf = double (*)(const V&)>
Mutant on_hemisphere(const char* name, const char* story, Fault fault, Sampler sampler, Pdf pdf = cosine_pdf) {
  return {make_subject(name, mc::Hemisphere<double>{}, sampler, pdf), fault, 1'000'000, story};
}

} // namespace

std::vector<Mutant> peers() {
  std::vector<Mutant> m;
  m.push_back(on_hemisphere("pdf x 1.003", "a normalisation 0.3 % off", Fault::mass, cosine, [](const V& w) { return 1.003 * cosine_pdf(w); }));
  m.push_back(on_hemisphere("5e-6 below the horizon", "five samples in a million where they must not be", Fault::outside, [](Pcg& r) {
    V w = cosine(r);
    if (r.uniform<double>() < 5e-6) w.z() = -w.z();
    return w;
  }));
  m.push_back(on_hemisphere("direction not unit", "x and y 1.1 times too long", Fault::outside, [](Pcg& r) {
    const V w = cosine(r);
    return V(1.1 * w.x(), 1.1 * w.y(), w.z());
  }));
  m.push_back(on_hemisphere("1e-4 NaN", "one sample in ten thousand", Fault::not_finite, [](Pcg& r) {
    V w = cosine(r);
    if (r.uniform<double>() < 1e-4) w.x() = std::numeric_limits<double>::quiet_NaN();
    return w;
  }));
  m.push_back(on_hemisphere("1e-2 uniform", "a hundredth of the samples from the uniform hemisphere", Fault::shape,
                            [](Pcg& r) { return r.uniform<double>() < 1e-2 ? mc::UniformHemisphere<double>{}.sample(r.point<double, 2>()) : cosine(r); }));
  m.push_back(on_hemisphere("1e-2 mirrored", "a hundredth of x < 0 mirrored to x > 0", Fault::shape, [](Pcg& r) {
    V w = cosine(r);
    if (w.x() < 0 && r.uniform<double>() < 1e-2) w.x() = -w.x();
    return w;
  }));
  m.push_back(on_hemisphere("1e-3 spike at the pole", "a thousandth of the samples exactly at the pole", Fault::local,
                            [](Pcg& r) { return r.uniform<double>() < 1e-3 ? V(0, 0, 1) : cosine(r); }));
  m.push_back(on_hemisphere("exponent 1.02", "cos = u^(1.02 / 2)", Fault::shape,
                            [](Pcg& r) { return direction(std::pow(1 - r.uniform<double>(), 0.51), 2 * pi * r.uniform<double>()); }));
  m.push_back(on_hemisphere("u clamped to 1e-3", "both ends of u cut off", Fault::local, [](Pcg& r) {
    mc::Vec2<double> u = r.point<double, 2>();
    for (int i = 0; i < 2; ++i) u[i] = std::clamp(u[i], 1e-3, 1 - 1e-3);
    return direction(std::sqrt(1 - u[0]), 2 * pi * u[1]);
  }));
  // Smoothstep sampled by the inverse of another polynomial (shipped by a renderer that never tested it).
  m.push_back({make_subject("smoothstep inverse", mc::Interval<double>(0, 1),
                            [](Pcg& r) {
                              const double u = r.uniform<double>();
                              return 0.5 - std::sin(std::asin(1 - 2 * u) / 3);
                            },
                            [](double x) { return 2 * x * x * (3 - 2 * x); }),
               Fault::shape, 10'000, "the closed inverse of smoothstep itself, not of its integral"});
  // The last entry of a distribution function left unnormalised: its interval gets what is missing.
  m.push_back({make_subject("unnormalised last CDF entry", mc::Interval<double>(0, 1),
                            [](Pcg& r) {
                              const double u = r.uniform<double>();
                              const double cdf[] = {0, 0.25, 0.5, 0.74, 1.0};
                              const int i = static_cast<int>(std::upper_bound(cdf, cdf + 4, u) - cdf) - 1;
                              return (i + (u - cdf[i]) / (cdf[i + 1] - cdf[i])) / 4;
                            },
                            [](double) { return 1.0; }),
               Fault::shape, 1'000'000, "the third of four equal cells loses 4 % to the last"});
  return m;
}

} // namespace mutants

// The sampling slips of the books and courses, each in our own words.
#include "mutants/mutants.h"

#include <mc/core/frame.h>

namespace mutants {
namespace {

using V = mc::Vec3<double>;
constexpr double pi = std::numbers::pi;
using mc::Fault, mc::Pcg;

V direction(double z, double phi) { return mc::spherical_direction<double>(mc::safe_sqrt<double>((1 - z) * (1 + z)), z, phi); }
V in_ball(Pcg& r) {
  for (;;) {
    const V p(2 * r.uniform<double>() - 1, 2 * r.uniform<double>() - 1, 2 * r.uniform<double>() - 1);
    if (p.squaredNorm() < 1) return p;
  }
}
double cosine_pdf(const V& w) { return w.z() > 0 ? w.z() / pi : 0.0; }

template <class D, class Sampler, class Pdf>
Mutant mutant(const char* name, const char* story, Fault fault, const D& domain, Sampler sampler, Pdf pdf, std::uint64_t samples = 1'000'000) {
  return {make_subject(name, domain, sampler, pdf), fault, samples, story};
}

} // namespace

std::vector<Mutant> books() {
  const mc::Hemisphere<double> hemisphere;
  const mc::Sphere<double> sphere;
  const mc::Disk<double> disk;
  std::vector<Mutant> m;
  m.push_back(mutant("P1 in-ball Lambertian", "normal + a point IN the unit ball follows 2 cos^3 / pi, not cos / pi", Fault::shape, hemisphere,
                     [](Pcg& r) { return V((V::UnitZ() + in_ball(r)).normalized()); }, cosine_pdf, 10'000));
  m.push_back(mutant("P2 twice sqrt r2", "x and y doubled: the direction is not unit", Fault::outside, hemisphere,
                     [](Pcg& r) {
                       const double phi = 2 * pi * r.uniform<double>(), r2 = r.uniform<double>();
                       return V(std::cos(phi) * 2 * std::sqrt(r2), std::sin(phi) * 2 * std::sqrt(r2), std::sqrt(1 - r2));
                     },
                     cosine_pdf, 1000));
  m.push_back(mutant("P2 twice sqrt r2 normalised", "the same, normalised before use, as a renderer does", Fault::shape, hemisphere,
                     [](Pcg& r) {
                       const double phi = 2 * pi * r.uniform<double>(), r2 = r.uniform<double>();
                       return V(V(std::cos(phi) * 2 * std::sqrt(r2), std::sin(phi) * 2 * std::sqrt(r2), std::sqrt(1 - r2)).normalized());
                     },
                     cosine_pdf, 1000));
  m.push_back(mutant("P3 sphere formula on hemisphere", "x and y of the full sphere with z = 1 - r2: not unit", Fault::outside, hemisphere,
                     [](Pcg& r) {
                       const double phi = 2 * pi * r.uniform<double>(), r2 = r.uniform<double>(), s = 2 * std::sqrt(r2 * (1 - r2));
                       return V(std::cos(phi) * s, std::sin(phi) * s, 1 - r2);
                     },
                     [](const V& w) { return w.z() >= 0 ? 1 / (2 * pi) : 0.0; }, 1000));
  m.push_back(mutant("P4 missing factor 2", "x without its factor 2: not unit", Fault::outside, sphere,
                     [](Pcg& r) {
                       const double phi = 2 * pi * r.uniform<double>(), r2 = r.uniform<double>(), s = std::sqrt(r2 * (1 - r2));
                       return V(std::cos(phi) * s, std::sin(phi) * 2 * s, 1 - 2 * r2);
                     },
                     [](const V&) { return 1 / (4 * pi); }, 1000));
  m.push_back(mutant("P5 eight cube root", "the inverse of x^3 / 8 written 8 x^(1/3)", Fault::outside, mc::Interval<double>(0, 2),
                     [](Pcg& r) { return 8 * std::cbrt(r.uniform<double>()); }, [](double x) { return 3 * x * x / 8; }, 1000));
  m.push_back(mutant("P7 default sampler in a mixture", "half the samples from a shape that never defined random(): all along x", Fault::local, sphere,
                     [](Pcg& r) { return r.uniform<double>() < 0.5 ? V(1, 0, 0) : direction(1 - 2 * r.uniform<double>(), 2 * pi * r.uniform<double>()); },
                     [](const V&) { return 1 / (4 * pi); }, 1000));
  m.push_back(mutant("P8 sphere seen from inside", "sqrt(1 - R^2/d^2) of a negative number", Fault::not_finite, sphere,
                     [](Pcg& r) {
                       const double cos_max = std::sqrt(1 - 1.2), z = 1 + r.uniform<double>() * (cos_max - 1);
                       return direction(z, 2 * pi * r.uniform<double>());
                     },
                     [](const V&) { return 1 / (2 * pi * (1 - std::sqrt(1 - 1.2))); }, 1000));
  // A cone of R / d = 1e-3 in float: 1 - cos loses all but three bits.
  m.push_back([&] {
    const float q = 1e-6f, cos_max = std::sqrt(1 - q);
    const auto sampler = [cos_max](Pcg& r) {
      const float z = 1 + r.uniform<float>() * (cos_max - 1), phi = 2 * mc::pi<float> * r.uniform<float>(), s = std::sqrt(1 - z * z);
      return mc::Vec3<float>(s * std::cos(phi), s * std::sin(phi), z);
    };
    const auto pdf = [cos_max, q](const mc::Vec3<float>& w) {
      return mc::one_minus_z(w) <= q / 2 * 1.2f ? 1 / (2 * mc::pi<float> * (1 - cos_max)) : 0.0f;
    };
    return mutant("P9 cone by 1 minus cos", "the solid angle cancels: 7 % wrong at R/d = 1e-3", Fault::mass, mc::Sphere<float>{}, sampler, pdf, 100'000);
  }());
  // A generator that rounds up to 1 once in a thousand instead of once in 2^25: the fault is the same, the wait shorter.
  m.push_back(mutant("P12 u of one", "float(drand48()) can be 1: z = 0 where the pdf is 0", Fault::leak, hemisphere,
                     [](Pcg& r) {
                       const double u = r.uniform<double>(), r2 = u > 0.999 ? 1.0 : u / 0.999;
                       return direction(std::sqrt(1 - r2), 2 * pi * r.uniform<double>());
                     },
                     cosine_pdf, 10'000));
  m.push_back(mutant("P14 fuzzy metal below the surface", "mirror direction + fuzz, traced into the object when it points down", Fault::outside, hemisphere,
                     [](Pcg& r) { return V((direction(std::cos(75 * pi / 180), 0) + in_ball(r)).normalized()); },
                     [](const V&) { return 1 / (2 * pi); }, 1000));
  m.push_back(mutant("P15 lens radius without root", "radius U R crowds the centre of the lens", Fault::shape, disk,
                     [](Pcg& r) {
                       const double radius = r.uniform<double>(), phi = 2 * pi * r.uniform<double>();
                       return mc::Vec2<double>(radius * std::cos(phi), radius * std::sin(phi));
                     },
                     [](const mc::Vec2<double>&) { return 1 / pi; }, 1000));
  // Near -z the fallback frame of a "numerically stable" construction is off by a thousandth: directions are not unit there.
  m.push_back(mutant("P35 frame near minus z", "a fixed frame inside a branch of width 1e-6 is not orthogonal", Fault::outside, sphere,
                     [](Pcg& r) {
                       const V n = V(1.2e-3, 0, -1).normalized(), a(0, -1, 0), b(-1, 0, 0);
                       const V l = mc::CosineHemisphere<double>{}.sample(r.point<double, 2>());
                       return V(a * l.x() + b * l.y() + n * l.z());
                     },
                     [](const V& w) { return std::max(w.dot(V(1.2e-3, 0, -1).normalized()), 0.0) / pi; }, 1000));
  m.push_back(mutant("P36 clamped logarithm", "max(u, 1e-3) puts an atom where the tail was", Fault::local, mc::HalfLine<double>(0, 1),
                     [](Pcg& r) { return -std::log(std::max(r.uniform<double>(), 1e-3)); }, [](double x) { return std::exp(-x); }, 100'000));
  return m;
}

} // namespace mutants

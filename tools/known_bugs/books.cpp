// P1 to P14: the sampling bugs of Ray Tracing: The Rest of Your Life, in its first edition [Shirley16] and in version
// 3.2.3. One of them has no test case:
//   P10 the sentence "a zero radius gives cos = 0, and that works": the cosine is 1 and the density infinite.
#include <known_bugs/test_cases.h>

#include <mc/random/hash.h>
#include <mc/warp/cone.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/sphere.h>

namespace carlo {
namespace {

using V = Direction;
using mc::Fault, mc::Pcg;

double hemisphere_pdf(const V& w) { return w.z() >= 0 ? 1 / (2 * pi) : 0.0; }
double sphere_pdf(const V&) { return 1 / (4 * pi); }
V on_the_sphere(Pcg& r) { return direction(1 - 2 * uniform(r), 2 * pi * uniform(r)); }

SampleDirection around(double radius_xy, double (*z)(double), double (*radius)(double)) {
  return [=](Pcg& r) {
    const double phi = 2 * pi * uniform(r), r2 = uniform(r), s = radius_xy * radius(r2);
    return V(std::cos(phi) * s, std::sin(phi) * s, z(r2));
  };
}

// The doubled cosine lobe of the first edition.
V doubled(Pcg& r) {
  const double phi = 2 * pi * uniform(r), r2 = uniform(r);
  return {std::cos(phi) * 2 * std::sqrt(r2), std::sin(phi) * 2 * std::sqrt(r2), std::sqrt(1 - r2)};
}

// A sphere light of radius 1 at distance d, with the book's formula: solid angle of the cone that encloses it.
double book_solid_angle(double d) { return 2 * pi * (1 - std::sqrt(1 - 1 / (d * d))); }

// A narrow cone in float, sampled through its cosine: 1 - cos keeps three bits at R / d = 1e-3.
TestCase cone_by_cosine() {
  const float q = 1e-6f, cos_max = std::sqrt(1 - q);
  const auto sample = [cos_max](Pcg& r) {
    const float z = 1 + r.uniform<float>() * (cos_max - 1), phi = 2 * mc::pi<float> * r.uniform<float>(),
                s = std::sqrt(1 - z * z);
    return mc::Vec3<float>(s * std::cos(phi), s * std::sin(phi), z);
  };
  const auto pdf = [cos_max, q](const mc::Vec3<float>& w) {
    return mc::one_minus_z(w) <= q / 2 * 1.2f ? 1 / (2 * mc::pi<float> * (1 - cos_max)) : 0.0f;
  };
  return test_case(make_subject("", mc::Sphere<float>{}, sample, pdf));
}

// The mirror direction at 75 degrees plus a point in the unit ball.
V fuzzy(Pcg& r) { return (incident(75) + in_ball(r)).normalized(); }
double fuzzy_pdf(const V& w) {
  const double c = w.dot(incident(75));
  return w.z() > 0 && c > 0 ? 2 * c * c * c / pi : 0.0;
}

// A light that covers the cone cos > 0.8 about the zenith.
constexpr double light_cos = 0.8, light_pdf = 1 / (2 * pi * (1 - light_cos));
V to_light(Pcg& r) { return direction(1 - uniform(r) * (1 - light_cos), 2 * pi * uniform(r)); }

// The light of the ceiling at a point of the floor below a sheet at height 0.3, if hits at t <= 0.001 do not count.
double light_through_occluder(Pcg& r, bool unit) {
  const V d{130 * uniform(r), 105 * uniform(r), 554.0};
  return 0.3 / d.z() * (unit ? d.norm() : 1) > 0.001 ? 0 : 1;
}

void add_one_density(KnownBugs& s) {
  s.push_back({"P1", "in-ball Lambertian", "book, ch. 4; course, ch. 6-7",
               "normal + a point IN the unit ball has density 2 cos^3 / pi, not cos / pi; add a point ON the sphere",
               Fault::shape, 8000,
               test_case(on_hemisphere([](Pcg& r) { return V((V::UnitZ() + in_ball(r)).normalized()); }, cosine_pdf)),
               test_case(on_hemisphere([](Pcg& r) { return V((V::UnitZ() + in_ball(r).normalized()).normalized()); },
                                       cosine_pdf))});
  s.push_back({"P2", "doubled cosine lobe", "book, ch. 5",
               "x and y = 2 sqrt(r2) cos, sin phi: not unit; without the 2 it is", Fault::outside, 1000,
               test_case(on_hemisphere(doubled, cosine_pdf)), test_case(on_hemisphere(cosine, cosine_pdf))});
  s.push_back({"P2n", "doubled cosine lobe, normalised", "book, ch. 5-10",
               "the same direction made unit, as the renderer does: density 4 c / (pi (1 + 3 c^2)^2)", Fault::shape,
               4000, test_case(on_hemisphere([](Pcg& r) { return doubled(r).normalized(); }, cosine_pdf)),
               test_case(on_hemisphere(cosine, cosine_pdf))});
  s.push_back(
      {"P3", "sphere formula on a hemisphere", "book, ch. 5",
       "z = 1 - r2 with the full sphere's x and y; sin = sqrt(r2 (2 - r2))", Fault::outside, 1000,
       test_case(on_hemisphere(around(
                                   2, [](double u) { return 1 - u; }, [](double u) { return std::sqrt(u * (1 - u)); }),
                               hemisphere_pdf)),
       test_case(on_hemisphere(around(
                                   1, [](double u) { return 1 - u; }, [](double u) { return std::sqrt(u * (2 - u)); }),
                               hemisphere_pdf))});
  s.push_back(
      {"P4", "x without its factor 2", "book, ch. 5", "x = cos phi sqrt(r2 (1 - r2)) while y has the 2: not unit",
       Fault::outside, 1000,
       test_case(on_sphere(
           [](Pcg& r) {
             const double phi = 2 * pi * uniform(r), r2 = uniform(r), h = std::sqrt(r2 * (1 - r2));
             return V(std::cos(phi) * h, std::sin(phi) * 2 * h, 1 - 2 * r2);
           },
           sphere_pdf)),
       test_case(on_sphere(around(
                               2, [](double u) { return 1 - 2 * u; }, [](double u) { return std::sqrt(u * (1 - u)); }),
                           sphere_pdf))});
  s.push_back({"P5", "eight cube roots", "book v3.2.3, ch. 3",
               "8 x^(1/3) leaves [0,2]; (8 x)^(1/3) does not. x^2 / pdf is 8/3 for any x and hides it", Fault::outside,
               1000,
               test_case(on_interval(
                   0, 2, [](Pcg& r) { return 8 * std::cbrt(uniform(r)); }, [](double x) { return 3 * x * x / 8; })),
               test_case(on_interval(
                   0, 2, [](Pcg& r) { return std::cbrt(8 * uniform(r)); }, [](double x) { return 3 * x * x / 8; }))});
}

void add_mixtures_and_numbers(KnownBugs& s) {
  s.push_back({"P6", "light-only directions", "book, ch. 7-8",
               "density 0 on the lit walls: what they send is lost; f > 0 needs p > 0", Fault::bias, 1000,
               mean_test_case(1, [](Pcg& r) { return cosine_pdf(to_light(r)) / light_pdf; }),
               mean_test_case(1, [](Pcg& r) {
                 const V w = uniform(r) < 0.5 ? to_light(r) : cosine(r);
                 return cosine_pdf(w) / (0.5 * cosine_pdf(w) + 0.5 * (w.z() > light_cos ? light_pdf : 0));
               })});
  s.push_back({"P7", "default sampler in a mixture", "book, ch. 8",
               "half the samples from a shape that never defined random(): all (1,0,0), density 0; fail loudly",
               Fault::zero_pdf, 1000,
               test_case(on_hemisphere([](Pcg& r) { return uniform(r) < 0.5 ? V(1, 0, 0) : cosine(r); },
                                       [](const V& w) { return 0.5 * cosine_pdf(w) + 0.5 * 0; })),
               test_case(on_hemisphere(
                   [](Pcg& r) { return uniform(r) < 0.5 ? to_light(r) : cosine(r); },
                   [](const V& w) { return 0.5 * cosine_pdf(w) + 0.5 * (w.z() > light_cos ? light_pdf : 0); }))});
  s.push_back({"P8", "sphere light seen from inside", "book, ch. 10",
               "sqrt(1 - R^2/d^2) with d < R is NaN; from inside every direction reaches it", Fault::not_finite, 1000,
               test_case(on_sphere(
                   [](Pcg& r) { return direction(1 + uniform(r) * (std::sqrt(1 - 1.2) - 1), 2 * pi * uniform(r)); },
                   [](const V&) { return 1 / (2 * pi * (1 - std::sqrt(1 - 1.2))); })),
               test_case(on_sphere(on_the_sphere, sphere_pdf))});
  s.push_back({"P9", "cone by 1 - cos", "book, ch. 10",
               "the solid angle cancels: 7 % wrong at R/d = 1e-3 in float; q / (1 + sqrt(1 - q)), q = R^2/d^2",
               Fault::mass, 1000, cone_by_cosine(),
               test_case(make_subject("", mc::UniformCone<float>::from_sin2(1e-6f)))});
  s.push_back({"P11", "ray epsilon that scales", "book, ch. 8-10",
               "t > 0.001 of an unnormalised shadow ray skips an occluder 0.3 above the floor", Fault::bias, 1000,
               mean_test_case(0, [](Pcg& r) { return light_through_occluder(r, false); }),
               mean_test_case(0, [](Pcg& r) { return light_through_occluder(r, true); })});
  s.push_back({"P12", "a random number of 1", "book, float(drand48())",
               "rounds up to 1 once in 2^25 (here once in 1000): z = 0 where the density is 0; keep u < 1",
               Fault::zero_pdf, 20'000,
               test_case(on_hemisphere(
                   [](Pcg& r) {
                     const double u = uniform(r), r2 = u > 0.999 ? 1.0 : u / 0.999;
                     return direction(std::sqrt(1 - r2), 2 * pi * uniform(r));
                   },
                   cosine_pdf)),
               test_case(on_hemisphere([](Pcg& r) { return direction(std::sqrt(1 - uniform(r)), 2 * pi * uniform(r)); },
                                       cosine_pdf))});
  // For distances uniform in [R/2, 3R/2], the mean solid angle is half of 4 pi plus half of the closed form outside.
  const double outside = 0.5 - (std::sqrt(1.25) - std::acos(1 / 1.5));
  s.push_back({"P13", "NaN turned to 0", "book, de_nan",
               "hides P8: the light seen from inside turns black; count what is not finite, and fail", Fault::bias,
               1000,
               mean_test_case(2 * pi * (1 + outside),
                              [](Pcg& r) {
                                const double f = book_solid_angle(0.5 + uniform(r));
                                return std::isfinite(f) ? f : 0.0;
                              }),
               mean_test_case(2 * pi * (1 + outside), [](Pcg& r) {
                 const double d = 0.5 + uniform(r);
                 return d <= 1 ? 4 * pi : book_solid_angle(d);
               })});
  s.push_back({"P14", "fuzzy metal below the surface", "book, ch. 10",
               "mirror direction + fuzz is traced into the object when it points down; absorb it", Fault::outside, 1000,
               test_case(on_hemisphere(fuzzy, fuzzy_pdf)),
               test_case(on_hemisphere(
                   [](Pcg& r) -> std::optional<V> {
                     const V w = fuzzy(r);
                     return w.z() > 0 ? std::optional(w) : std::nullopt;
                   },
                   fuzzy_pdf, Failures::allowed))});
}

} // namespace

void add_shirley(KnownBugs& s) {
  add_one_density(s);
  add_mixtures_and_numbers(s);
}

} // namespace carlo

// P15 to P36: the bugs of the SIGGRAPH 2019 course Introduction to Real-Time Ray Tracing, of smallpt as a lecture
// prints it, of version 4 of the Weekend books, and of the notes on lajolla.
// These have no test case:
//   P16 the pixel's corner instead of its centre without jitter: no random number is drawn.
//   P17 one parameter for focal length and focus distance: a name, not a density.
//   P23 a texel index of 1 past the last: an index, not a density.
//   P28 two arguments evaluated in unspecified order: a matter of the language.
//   P31 fewer than 4 samples per pixel become 0: an option that is not checked.
//   P32 walls of radius 1e5 in float: the precision of an intersection.
#include <known_bugs/test_cases.h>

#include <mc/core/frame.h>
#include <mc/domain/disk.h>
#include <mc/random/hash.h>
#include <mc/warp/disk.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/trowbridge_reitz.h>

namespace carlo {
namespace {

using V = Direction;
using V2 = mc::Vec2<double>;
using F = Eigen::Array3d;
using mc::Fault, mc::Pcg;

double schlick(double f0, double cosine) { return f0 + (1 - f0) * std::pow(1 - cosine, 5); }

// The course's microfacet lobe: half vectors from the GGX distribution, Schlick's Fresnel and masking terms, and a
// diffuse part.
struct CourseGgx {
  double roughness, f0, k; // k in Schlick's masking: n.v / (n.v (1 - k) + k)
  enum class Horizon { ignored, rejected } horizon = Horizon::rejected;
  enum class Diffuse { none, added, layered } diffuse = Diffuse::none;

  double half_pdf(const V& wo, const V& wi) const {
    const V h = (wo + wi).normalized();
    return mc::TrowbridgeReitzNormals<double>(roughness).pdf(h) / (4 * wo.dot(h));
  }
  bool hidden(const V& wo) const { return horizon == Horizon::rejected && !(wo.z() > 0); }
  double pdf(const V& wo, const V& wi) const {
    if (hidden(wo)) return 0;
    if (!(wi.z() > 0)) return horizon == Horizon::ignored && wi.z() < 0 ? half_pdf(wo, wi) : 0;
    return diffuse == Diffuse::none ? half_pdf(wo, wi) : 0.5 * half_pdf(wo, wi) + 0.5 * wi.z() / pi;
  }
  F eval(const V& wo, const V& wi) const {
    const V h = (wo + wi).normalized();
    const double nl = std::max(wi.z(), 0.0), nv = std::max(wo.z(), 0.0); // the course's saturate
    if (hidden(wo) || (horizon == Horizon::rejected && !(nl > 0))) return F::Zero();
    const auto masking = [&](double c) { return c / (c * (1 - k) + k); };
    const double d = mc::TrowbridgeReitzNormals<double>(roughness).pdf(h) / h.z();
    double f = d * masking(nl) * masking(nv) * schlick(f0, wo.dot(h)) / (4 * nl * nv);
    if (diffuse == Diffuse::added) f += 1 / pi;
    if (diffuse == Diffuse::layered) f += (1 - schlick(f0, nl)) * (1 - schlick(f0, nv)) / pi;
    return F::Constant(f);
  }
  std::optional<BsdfFunctions::Sample> sample(const V& wo, double uc, const V2& u) const {
    if (hidden(wo)) return {};
    V wi;
    if (diffuse != Diffuse::none && uc < 0.5) wi = mc::CosineHemisphere<double>{}.sample(u);
    else {
      const V h = mc::TrowbridgeReitzNormals<double>(roughness).sample(u);
      wi = 2 * wo.dot(h) * h - wo;
    }
    if (horizon == Horizon::rejected && !(wi.z() > 0)) return {};
    return BsdfFunctions::Sample{wi.normalized(), eval(wo, wi.normalized()), pdf(wo, wi.normalized())};
  }
};

TestCase bsdf_test_case(const CourseGgx& b, double n_dot_v) {
  return test_case(BsdfFunctions{[b](const V& wo, double uc, const V2& u) { return b.sample(wo, uc, u); },
                                 [b](const V& wo, const V& wi) { return b.eval(wo, wi); },
                                 [b](const V& wo, const V& wi) { return b.pdf(wo, wi); }},
                   std::acos(n_dot_v) * 180 / pi);
}

// Reflection or refraction of light that leaves glass at 40 degrees inside. The sample uses one probability; the stated
// one is the probability of the reversed path.
TestCase leaving_glass(double drawn) {
  mc::Subject s;
  const double sin_in = std::sin(40 * pi / 180), outside = std::sqrt(1 - 1.5 * 1.5 * sin_in * sin_in),
               r = schlick(0.04, outside);
  s.atoms = {r, 1 - r};
  s.draw = [p = drawn < 0 ? r : drawn](std::uint64_t seed, std::size_t n, std::vector<mc::Subject::Draw>& out) {
    Pcg random(seed);
    for (std::size_t i = 0; i < n; ++i)
      out.push_back({.kind = mc::Subject::Draw::Kind::atom, .atom = uniform(random) < p ? 0 : 1});
  };
  return test_case(s);
}

// The error in |n x t| = (n1 / n2) |n x d| for a ray that enters or leaves glass; `sign` multiplies the normal's term.
double snell_error(Pcg& r, double sign) {
  const bool into = uniform(r) < 0.5;
  const double ratio = into ? 1 / 1.5 : 1.5;
  const V d = -cosine(r);
  const double cos2t = 1 - ratio * ratio * (1 - d.z() * d.z());
  if (!(cos2t > 0)) return 0; // total internal reflection
  const V t = (d * ratio - V::UnitZ() * (sign * (d.z() * ratio + std::sqrt(cos2t)))).normalized();
  return std::abs(std::hypot(t.x(), t.y()) - ratio * std::hypot(d.x(), d.y()));
}

// erand48: x -> a x + c modulo 2^48.
double next48(std::uint64_t& x) {
  x = (x * 0x5DEECE66DULL + 0xB) & ((1ULL << 48) - 1);
  return static_cast<double>(x) * 0x1p-48;
}

// The first two random numbers of consecutive image rows.
TestCase rows(bool cubed) {
  mc::Subject s;
  s.dim = 2;
  s.density = [](const mc::Subject::Coordinates&) { return 1.0; };
  s.draw = [cubed](std::uint64_t seed, std::size_t n, std::vector<mc::Subject::Draw>& out) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t row = (seed & 0xffffff) + i;
      std::uint64_t x = cubed ? ((row * row * row) & 0xffff) << 32 : mc::hash(seed, row) >> 16;
      const double u = next48(x), v = next48(x);
      out.push_back({.v = {u, v, 0}});
    }
  };
  return test_case(s);
}

// Four subpixels with four samples each; a sample has radiance 12 with probability 0.03.
double pixel(Pcg& r, double most) {
  double sum = 0;
  for (int sub = 0; sub < 4; ++sub) {
    double mean = 0;
    for (int i = 0; i < 4; ++i) mean += uniform(r) < 0.03 ? 3 : 0;
    sum += std::min(mean, most) / 4;
  }
  return sum;
}

// Light from the cone cos > 0.8 about the normal of a white floor: the reflected radiance is 1 - 0.8^2 = 0.36.
double next_event(Pcg& r) { return cosine_pdf(direction(1 - 0.2 * uniform(r), 2 * pi * uniform(r))) * 2 * pi * 0.2; }
double emitter_hit(Pcg& r) { return cosine(r).z() > 0.8 ? 1 : 0; }

V near_minus_z() { return V(1.2e-3, 0, -1).normalized(); }
Density about(const V& n) {
  return [n](const V& w) { return std::max(w.dot(n), 0.0) / pi; };
}

TestCase rayleigh(SampleNumber sample) {
  return test_case(make_subject("", mc::HalfLine<double>(0, 1), std::move(sample),
                                [](double x) { return x * std::exp(-x * x / 2); }));
}

void add_tutorials(KnownBugs& s) {
  using Horizon = CourseGgx::Horizon;
  using Diffuse = CourseGgx::Diffuse;
  const std::string tutorial = "course, tutorial ";
  s.push_back({"P15", "lens radius without root", tutorial + "8", "radius R u crowds the centre of the lens; R sqrt(u)",
               Fault::shape, 4000,
               test_case(make_subject(
                   "", mc::Disk<double>{},
                   [](Pcg& r) {
                     const double radius = uniform(r), phi = 2 * pi * uniform(r);
                     return V2(radius * std::cos(phi), radius * std::sin(phi));
                   },
                   [](const V2&) { return 1 / pi; })),
               test_case(make_subject("", mc::UniformDisk<double>{}))});
  const auto light = [](Pcg& r) { return std::floor(4 * uniform(r)) + 1; };
  s.push_back({"P18", "one light of four, not times four", tutorial + "12",
               "one of N lights is drawn, the factor N is lost: 2.5 of 10", Fault::bias, 1000,
               mean_test_case(10, light), mean_test_case(10, [light](Pcg& r) { return 4 * light(r); })});
  s.push_back({"P19", "0 / 0 at the horizon", tutorial + "12",
               "n.l / (n.l / pi) with n.l = 0 (here once in 1000); no sample where its density is 0", Fault::not_finite,
               20'000,
               mean_test_case(pi,
                              [](Pcg& r) {
                                const double u = uniform(r), nl = std::sqrt(1 - (u > 0.999 ? 1.0 : u));
                                return nl / (nl / pi);
                              }),
               mean_test_case(pi, [](Pcg& r) {
                 const double nl = std::sqrt(1 - uniform(r));
                 return nl > 0 ? nl / (nl / pi) : 0.0;
               })});
  s.push_back({"P20", "reflections below the horizon", tutorial + "14",
               "masking 0 over 4 n.l = 0: NaN for a fifth of the samples; absorb them", Fault::not_finite, 1000,
               bsdf_test_case({0.5, 0.04, 0.25, Horizon::ignored}, 0.2), bsdf_test_case({0.5, 0.04, 0.25}, 0.2)});
  s.push_back({"P21", "two alphas in one lobe", tutorial + "14",
               "D takes alpha = roughness, G takes roughness^2: a white lobe returns 1.76; one alpha, k = alpha / 2",
               Fault::physics, 8000, bsdf_test_case({0.25, 1, 0.25 * 0.25 / 2}, 0.05),
               bsdf_test_case({0.25, 1, 0.25 / 2}, 0.05)});
  s.push_back({"P22", "diffuse under a coat, unweighted", tutorial + "14",
               "diffuse + specular returns 1.27 of 1; what the coat reflects never reaches the base", Fault::physics,
               8000, bsdf_test_case({0.1, 0.04, 0.05, Horizon::rejected, Diffuse::added}, 0.2),
               bsdf_test_case({0.1, 0.04, 0.05, Horizon::rejected, Diffuse::layered}, 0.2)});
}

void add_chapters_and_lectures(KnownBugs& s) {
  s.push_back({"P24", "glass that eats blue", "course, ch. 8",
               "attenuation (1,1,0), and total reflection returns nothing; lossless glass returns 1", Fault::bias, 1000,
               mean_test_case(1, [](Pcg&) { return 0.0; }), mean_test_case(1, [](Pcg&) { return 1.0; })});
  const double inside = std::cos(40 * pi / 180);
  s.push_back({"P25", "Schlick with n cos", "course, ch. 8",
               "leaving glass, the cosine is n cos > 1: .04 reflected at 40 degrees; the same path back says .245",
               Fault::shape, 1000, leaving_glass(schlick(0.04, 1.5 * inside)), leaving_glass(-1)});
  s.push_back({"P26", "Schlick with the inner cosine", "book v4, dielectric",
               "leaving glass needs the outer cosine, or R in and R out of one path differ", Fault::shape, 1000,
               leaving_glass(schlick(0.04, inside)), leaving_glass(-1)});
  s.push_back({"P27", "refraction with a sign swapped", "lecture, smallpt line 68",
               "(into ? -1 : 1) breaks Snell's law for every ray", Fault::physics, 1000,
               law_test_case("n1 sin = n2 sin", 1e-12, Fault::physics, [](Pcg& r) { return snell_error(r, -1); }),
               law_test_case("n1 sin = n2 sin", 1e-12, Fault::physics, [](Pcg& r) { return snell_error(r, 1); })});
  s.push_back({"P29", "rows that share seeds", "lecture, smallpt line 82",
               "y^3 in 16 bits: row 64 k repeats row 0, all rows lie on one lattice; hash the pixel", Fault::shape,
               4000, rows(true), rows(false)});
  s.push_back({"P30", "clamped before averaging", "lecture, smallpt line 92",
               "subpixel means cut at 1: the bias depends on the samples; clamp the output only", Fault::bias, 20'000,
               mean_test_case(0.36, [](Pcg& r) { return pixel(r, 1); }),
               mean_test_case(0.36, [](Pcg& r) { return pixel(r, HUGE_VAL); })});
  s.push_back({"P33", "light counted twice", "lecture, next event 1",
               "the light sample plus the bounce that hits the light: weights that sum to 2", Fault::bias, 1000,
               mean_test_case(0.36, [](Pcg& r) { return next_event(r) + emitter_hit(r); }),
               mean_test_case(0.36, [](Pcg& r) { return next_event(r); })});
  s.push_back({"P34", "light lost in the mirror", "lecture, next event 2",
               "no emission after any bounce: what a mirror shows of the light is lost; keep it after delta lobes",
               Fault::bias, 1000, mean_test_case(0.68, [](Pcg& r) { return uniform(r) < 0.5 ? 0.0 : next_event(r); }),
               mean_test_case(0.68, [](Pcg& r) { return uniform(r) < 0.5 ? 1.0 : next_event(r); })});
  s.push_back({"P35", "a fixed frame near -z", "lajolla, 8.4",
               "within 1e-6 of the pole the frame is not orthogonal: directions off unit; branchless copysign form",
               Fault::outside, 1000,
               test_case(on_sphere(
                   [](Pcg& r) {
                     const V l = cosine(r);
                     return V(V(0, -1, 0) * l.x() + V(-1, 0, 0) * l.y() + near_minus_z() * l.z());
                   },
                   about(near_minus_z()))),
               test_case(on_sphere([](Pcg& r) { return mc::Frame<double>::from_z(near_minus_z()).to_world(cosine(r)); },
                                   about(near_minus_z())))});
  s.push_back({"P36", "a clamped logarithm", "lajolla, 4.1",
               "max(u, 1e-8) (here 1e-3) puts an atom where the tail was; 1 - u is never 0", Fault::local, 30'000,
               rayleigh([](Pcg& r) { return std::sqrt(-2 * std::log(std::max(uniform(r), 1e-3))); }),
               rayleigh([](Pcg& r) { return std::sqrt(-2 * std::log1p(-uniform(r))); })});
}

} // namespace

void add_courses(KnownBugs& s) {
  add_tutorials(s);
  add_chapters_and_lectures(s);
}

} // namespace carlo

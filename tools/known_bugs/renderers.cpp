// R1 ...: bugs that renderers shipped, each reimplemented here.
#include <known_bugs/test_cases.h>

#include <mc/core/turns.h>
#include <mc/domain/product.h>
#include <mc/estimate/mis.h>
#include <mc/table/alias_table.h>
#include <mc/table/table_dist_1d.h>
#include <mc/warp/beckmann.h>
#include <mc/warp/cone.h>
#include <mc/warp/exponential.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/linear.h>
#include <mc/warp/smoothstep.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

namespace carlo {
namespace {

using V = Direction;
using V2 = mc::Vec2<double>;
using F = Eigen::Array3d;
using mc::Fault, mc::Pcg;

// Four equal cells. The last entry of the distribution function is the rounded sum instead of 1.
double table_sample(double u, double third) {
  const double cdf[] = {0, 0.25, 0.5, third, 1.0};
  const auto i = std::upper_bound(cdf, cdf + 4, u) - cdf - 1;
  return (static_cast<double>(i) + (u - cdf[i]) / (cdf[i + 1] - cdf[i])) / 4;
}

// (p(x) - p(0)) / (p(1) - p(0)) with a polynomial p that ignores its argument and always uses x.
double by_ignored_argument(double x) {
  const double p = x * x * x * (2 - x);
  return (p - p) / (p - p);
}

// The smooth step with this inverse.
TestCase smoothstep(const std::function<double(double)>& invert) {
  return test_case(InvertibleWarp1D{.sample = [](double u) { return mc::Smoothstep<double>{}.sample(u); },
                                    .pdf = [](double x) { return mc::Smoothstep<double>{}.pdf(x); },
                                    .invert = invert});
}

// After rounding, the sum of two barycentrics may slightly exceed 1; the third must not become negative.
double third_barycentric(Pcg& r, bool twice) {
  double b1 = 1e-3 + uniform(r), b2 = std::max(1 - b1, 0.0) + 1e-3 * uniform(r);
  if (b1 + b2 > 1) {
    const double sum = b1 + b2;
    b1 /= sum;
    b2 /= twice ? b1 + b2 : sum;
  }
  return std::max(b1 + b2 - 1, 0.0);
}

// Visible normals by a disk around the stretched direction w. `skewed`: near the pole the tangent is (1,0,0), which is
// not perpendicular.
InvertibleWarp visible_normals(bool skewed) {
  const double alpha = 0.01;
  const V wo = incident(24), w = V(alpha * wo.x(), alpha * wo.y(), wo.z()).normalized();
  const V along = mc::cross<double>(V::UnitZ(), w).normalized();
  const V t1 = skewed ? V::UnitX() : along, t2 = mc::cross<double>(w, t1), across = mc::cross<double>(w, along);
  const double half = (1 + w.z()) / 2;
  const auto warp = [=](const V2& u) {
    const double radius = std::sqrt(u[0]), x = radius * std::cos(2 * pi * u[1]), h = std::sqrt(1 - x * x);
    const double y = h + half * (radius * std::sin(2 * pi * u[1]) - h);
    const V n = x * t1 + y * t2 + mc::safe_sqrt<double>(1 - x * x - y * y) * w;
    return V(alpha * n.x(), alpha * n.y(), std::max(1e-6, n.z())).normalized();
  };
  const auto invert = [=](const V& m) {
    const V n = V(m.x() / alpha, m.y() / alpha, m.z()).normalized();
    const double x = n.dot(along), h = mc::safe_sqrt<double>(1 - x * x), y = h + (n.dot(across) - h) / half;
    return V2(x * x + y * y, mc::azimuth_turns<double>(x, y));
  };
  return {warp, [v = mc::TrowbridgeReitzVisibleNormals<double>(wo, alpha)](const V& m) { return v.pdf(m); }, invert};
}

// The power heuristic of two densities over the range of float.
TestCase weights(float (*heuristic)(float, float)) {
  return law_test_case("weights sum to 1", 1e-6, Fault::weight, [heuristic](Pcg& r) {
    const auto f = static_cast<float>(std::pow(10.0, 60 * uniform(r) - 30)),
               g = static_cast<float>(f * std::pow(10.0, 2 * uniform(r) - 1));
    return std::abs(static_cast<double>(heuristic(f, g)) + static_cast<double>(heuristic(g, f)) - 1);
  });
}

// A grey diffuse surface sampled by a diffuse and a rough lobe. sample() selects the lobe with one weight, pdf() states
// another.
TestCase two_lobes(double sampled, double stated) {
  const auto density = [](double weight, const V& wo, const V& wi) {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0.0;
    const V h = (wo + wi).normalized();
    return weight * wi.z() / pi + (1 - weight) * mc::TrowbridgeReitzNormals<double>(0.5).pdf(h) / (4 * wo.dot(h));
  };
  BsdfFunctions b;
  b.sample = [=](const V& wo, double uc, const V2& u) -> std::optional<BsdfFunctions::Sample> {
    V wi = mc::CosineHemisphere<double>{}.sample(u);
    if (uc >= sampled) {
      const V h = mc::TrowbridgeReitzNormals<double>(0.5).sample(u);
      wi = (2 * wo.dot(h) * h - wo).normalized();
    }
    if (!(wo.z() > 0 && wi.z() > 0)) return {};
    return BsdfFunctions::Sample{wi, F::Constant(0.5 / pi), density(sampled, wo, wi)};
  };
  b.eval = [](const V& wo, const V& wi) { return F(F::Constant(wo.z() > 0 && wi.z() > 0 ? 0.5 / pi : 0)); };
  b.pdf = [=](const V& wo, const V& wi) { return density(stated, wo, wi); };
  return test_case(b, 30);
}

// The mean cosine of a phase function with the requested g = 0.995.
TestCase mean_cosine(double g) {
  return mean_test_case(
      0.995, [warp = mc::HenyeyGreenstein<double>(g)](Pcg& r) { return warp.sample(r.point<double, 2>()).z(); });
}

// 0, a value next to 0 or 1, or the middle.
float end_or_middle(Pcg& r) {
  const double all[] = {0, 0x1p-24, 0.5, 1 - 0x1p-24};
  return static_cast<float>(all[r.next32() & 3]);
}

// A warp at such places: the result must be finite, in the domain, and have a positive density.
template <class W> TestCase edges(const W& warp) {
  return law_test_case("boundary and branches of u", 0, Fault::boundary, [warp](Pcg& r) {
    mc::Vec2<float> u;
    for (int i = 0; i < 2; ++i) u[i] = end_or_middle(r);
    const mc::Vec3<float> m = warp.sample(u);
    return m.allFinite() && m.z() >= 0 && warp.pdf(m) > 0 ? 0.0 : 1.0;
  });
}

// Square to disk by the concentric map, written with a division by the larger coordinate.
mc::Vec2<float> concentric(const mc::Vec2<float>& u) {
  const float x = 2 * u[0] - 1, y = 2 * u[1] - 1, quarter = mc::pi<float> / 4;
  const bool wide = std::abs(x) > std::abs(y);
  const float r = wide ? x : y, phi = wide ? quarter * (y / x) : 2 * quarter - quarter * (x / y);
  return {r * std::cos(phi), r * std::sin(phi)};
}

struct ConcentricCosine {
  mc::Vec3<float> sample(const mc::Vec2<float>& u) const {
    const mc::Vec2<float> d = u == mc::Vec2<float>(0.5f, 0.5f) ? mc::Vec2<float>(0, 0) : concentric(u);
    return {d.x(), d.y(), mc::safe_sqrt<float>(1 - d.squaredNorm())};
  }
  float pdf(const mc::Vec3<float>& w) const { return w.z() / mc::pi<float>; }
};

struct ConcentricBeckmann {
  float alpha = 0.3f;
  mc::Vec3<float> sample(const mc::Vec2<float>& u) const {
    const mc::Vec2<float> d = concentric(u);
    const float r2 = d.squaredNorm(), t2 = -alpha * alpha * std::log(1 - r2), c = 1 / std::sqrt(1 + t2),
                s = std::sqrt(t2 / r2) * c;
    return {d.x() * s, d.y() * s, c};
  }
  float pdf(const mc::Vec3<float>& m) const { return mc::BeckmannNormals<float>(alpha).pdf(m); }
};

// exp(-c x) on [0,1] in float, by logarithms of nearly equal numbers.
TestCase trimmed_exponential() {
  const float c = 1e-6f;
  const auto sample = [c](Pcg& r) {
    return std::min(std::log(1 - r.uniform<float>() * (1 - std::exp(-c))) / -c, 1.0f);
  };
  return test_case(make_subject("", mc::Interval<float>(0, 1), sample,
                                [c](float x) { return c / (1 - std::exp(-c)) * std::exp(-c * x); }));
}

// The density a + (b - a) x on [0,1] of large values: their squares overflow.
TestCase linear_squared() {
  const float a = 1e30f, b = 2e30f;
  const auto sample = [a, b](Pcg& r) {
    const float u = r.uniform<float>();
    return (a - std::sqrt((1 - u) * a * a + u * b * b)) / (a - b);
  };
  return test_case(make_subject("", mc::Interval<float>(0, 1), sample,
                                [a, b](float x) { return 2 * ((1 - x) * a + x * b) / (a + b); }));
}

// von Mises-Fisher at kappa = 1e-7 in float: 1 - exp(-2 kappa) cancels.
TestCase nearly_uniform_fisher() {
  const float kappa = 1e-7f;
  const auto sample = [](Pcg& r) {
    const auto w = mc::VonMisesFisher<float>(1e-7f).sample(r.point<float, 2>());
    return mc::Vec3<float>(w);
  };
  const auto pdf = [kappa](const mc::Vec3<float>& w) {
    return std::exp(kappa * (w.z() - 1)) * kappa / (2 * mc::pi<float> * (1 - std::exp(-2 * kappa)));
  };
  return test_case(make_subject("", mc::Sphere<float>{}, sample, pdf));
}

// Three outcomes with rounded cumulative sums. The remainder of u is divided by the weight instead of the width of the
// interval that was searched.
struct ReusedRemainder {
  using Scalar = float;
  std::size_t size() const { return 3; }
  float pmf(std::size_t i) const { return i == 2 ? 0.5f : 0.25f; }
  mc::DiscreteSample<float> sample_index(float u) const {
    const float cdf[] = {0, 0.25f, 0.4995f};
    const auto i = static_cast<std::size_t>(std::upper_bound(cdf, cdf + 3, u) - cdf - 1);
    return {i, pmf(i), (u - cdf[i]) / pmf(i)};
  }
};

void add_tables_weights_and_cones(KnownBugs& s) {
  s.push_back({"R1", "unnormalised last CDF entry", "tables of renderers",
               "the sum's rounding error goes to one cell: it gains what another loses", Fault::shape, 40'000,
               test_case(on_interval(
                   0, 1, [](Pcg& r) { return table_sample(uniform(r), 0.74); }, [](double) { return 1.0; })),
               test_case(on_interval(
                   0, 1, [](Pcg& r) { return table_sample(uniform(r), 0.75); }, [](double) { return 1.0; }))});
  s.push_back({"R2", "smoothstep inverse", "pbrt-v4", "its polynomial ignores its argument: 0 / 0 for every x",
               Fault::inverse, 1000, smoothstep(by_ignored_argument),
               smoothstep([](double x) { return mc::Smoothstep<double>{}.invert(x); })});
  s.push_back(
      {"R3", "barycentrics divided twice", "pbrt-v4, spherical triangle",
       "the second division uses the first's result: the third coordinate turns negative", Fault::outside, 1000,
       law_test_case("barycentrics >= 0", 1e-15, Fault::outside, [](Pcg& r) { return third_barycentric(r, true); }),
       law_test_case("barycentrics >= 0", 1e-15, Fault::outside, [](Pcg& r) { return third_barycentric(r, false); })});
  s.push_back({"R4", "visible normals in a skewed frame", "pbrt-v4, Trowbridge-Reitz",
               "near the pole the tangent is (1,0,0), not orthogonal: mean slope .2 % of its spread off",
               Fault::inverse, 1000, test_case(visible_normals(true)), test_case(visible_normals(false))});
  s.push_back({"R5", "weights that sum to 2", "pbrt-v4, Mitsuba 3: power heuristic",
               "squares of float densities beyond 1e19 overflow, below 1e-22 vanish; divide by the larger first",
               Fault::weight, 1000,
               weights([](float f, float g) { return std::isinf(f * f) ? 1.0f : f * f / (f * f + g * g); }),
               weights([](float f, float g) { return mc::power_heuristic<float>(1, f, 1, g); })});
  s.push_back({"R6", "lobe weights differ", "three-gpu-pathtracer",
               "sample picks lobes with one weight, pdf states another", Fault::weight, 1000, two_lobes(0.5, 0.4),
               two_lobes(0.5, 0.5)});
  s.push_back({"R7", "a missing 1 / pdf", "a user's Mitsuba 3 plugin", "sample returns f cos instead of f cos / pdf",
               Fault::bias, 1000,
               mean_test_case(
                   1, [](Pcg& r) { return cosine_pdf(mc::UniformHemisphere<double>{}.sample(r.point<double, 2>())); }),
               mean_test_case(1, [](Pcg& r) {
                 return cosine_pdf(mc::UniformHemisphere<double>{}.sample(r.point<double, 2>())) * 2 * pi;
               })});
  s.push_back({"R8", "narrow cone by its cosine", "pbrt-v4, Mitsuba 3",
               "a cone of 1 mrad in float: pdf 5 % off, nine distinct cosines", Fault::mass, 1000,
               test_case(make_subject(
                   "", mc::Sphere<float>{},
                   [](Pcg& r) { return mc::UniformCone<float>::from_cos(std::cos(1e-3f)).sample(r.point<float, 2>()); },
                   [](const mc::Vec3<float>& w) {
                     return mc::one_minus_z(w) <= 5e-7f ? 1 / (2 * mc::pi<float> * (1 - std::cos(1e-3f))) : 0;
                   })),
               test_case(make_subject("", mc::UniformCone<float>::from_angle(1e-3f)))});
}

void add_edges_of_distributions(KnownBugs& s) {
  s.push_back({"R9", "two normals under one root", "pbrt-v4 until 2025",
               "sqrt(-2 ln(u) cos phi) is NaN for three of four draws", Fault::not_finite, 1000,
               test_case(make_subject(
                   "", mc::IsotropicNormal<double>{}.domain(),
                   [](Pcg& r) {
                     const double r2 = -2 * std::log1p(-uniform(r)), phi = 2 * pi * uniform(r);
                     return V2(std::sqrt(r2 * std::cos(phi)), std::sqrt(r2 * std::sin(phi)));
                   },
                   [](const V2& p) { return mc::IsotropicNormal<double>{}.pdf(p); })),
               test_case(make_subject("", mc::IsotropicNormal<double>{}))});
  s.push_back({"R10", "phase function clamped to g = .99", "pbrt-v4",
               "asked for g = .995 it scatters as .99: sample and pdf agree, the mean cosine does not", Fault::bias,
               4000, mean_cosine(0.99), mean_cosine(0.995)});
  s.push_back({"R11", "cosine lobe through the disk's rim", "pbrt-v4",
               "u = (0, 1/2) gives z = 0, where the density is 0", Fault::boundary, 1000, edges(ConcentricCosine{}),
               edges(mc::CosineHemisphere<float>{})});
  s.push_back({"R12", "the centre of the disk", "Mitsuba 3, Beckmann",
               "u = (1/2, 1/2), the second Sobol' point, is 0 / 0", Fault::boundary, 1000, edges(ConcentricBeckmann{}),
               edges(mc::BeckmannNormals<float>(0.3f))});
  s.push_back({"R13", "a nearly flat exponential", "pbrt-v4",
               "1 - exp(-1e-6) in float: 18 distinct samples, density 1.3 % off", Fault::mass, 1000,
               trimmed_exponential(), test_case(make_subject("", mc::TrimmedExponential<float>(1e-6f, 1)))});
  s.push_back({"R14", "a cylinder of area 1 / pi", "tungsten", "density 1 / pi on an area of 4 pi", Fault::mass, 1000,
               test_case(on_sphere([](Pcg& r) { return direction(1 - 2 * uniform(r), 2 * pi * uniform(r)); },
                                   [](const V&) { return 1 / pi; })),
               test_case(on_sphere([](Pcg& r) { return direction(1 - 2 * uniform(r), 2 * pi * uniform(r)); },
                                   [](const V&) { return 1 / (4 * pi); }))});
  s.push_back({"R15", "squares that overflow", "pbrt-v4, Mitsuba 3: bilinear",
               "linear weights of 1e30 in float are not a number", Fault::not_finite, 1000, linear_squared(),
               test_case(make_subject("", mc::Linear<float>(1e30f, 2e30f)))});
  s.push_back({"R16", "nearly uniform von Mises-Fisher", "Mitsuba 3",
               "1 - exp(-2 kappa) in float: the density of kappa = 1e-7 integrates to 1.12", Fault::mass, 1000,
               nearly_uniform_fisher(), test_case(make_subject("", mc::VonMisesFisher<float>(1e-7f)))});
  s.push_back({"R17", "a remainder outside [0,1)", "Nori, sampleReuse",
               "the reused number is divided by another width than the one that was searched", Fault::not_finite, 8000,
               test_case(mc::make_discrete_subject("", ReusedRemainder{})),
               test_case(mc::make_discrete_subject("", mc::AliasTable(std::vector<double>{0.25, 0.25, 0.5})))});
}

} // namespace

KnownBugs renderer_bugs() {
  KnownBugs s;
  add_tables_weights_and_cones(s);
  add_edges_of_distributions(s);
  return s;
}

} // namespace carlo

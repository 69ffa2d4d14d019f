// Scattering media, against closed forms, furnaces and other strategies.

#include <render/render.h>
#include <render/scene/builder.h>

#include <mc/random/pcg.h>
#include <mc/stats/t_test.h>

#include "support/files.h"
#include "support/traced.h"

namespace {

using namespace render;

const Spectrum white = Spectrum::Ones();

Spectrum gray(double value) { return Spectrum::Constant(Float(value)); }

void expect_mean(const mc::Moments& m, double expected, const std::string& where) {
  EXPECT_GE(mc::t_test(m, expected).p, 1e-6)
      << where << ": " << m.mean() << " +- " << m.std_error() << ", expected " << expected;
}

void expect_same_mean(const mc::Moments& a, const mc::Moments& b, const std::string& where) {
  const double va = mc::sqr(a.std_error()), vb = mc::sqr(b.std_error());
  const double dof = mc::welch_dof(va, a.estimate().dof, vb, b.estimate().dof);
  EXPECT_GE(mc::t_test(a.mean() - b.mean(), std::sqrt(va + vb), dof, 0, 1e-6).p, 1e-6)
      << where << ": " << a.mean() << " +- " << a.std_error() << " and " << b.mean() << " +- " << b.std_error();
}

// Means of edge samples, by quadrature: the share that reaches the end is the transmittance, and the scattered share up
// to the distance t is the integral of sigma_s exp(-sigma_t t). The sum of the throughput never grows.
TEST(HomogeneousMedium, EdgesAreUnbiased) {
  const Spectrum sigma_a(Float(0.1), 1, 0), sigma_s(2, Float(0.3), Float(0.7)), sigma_t = sigma_a + sigma_s;
  const HomogeneousMedium medium(sigma_a, sigma_s);
  mc::Pcg random(5);
  for (const Spectrum& beta : {white, Spectrum(Float(0.1), 1, 0), Spectrum(0, 0, 2)})
    for (const double length : {0.2, 3.0, mc::infinity<double>})
      for (int c = 0; c < 3; ++c) {
        mc::Moments passed, scattered;
        for (std::uint64_t i = 0; i < 20'000; ++i) {
          const auto edge = medium.sample_edge(beta, random.point<Float, 2>(), Float(length));
          const Spectrum after = beta * edge.weight;
          EXPECT_LE(after.sum(), beta.sum() * Float(1 + 1e-5));
          passed.add(edge.distance ? 0 : double(after[c]), i);
          scattered.add(edge.distance && *edge.distance < 1 ? double(after[c]) : 0, i);
        }
        const double b = double(beta[c]), t = double(sigma_t[c]), reach = std::min(length, 1.0);
        const std::string where = fmt::format("length {}, channel {}", length, c);
        if (b == 0) continue;
        if (std::isfinite(length)) expect_mean(passed, b * std::exp(-t * length), where + ", passed");
        expect_mean(scattered, b * double(sigma_s[c]) / t * -std::expm1(-t * reach), where + ", scattered");
      }
}

TEST(HomogeneousMedium, DeepEdgesAreResolved) {
  const HomogeneousMedium medium(Spectrum::Zero(), white);
  // Of 2^48 numbers the largest reaches 33 mean free paths.
  const Float last = 1 - std::numeric_limits<Float>::epsilon() / 2;
  EXPECT_GT(*medium.sample_edge(white, {last, last}, mc::infinity<Float>).distance, 30);
  EXPECT_FALSE(medium.sample_edge(white, {last, last}, 30).distance);
}

TEST(HomogeneousMedium, RefusesBadScattering) {
  for (const Float bad : {Float(-1), mc::infinity<Float>, std::numeric_limits<Float>::quiet_NaN()})
    EXPECT_THAT(support::error_of([&] { HomogeneousMedium(Spectrum::Zero(), Spectrum(0, bad, 0)); }),
                testing::StartsWith("medium: sigmaS (0, " + fmt::format("{}", bad)));
}

/// A ball of a medium in a sky, behind an invisible boundary or glass.
Scene ball_in_sky(const HomogeneousMedium& medium, const Material& boundary) {
  SceneBuilder builder;
  builder.add(Light(ConstantBackground(white)));
  builder.add(Sphere(Vec3d::Zero(), 1), {.bsdf = builder.add(boundary), .interior = medium});
  return builder.build();
}

// What absorbs nothing is as bright as the sky, by any phase function and boundary. t-tests at alpha = 1e-6.
TEST(ParticipatingMedia, FurnaceOfLosslessMedium) {
  const Ray ray{Vec3(-3, Float(0.3), Float(0.2)), Vec3::UnitX()};
  for (const Material& boundary :
       {Material::invisible(), Material(Bsdf(Dielectric(1))), Material(Bsdf(Dielectric(Float(1.3)))),
        Material(Bsdf(RoughDielectric(Float(1.3), Float(1e-4))))})
    for (const double g : {-0.5, 0.0, 0.8})
      for (const double sigma : {0.3, 4.0})
        for (const char* strategy : {"bsdf", "mis"}) {
          const Scene scene =
              ball_in_sky(HomogeneousMedium(Spectrum::Zero(), gray(sigma), PhaseFunction(Float(g))), boundary);
          const mc::Moments m = support::traced(scene, ray, {strategy_from(strategy)}, 3000);
          // Rounding of long paths, or a t-test.
          if (!(std::abs(m.mean() - 1) <= 1e-4))
            expect_mean(m, 1, fmt::format("{}, g {}, sigma {}", strategy, g, sigma));
        }
}

// As above inside a lamp, to which vertices in the medium connect through the boundary.
TEST(ParticipatingMedia, FurnaceInsideALamp) {
  for (const double radius : {1.5, 50.0}) {
    SceneBuilder builder;
    builder.add(Sphere(Vec3d::Zero(), 1),
                {.bsdf = builder.add(Material::invisible()), .interior = HomogeneousMedium(Spectrum::Zero(), gray(3))});
    builder.add(Sphere(Vec3d(0.1, 0, 0), radius, true), {builder.add(Lambert(Spectrum::Zero())), Emission{}});
    const Scene scene = builder.build();
    for (const char* strategy : {"bsdf", "nee", "mis"})
      expect_mean(support::traced(scene, {Vec3(Float(-1.2), Float(0.3), Float(0.2)), Vec3::UnitX()},
                                  {strategy_from(strategy)}, 5000),
                  1, fmt::format("{}, radius {}", strategy, radius));
  }
}

// Light of a point in a fog without walls, scattered once: the integral of sigma_s exp(-sigma_t (t + r)) p(cos) / r^2
// over the ray, by Simpson's rule in the angle at the light, in which the integrand is smooth. t-tests at alpha = 1e-6.
TEST(ParticipatingMedia, SingleScatteringOfAPointLight) {
  for (const double g : {-0.4, 0.0, 0.7})
    for (const double sigma_s : {0.05, 0.4, 2.0}) {
      const double sigma_t = sigma_s + 0.1, height = 0.5, along = 1.5;
      SceneBuilder builder;
      builder.set_ambient(HomogeneousMedium(gray(0.1), gray(sigma_s), PhaseFunction(Float(g))));
      builder.add(Sphere(Vec3d(0, -100, 0), 1), {builder.add(Lambert())});
      builder.add(Light(PointLight(Vec3d(0, height, -along), white)));
      const Scene scene = builder.build();
      constexpr int n = 4000;
      const double first = std::atan2(-along, height), last = mc::pi<double> / 2 - 1e-9;
      double expected = 0;
      for (int i = 0; i <= n; ++i) {
        const double angle = first + (last - first) * i / n, r = height / std::cos(angle),
                     t = along + height * std::tan(angle);
        const double cosine = -std::sin(angle); // of the deflection: the light's ray against the reversed camera ray
        const double p = (1 - g * g) / (4 * mc::pi<double> * std::pow(1 + g * g - 2 * g * cosine, 1.5));
        const int weight = i == 0 || i == n ? 1 : 2 + 2 * (i % 2);
        expected += weight * sigma_s * std::exp(-sigma_t * (t + r)) * p / height * (last - first) / n / 3;
      }
      for (const char* strategy : {"nee", "mis"}) {
        PathOptions options{strategy_from(strategy), 2};
        const Ray ray{Vec3::Zero(), -Vec3::UnitZ()};
        const mc::Moments m =
            support::samples_of(PathIntegrator<Scene>(scene, options), ray, 20'000, 1, initial_media(scene, ray));
        expect_mean(m, expected, fmt::format("{}, g {}, sigma_s {}", strategy, g, sigma_s));
      }
    }
}

// H function of isotropic scattering, by iteration over the midpoints of n intervals [Chandrasekhar60, section 38].
double chandrasekhar_h(double mu, double albedo) {
  constexpr int n = 400;
  std::vector<double> h(n, 1.0), next(n);
  const auto node = [](int i) { return (i + 0.5) / n; };
  const auto value = [&](double x) {
    double sum = 0;
    for (int j = 0; j < n; ++j) sum += node(j) * h[static_cast<std::size_t>(j)] / (x + node(j)) / n;
    return 1 / (std::sqrt(1 - albedo) + albedo / 2 * sum);
  };
  for (int step = 0; step < 300; ++step) {
    for (int i = 0; i < n; ++i) next[static_cast<std::size_t>(i)] = value(node(i));
    h = next;
  }
  return value(mu);
}

// A half space of isotropic scattering under a white sky reflects 1 - sqrt(1 - albedo) H(mu). The slab is 400 mean free
// paths thick and wide. t-tests at alpha = 1e-6.
TEST(ParticipatingMedia, HalfSpaceReflectsByChandrasekhar) {
  for (const double albedo : {0.3, 0.8, 0.97})
    for (const double mu : {0.2, 0.7, 1.0}) {
      SceneBuilder builder;
      builder.add(Light(ConstantBackground(white)));
      builder.add(
          TriangleMesh::box(Transform::translate({0, 0, -200}) * Transform::scale({200, 200, 200})),
          {.bsdf = builder.add(Material::invisible()), .interior = HomogeneousMedium(gray(1 - albedo), gray(albedo))});
      const Scene scene = builder.build();
      const Vec3d d(std::sqrt(1 - mu * mu), 0, -mu);
      const Ray ray{Vec3(-d.cast<Float>()), d.cast<Float>()};
      const double expected = 1 - std::sqrt(1 - albedo) * chandrasekhar_h(mu, albedo);
      for (const char* strategy : {"bsdf", "mis"})
        expect_mean(support::traced(scene, ray, {strategy_from(strategy)}, 20'000), expected,
                    fmt::format("{}, albedo {}, mu {}", strategy, albedo, mu));
    }
}

// A fog of three colours with a ball of denser fog behind an invisible boundary, a ball of glass without fog, a floor
// and a lamp. All strategies find the same light. Welch's tests at alpha = 1e-6.
TEST(ParticipatingMedia, StrategiesAgree) {
  SceneBuilder builder;
  builder.set_ambient(HomogeneousMedium(Spectrum(Float(0.1), Float(0.05), Float(0.2)),
                                        Spectrum(Float(0.1), Float(0.2), Float(0.3)), PhaseFunction(Float(0.5))));
  builder.add(Sphere(Vec3d(0, 0.6, 0), 0.6),
              {.bsdf = builder.add(Material::invisible()), .interior = HomogeneousMedium(gray(0.2), gray(3))});
  builder.add(Sphere(Vec3d(1.2, 0.5, 0), 0.5),
              {.bsdf = builder.add(Dielectric(Float(1.5))), .interior = HomogeneousMedium(Spectrum::Zero())});
  const BsdfId floor = builder.add(Lambert(gray(0.6)));
  builder.add(TriangleMesh::rectangle(Transform::rotate(Vec3d::UnitX(), -90) * Transform::scale({4, 4, 1})), {floor});
  builder.add(Sphere(Vec3d(-0.5, 2.5, 0.5), 0.5), {floor, Emission{}});
  const Scene scene = builder.build();
  for (const Vec3d& at : {Vec3d(0.2, 0.7, 0), Vec3d(1.2, 0.6, 0), Vec3d(-1, 0, 0.5)})
    for (int c = 0; c < 3; c += 2) {
      const Vec3d eye(0, 1, 4), d = (at - eye).normalized();
      const Ray ray{eye.cast<Float>(), d.cast<Float>()};
      const auto moments = [&](const char* name) {
        return support::samples_of(PathIntegrator<Scene>(scene, {strategy_from(name)}), ray, 8'000, c,
                                   initial_media(scene, ray));
      };
      const mc::Moments plain = moments("bsdf");
      EXPECT_GT(plain.mean(), 0);
      for (const char* name : {"mixture", "mis", "mis+lt"})
        expect_same_mean(moments(name), plain, fmt::format("{} at {}, channel {}", name, at.x(), c));
    }
}

// An invisible boundary between equal media changes nothing. Welch's tests at alpha = 1e-6.
TEST(ParticipatingMedia, BoundaryBetweenEqualMediaIsInvisible) {
  const HomogeneousMedium fog(gray(0.3), Spectrum(1, 2, 3), PhaseFunction(Float(-0.3)));
  const auto scene_with = [&](bool boundary) {
    SceneBuilder builder;
    builder.add(Light(ConstantBackground(white)));
    const BsdfId invisible = builder.add(Material::invisible());
    builder.add(Sphere(Vec3d::Zero(), 1), {.bsdf = invisible, .interior = fog});
    if (boundary) builder.add(Sphere(Vec3d(0.2, 0, 0), 0.5), {.bsdf = invisible, .interior = fog});
    return builder.build();
  };
  const Scene with = scene_with(true), without = scene_with(false);
  const Ray ray{Vec3(-3, Float(0.1), 0), Vec3::UnitX()};
  for (int c = 0; c < 3; ++c)
    expect_same_mean(support::traced(with, ray, {}, 20'000, c), support::traced(without, ray, {}, 20'000, c),
                     fmt::format("channel {}", c));
}

// Renders of the default way and of plain samples agree, and their error bars hold: blocks within 4.5 standard errors.
TEST(ParticipatingMedia, DefaultRenderAgreesWithPlainSamples) {
  SceneBuilder builder;
  builder.set_ambient(HomogeneousMedium(gray(0.02), gray(0.2)));
  const BsdfId floor = builder.add(Lambert(gray(0.6)));
  builder.add(TriangleMesh::rectangle(Transform::rotate(Vec3d::UnitX(), -90) * Transform::scale({4, 4, 1})), {floor});
  builder.add(Sphere(Vec3d(0.3, 1.5, 0), 0.4), {floor, Emission{}});
  builder.add(Sphere(Vec3d(-0.8, 0.5, 0.5), 0.5), {builder.add(Dielectric(Float(1.5)))});
  builder.set(ThinLens(Transform::look_at({0, 1.5, 5}, {0, 0.7, 0}, {0, 1, 0})));
  const Scene scene = builder.build();
  RenderOptions options;
  options.width = 16;
  options.height = 12;
  options.spp = 256;
  const Image fast = render::render(scene, options).image;
  options.adaptive = options.splat = false;
  options.strategy = strategy_from("bsdf");
  options.spp = 2048;
  const Image plain = render::render(scene, options).image;
  ASSERT_TRUE(fast.variance.size() == plain.variance.size() && !plain.variance.empty());
  for (int y = 0; y < 12; y += 4)
    for (int x = 0; x < 16; x += 4) {
      double difference = 0, variance = 0;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
          const std::size_t pixel = fast.index(x + i, y + j);
          difference += double(fast.pixels[pixel].sum() - plain.pixels[pixel].sum());
          variance += 3 * (fast.noise_area * double(fast.variance[pixel].sum()) +
                           plain.noise_area * double(plain.variance[pixel].sum()));
        }
      EXPECT_LE(std::abs(difference), 4.5 * std::sqrt(variance)) << x << ", " << y;
    }
}

TEST(ParticipatingMedia, TilesAreRefused) {
  const Scene scene = ball_in_sky(HomogeneousMedium(gray(0), gray(1)), Material::invisible());
  RenderOptions options;
  options.tiles = true;
  EXPECT_THAT(support::error_of([&] { render::render(scene, options); }),
              testing::HasSubstr("tiles share vertices of surfaces, and this scene has media"));
}

} // namespace

// Radiances with closed forms, at extreme sizes and positions. There are about 100 t-tests at alpha = 1e-5; the seeds
// are fixed.

#include <render/integrator/path_integrator.h>
#include <render/io/mitsuba/mitsuba.h>
#include <render/scene/builder.h>

#include <mc/estimate/moments.h>
#include <mc/sampler/path_sample_stream.h>
#include <mc/stats/t_test.h>

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "support/files.h"
#include "support/traced.h"

namespace {

using namespace render;

void expect_mean(const mc::Moments& m, double value, double rounding, const std::string& what) {
  if (std::abs(m.mean() - value) <= rounding * value) return;
  EXPECT_GE(mc::t_test(m, value).p, 1e-5)
      << what << ": " << m.mean() << " +- " << m.std_error() << ", expected " << value;
}

/// Horizontal rectangle with normal up or down.
Shape horizontal(const Vec3d& center, double half, bool up) {
  return TriangleMesh::rectangle(
      Transform::columns(Vec3d(half, 0, 0), Vec3d(0, 0, up ? -half : half), Vec3d(0, up ? 1 : -1, 0), center));
}

std::vector<std::string> unbiased() { return {"bsdf", "hemisphere", "mixture", "nee", "mis"}; }

// A light of half size h and radiance 1 / h^2 causes 4 cos^2 / (pi d^2), up to h^2 / d^2. Rounding makes some
// directions miss a light of a few thousand ulps. Their weights must still be the weights of aimed directions.
TEST(Extremes, SmallLightsUnderStrategiesThatAimOrConnect) {
  const Vec3d place(0.5, 0.7, 0.3);
  const double d2 = place.squaredNorm(), expected = 4 * 0.49 / (mc::pi<double> * d2 * d2);
  for (const double h : {3e-3, 1e-3, 1e-4}) {
    SceneBuilder builder;
    const BsdfId white = builder.add(Lambert(Spectrum::Ones()));
    builder.add(horizontal(Vec3d::Zero(), 5, true), {white});
    builder.add(horizontal(place, h, false), {white, Emission{Spectrum::Constant(Float(1 / (h * h)))}});
    const Scene scene = builder.build();
    for (const char* strategy : {"mixture", "nee", "mis"})
      expect_mean(support::traced(scene, {Vec3(0, 1, 0), Vec3(0, -1, 0)}, {strategy_from(strategy), 2}, 20'000),
                  expected, 1e-4, fmt::format("{}, half size {}", strategy, h));
  }
}

// In a furnace of 1 a distant glass sphere of radius 1 is invisible under every strategy. Strategies aim at glass only
// if a light is sampled, so there is a light behind the floor.
TEST(Extremes, AFurnaceWithFarGlass) {
  for (const double distance : {1e4, 1e6, 1e7, 1e8}) {
    SceneBuilder builder;
    const BsdfId white = builder.add(Lambert(Spectrum::Ones())), glass = builder.add(Dielectric());
    builder.add(Light(ConstantBackground(Spectrum::Ones())));
    builder.add(horizontal(Vec3d::Zero(), 0.5, true), {white});
    builder.add(Sphere(Vec3d(0, distance, 0), 1), {glass});
    builder.add(Sphere(Vec3d(0, -100, 0), 1), {white, Emission{}});
    const Scene scene = builder.build();
    for (const std::string& strategy : unbiased())
      expect_mean(support::traced(scene, {Vec3(0, 1, 0), Vec3(0, -1, 0)}, {strategy_from(strategy)}, 20'000), 1, 1e-4,
                  fmt::format("{} at {}", strategy, distance));
  }
}

// A black sphere of radius 1 on a white ground under a sky of 1. Beside the sphere the ground receives 1 - (1 +
// x^2)^-3/2 of the sky, by the sphere's form factor, for any size of the ground.
TEST(Extremes, ABlackSphereOnALargeGround) {
  const double x = 0.3, expected = 1 - std::pow(1 + x * x, -1.5);
  for (const double half : {1e2, 1e4, 1e6}) {
    SceneBuilder builder;
    const BsdfId white = builder.add(Lambert(Spectrum::Ones())), black = builder.add(Lambert(Spectrum::Zero()));
    builder.add(Light(ConstantBackground(Spectrum::Ones())));
    builder.add(horizontal(Vec3d::Zero(), half, true), {white});
    builder.add(Sphere(Vec3d(0, 1, 0), 1), {black});
    const Scene scene = builder.build();
    // Under the sphere's overhang, viewed from the side.
    const Vec3 eye(3, Float(0.01), 0), at(Float(x), 0, 0);
    for (const std::string& strategy : unbiased())
      expect_mean(support::traced(scene, {eye, (at - eye).normalized()}, {strategy_from(strategy), 2}, 20'000),
                  expected, 1e-4, fmt::format("{}, ground of {}", strategy, half));
  }
}

// An icosahedron of radius 1.9 with the normals of a ball.
TriangleMesh smooth_icosahedron() {
  const Float g = (1 + std::sqrt(Float(5))) / 2;
  std::vector<Vec3> corners, normals;
  for (const Float a : {Float(-1), Float(1)})
    for (const Float b : {-g, g}) {
      corners.emplace_back(0, a, b);
      corners.emplace_back(a, b, 0);
      corners.emplace_back(b, 0, a);
    }
  for (const Vec3& c : corners) normals.push_back(c.normalized());
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t j = i + 1; j < 12; ++j)
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        const Vec3 &p = corners[i], &q = corners[j], &r = corners[k];
        const auto is_edge = [](const Vec3& from, const Vec3& to) { return (from - to).squaredNorm() < Float(4.1); };
        if (!is_edge(p, q) || !is_edge(q, r) || !is_edge(p, r)) continue;
        if (mc::cross<Float>(q - p, r - p).dot(p) > 0) faces.push_back({i, j, k});
        else faces.push_back({i, k, j});
      }
  EXPECT_EQ(faces.size(), 20u);
  return {corners, faces, normals};
}

// No light enters a closed icosahedron with any shading normals.
TEST(Extremes, SmoothNormalsLetNoLightThrough) {
  SceneBuilder builder;
  const BsdfId white = builder.add(Lambert(Spectrum::Ones()));
  builder.add(smooth_icosahedron(), {white});
  builder.add(Sphere(Vec3d(0, 5, 0), 1), {white, Emission{Spectrum::Constant(100)}});
  builder.add(Light(ConstantBackground(Spectrum::Ones())));
  const Scene scene = builder.build();
  for (const std::string& strategy : unbiased()) {
    const mc::Moments m =
        support::traced(scene, {Vec3::Zero(), Vec3(1, 2, 3).normalized()}, {strategy_from(strategy), 4}, 5'000);
    EXPECT_EQ(m.mean(), 0) << strategy;
  }
}

// In a furnace of 1 a white icosahedron is invisible, also at its outline, where the normals face away from the camera.
TEST(Extremes, SmoothNormalsLoseNoLight) {
  SceneBuilder builder;
  builder.add(smooth_icosahedron(), {builder.add(Lambert(Spectrum::Ones()))});
  builder.add(Light(ConstantBackground(Spectrum::Ones())));
  const Scene scene = builder.build();
  const Vec3 eye = Vec3(3, 4, 12);
  const auto frame = mc::Frame<Float>::from_z(-eye.normalized());
  int bent = 0;
  for (int i = 0; i < 32; ++i) {
    // From outside to inside, until the ray meets the mesh.
    for (Float r = 2; r > 0; r -= Float(0.02)) {
      const double angle = 2 * mc::pi<double> * i / 32;
      const Vec3 at = frame.to_world({r * Float(std::cos(angle)), r * Float(std::sin(angle)), 0});
      const Ray ray{eye, (at - eye).normalized()};
      const auto hit = scene.intersect(ray);
      if (!hit) continue;
      bent += scene.surface_point(ray, *hit).ns.dot(ray.d) > 0;
      for (const std::string& strategy : unbiased())
        expect_mean(support::traced(scene, ray, {strategy_from(strategy)}, 500), 1, 1e-4,
                    fmt::format("{} at {} degrees", strategy, 360 * i / 32));
      break;
    }
  }
  EXPECT_GE(bent, 8);
}

// The same for a sphere of radius r and radiance 1 / r^2: cos / d^2.
TEST(Extremes, SmallSpheresUnderStrategiesThatAimOrConnect) {
  const Vec3d place(0.5, 0.7, 0.3);
  const double d2 = place.squaredNorm(), expected = 0.7 / (d2 * std::sqrt(d2));
  for (const double r : {1e-2, 1e-3, 1e-4}) {
    SceneBuilder builder;
    const BsdfId white = builder.add(Lambert(Spectrum::Ones()));
    builder.add(horizontal(Vec3d::Zero(), 5, true), {white});
    builder.add(Sphere(place, r), {white, Emission{Spectrum::Constant(Float(1 / (r * r)))}});
    const Scene scene = builder.build();
    for (const char* strategy : {"mixture", "nee", "mis"})
      expect_mean(support::traced(scene, {Vec3(0, 1, 0), Vec3(0, -1, 0)}, {strategy_from(strategy), 2}, 20'000),
                  expected, 1e-4, fmt::format("{}, radius {}", strategy, r));
  }
}

// A scene file that is moved far away is the same scene. Its floor is a square or part of a room of huge spheres.
struct Moved : support::ScratchTest {
  // Numbers of 16 digits resolve positions to 1e-7 at 1e9.
  void expect_the_same(const std::function<std::string(const Vec3d& origin)>& floor) const {
    const Vec3d place(0.5, 0.7, 0.3);
    const double d2 = place.squaredNorm(), expected = 0.7 / (d2 * std::sqrt(d2)), r = 0.1;
    for (const double distance : {0.0, 1e4, 1e5, 1e6, 1e9}) {
      const Vec3d m(distance, -0.3 * distance, 0.7 * distance);
      const auto at = [](const Vec3d& p) { return fmt::format("{:.17g}, {:.17g}, {:.17g}", p.x(), p.y(), p.z()); };
      const std::string file = write(
          "moved.xml",
          fmt::format("<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"1\"/>"
                      "<transform name=\"toWorld\"><lookAt origin=\"{}\" target=\"{}\" up=\"0, 0, 1\"/></transform>"
                      "</sensor><bsdf type=\"diffuse\" id=\"white\"><rgb name=\"reflectance\" value=\"1\"/></bsdf>{}{}"
                      "<emitter type=\"area\"><rgb name=\"radiance\" value=\"{}\"/></emitter></shape></scene>",
                      at(m + Vec3d::UnitY()), at(m), floor(m), sphere(m + place, r), 1 / (r * r)));
      const Scene scene = read_mitsuba(file).scene;
      const Ray ray = scene.camera().ray(Vec2(Float(0.5), Float(0.5)), scene.camera().tan_half(1), Vec2(0, 0));
      for (const std::string& strategy : unbiased())
        expect_mean(support::traced(scene, ray, {strategy_from(strategy), 2}, 20'000), expected, 1e-4,
                    fmt::format("{}, moved by {}", strategy, distance));
    }
  }
  /// Without the closing tag.
  static std::string sphere(const Vec3d& center, double radius) {
    return fmt::format("<shape type=\"sphere\"><point name=\"center\" x=\"{:.17g}\" y=\"{:.17g}\" z=\"{:.17g}\"/>"
                       "<float name=\"radius\" value=\"{}\"/>",
                       center.x(), center.y(), center.z(), radius);
  }
};
TEST_F(Moved, IsTheSameScene) {
  expect_the_same([](const Vec3d& m) {
    return fmt::format("<shape type=\"rectangle\"><transform name=\"toWorld\"><rotate x=\"1\" angle=\"-90\"/>"
                       "<scale value=\"5\"/><translate x=\"{:.17g}\" y=\"{:.17g}\" z=\"{:.17g}\"/></transform>"
                       "<ref id=\"white\"/></shape>",
                       m.x(), m.y(), m.z());
  });
}
TEST_F(Moved, AmongHugeSpheresToo) {
  const std::string black = "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0\"/></bsdf></shape>";
  expect_the_same([&](const Vec3d& m) {
    std::string room = sphere(m - 1e5 * Vec3d::UnitY(), 1e5) + "<ref id=\"white\"/></shape>";
    for (const Vec3d& d : {Vec3d(1, 0, 0), Vec3d(-1, 0, 0), Vec3d(0, 0, 1), Vec3d(0, 0, -1)})
      room += sphere(m + (1e5 + 2) * d, 1e5) + black;
    return room;
  });
}

// A lamp beside the floor, and a sun of a million times its power that is so far away that the lamp dominates. The
// error is about the error with the lamp alone.
TEST(Extremes, AFarSunDoesNotHideALamp) {
  const Vec3d place(0.5, 0.7, 0.3);
  const double d2 = place.squaredNorm(), lamp = 0.7 / (d2 * std::sqrt(d2)), r = 0.1, far = 1e5;
  SceneBuilder builder;
  const BsdfId white = builder.add(Lambert(Spectrum::Ones()));
  builder.add(horizontal(Vec3d::Zero(), 5, true), {white});
  builder.add(Sphere(place, r), {white, Emission{Spectrum::Constant(Float(1 / (r * r)))}});
  builder.add(Sphere(Vec3d(0, far, 0), 1), {white, Emission{Spectrum::Constant(Float(1e6))}});
  const Scene scene = builder.build();
  for (const char* strategy : {"nee", "mis"}) {
    const mc::Moments m = support::traced(scene, {Vec3(0, 1, 0), Vec3(0, -1, 0)}, {strategy_from(strategy), 2}, 20'000);
    expect_mean(m, lamp + 1e6 / (far * far), 1e-4, strategy);
    EXPECT_LE(m.std_error(), 0.01 * lamp) << strategy;
  }
}

// No light enters a closed box, at any position.
TEST(Extremes, AClosedCubeIsDarkInside) {
  for (const double distance : {0.0, 1e4, 1e6}) {
    const Vec3d middle(distance, 0.3 * distance, -0.7 * distance);
    SceneBuilder builder;
    builder.add(TriangleMesh::box(Transform::translate(middle)),
                {builder.add(Lambert(Spectrum::Constant(Float(0.8))))});
    builder.add(Light(ConstantBackground(Spectrum::Constant(1000))));
    const Scene scene = builder.build();
    const PathIntegrator<Scene> integrator(scene, {});
    std::uint64_t rays = 0;
    const Vec3 eye = middle.cast<Float>();
    const mc::IndependentPairs numbers(2028, 0);
    for (std::uint32_t i = 0; i < 20'000; ++i) {
      mc::IndependentPathStream<Float> stream(numbers, i);
      const Vec3 d = mc::UniformSphere<Float>{}.sample(stream.next2());
      ASSERT_TRUE(is_black(integrator.Li({eye, d}, stream, rays))) << "moved by " << distance << ", path " << i;
    }
  }
}

// The same for a file far away, where floats cannot represent the cube.
struct FarCube : support::ScratchTest {};
TEST_F(FarCube, IsDarkInside) {
  for (const double distance : {1e4, 1e6, 3e7, 1e8, 1e9}) {
    const std::string file =
        write("cube.xml",
              fmt::format("<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"90\"/>"
                          "<transform name=\"toWorld\"><translate x=\"{0}\" y=\"{0}\" z=\"-{0}\"/></transform></sensor>"
                          "<shape type=\"cube\"><transform name=\"toWorld\"><translate x=\"{0}\" y=\"{0}\" z=\"-{0}\"/>"
                          "</transform></shape><emitter type=\"constant\"/></scene>",
                          distance));
    const Scene scene = read_mitsuba(file).scene;
    const PathIntegrator<Scene> integrator(scene, {});
    const mc::IndependentPairs numbers(2029, 0);
    std::uint64_t rays = 0;
    for (std::uint32_t i = 0; i < 2'000; ++i) {
      mc::IndependentPathStream<Float> stream(numbers, i);
      const Ray ray = scene.camera().ray(stream.next2(), scene.camera().tan_half(1), Vec2(0, 0));
      ASSERT_TRUE(is_black(integrator.Li(ray, stream, rays))) << "moved by " << distance << ", path " << i;
    }
  }
}

} // namespace

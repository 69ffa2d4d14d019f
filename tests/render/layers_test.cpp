#include <render/layers.h>
#include <render/scene/builder.h>

#include <mc/random/pcg.h>

#include "support/files.h"

namespace {

using namespace render;

// A ball of one colour before a plate of squares of .75 units, viewed along +z with a field of view of 90 degrees.
Scene ball_before_plate(const Bsdf& of_ball) {
  SceneBuilder builder;
  const BsdfId ball = builder.add(of_ball);
  const BsdfId squares = builder.add(TexturedBsdf(
      Lambert(),
      {.diffuse_reflectance = Checkerboard(Spectrum(1, 0, 0), Spectrum(0, Float(0.5), 0), UvMap({4, 4}, {0, 0}))}));
  builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 6}) * Transform::scale({3, 3, 1})), {squares});
  builder.add(Sphere(Vec3d(0, 0, 3), 1), {ball});
  LensOptions lens;
  lens.fov = 90;
  lens.radius = 0.3; // layers use the centre of the lens
  lens.focus_distance = 3;
  builder.set(ThinLens(Transform(), lens));
  return builder.build();
}

const ImageExtent extent{32, 32, {0, 0, 32, 32}};

struct LayerValues {
  Vec3d n, p, albedo;
  double z, id;
};
LayerValues at(const std::map<std::string, std::vector<float>>& l, std::size_t i) {
  const auto v = [&](const char* name) { return double(l.at(name)[i]); };
  return {{v("N.X"), v("N.Y"), v("N.Z")},
          {v("P.X"), v("P.Y"), v("P.Z")},
          {v("albedo.R"), v("albedo.G"), v("albedo.B")},
          v("Z"),
          v("id")};
}

// Every pixel follows the formula for the ray through its centre. The film's x axis is opposite to the world's.
TEST(Layers, AreWhatTheRayThroughTheMiddleMeets) {
  const Spectrum color(Float(0.7), Float(0.2), Float(0.1));
  const auto l = layers(ball_before_plate(Lambert(color)), extent);
  EXPECT_EQ(l.size(), 11u);
  int ball = 0, plate = 0, beyond = 0;
  for (std::size_t y = 0; y < 32; ++y)
    for (std::size_t x = 0; x < 32; ++x) {
      const Vec3d d = Vec3d(1 - (double(x) + 0.5) / 16, 1 - (double(y) + 0.5) / 16, 1).normalized();
      const double along = d.z() * 3, miss2 = 9 - along * along;
      const LayerValues s = at(l, y * 32 + x);
      if (miss2 < 1) {
        const Vec3d p = (along - std::sqrt(1 - miss2)) * d;
        EXPECT_LE((s.p - p).norm(), 1e-5);
        EXPECT_LE((s.n - (p - Vec3d(0, 0, 3))).norm(), 1e-5);
        EXPECT_NEAR(s.z, p.z(), 1e-5);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.albedo[c], double(color[c]), 1e-6);
        EXPECT_EQ(s.id, 2);
        ++ball;
      } else if (const Vec3d p = 6 / d.z() * d; std::abs(p.x()) < 3 && std::abs(p.y()) < 3) {
        EXPECT_LE((s.p - p).norm(), 1e-5);
        EXPECT_LE((s.n - Vec3d::UnitZ()).norm(), 1e-6);
        EXPECT_NEAR(s.z, 6, 1e-5);
        const auto square = [](double c) { return std::floor((c + 3) / 0.75); };
        const bool first = std::fmod(square(p.x()) + square(p.y()), 2) == 0;
        EXPECT_LE((s.albedo - (first ? Vec3d(1, 0, 0) : Vec3d(0, 0.5, 0))).norm(), 1e-6);
        EXPECT_EQ(s.id, 1);
        ++plate;
      } else {
        EXPECT_TRUE(s.n.isZero() && s.p.isZero() && s.albedo.isZero());
        EXPECT_EQ(s.z, mc::infinity<double>);
        EXPECT_EQ(s.id, 0);
        ++beyond;
      }
    }
  EXPECT_TRUE(ball > 50 && plate > 50 && beyond > 100) << ball << " " << plate << " " << beyond;
}

TEST(Layers, OfAPartAreThoseOfTheWhole) {
  const Scene scene = ball_before_plate(Lambert());
  const auto all = layers(scene, extent), part = layers(scene, {32, 32, {7, 9, 11, 5}}, Vec3d::Zero(), 1);
  for (const auto& [name, values] : part)
    for (std::size_t y = 0; y < 5; ++y)
      for (std::size_t x = 0; x < 11; ++x) EXPECT_EQ(values[y * 11 + x], all.at(name)[(y + 9) * 32 + x + 7]) << name;
}

TEST(Layers, PositionsAreThoseOfTheFile) {
  const Scene scene = ball_before_plate(Lambert());
  const auto here = layers(scene, extent), there = layers(scene, extent, {100, -200, 300});
  const std::size_t middle = 16 * 32 + 16;
  EXPECT_LE((at(there, middle).p - at(here, middle).p - Vec3d(100, -200, 300)).norm(), 1e-4);
  EXPECT_EQ(at(there, middle).z, at(here, middle).z);
}

// Glass and mirrors scatter all light according to their colours. Glossy surfaces are within the bound of the header,
// by comparison with far more points.
TEST(Layers, AlbedoOfWhatIsNotDiffuse) {
  const auto of_middle = [](const Bsdf& bsdf) {
    return at(layers(ball_before_plate(bsdf), extent), 16 * 32 + 16).albedo;
  };
  EXPECT_LE((of_middle(Dielectric(Float(1.5))) - Vec3d(1, 1, 1)).norm(), 1e-5);
  EXPECT_LE((of_middle(FuzzyMetal(Spectrum(1, Float(0.5), Float(0.25)))) - Vec3d(1, 0.5, 0.25)).norm(), 1e-5);
  for (const double alpha : {1e-4, 0.01, 0.1, 0.3, 1.0})
    for (const Bsdf& bsdf :
         {Bsdf(RoughPlastic(Float(1.5), Float(alpha), Spectrum::Constant(Float(0.5)), Spectrum::Ones())),
          Bsdf(RoughDielectric(Float(1.5), Float(alpha)))}) {
      mc::Pcg random(1);
      const Vec3 wo = Vec3(Float(0.05), 0, 1).normalized(); // nearly the direction of the pixel
      double sum = 0;
      const int n = 40'000;
      for (int i = 0; i < n; ++i) {
        const auto s = bsdf.sample(wo, random.uniform<Float>(), random.point<Float, 2>());
        if (s) sum += double(s->f[0] * std::abs(s->wi.z()) * mc::sqr(s->eta) / s->pdf);
      }
      EXPECT_NEAR(of_middle(bsdf)[0], sum / n, 0.02) << alpha;
    }
}

} // namespace

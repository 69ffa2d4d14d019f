#pragma once
// Random rooms, and the comparison of two methods to render them.

#include <render/render.h>
#include <render/scene/builder.h>

#include <mc/estimate/moments.h>
#include <mc/random/hash.h>
#include <mc/random/pcg.h>

#include "support/random_direction.h"

#include <gtest/gtest.h>

namespace support {

using namespace render;

/// Lights of a room: lamps, delta lights (points and parallel light), or tiny and distant spheres equivalent to the
/// delta lights.
enum class RandomLights { lamps, deltas, spheres };

/// Generates a random room.
class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed, RandomLights lights = RandomLights::lamps)
      : random_(2026, seed), lights_(lights) {}

  Scene build() {
    SceneBuilder builder;
    const BsdfId grey = builder.add(Lambert(Spectrum(Float(0.7), Float(0.5), Float(0.6))));
    for (int wall = 0; wall < 5; ++wall) // the room is open towards the camera
      if (wall == 0 || chance(0.7)) builder.add(TriangleMesh::rectangle(side(wall)), {grey});
    const int things = 1 + static_cast<int>(3 * number());
    for (int i = 0; i < things; ++i) add_object(builder);
    const int lamps = 1 + chance(0.4);
    for (int i = 0; i < lamps; ++i)
      if (lights_ == RandomLights::lamps) add_lamp(builder);
      else add_small_light(builder);
    if (chance(0.3)) builder.add(Light(ConstantBackground(Spectrum::Constant(Float(0.2)))));
    else if (chance(0.6)) builder.add(Light(sky()));
    builder.set(filter());
    const bool is_parallel = chance(0.2);
    builder.set(ThinLens(Transform::look_at({0, 0, -4.5}, place(0.3), {0, 1, 0}),
                         {.fov_axis = FovAxis::y,
                          .fov = 30 + 20 * number(),
                          .radius = !is_parallel && chance(0.4) ? 0.2 : 0,
                          .focus_distance = 4,
                          .near = chance(0.4) ? 2.5 : 0,
                          .half_width = is_parallel ? 1 + number() : 0}));
    return builder.build();
  }

 private:
  double number() { return random_.uniform<double>(); }
  bool chance(double p) { return number() < p; }
  Vec3d place(double r) { return r * (2 * random_.point<double, 3>() - Vec3d::Ones()); }

  // Transform of a side of the cube [-2, 2]^3, facing inward.
  static Transform side(int wall) {
    const Transform turns[] = {Transform::rotate(Vec3d::UnitX(), -90), Transform::rotate(Vec3d::UnitX(), 90),
                               Transform::rotate(Vec3d::UnitY(), 90), Transform::rotate(Vec3d::UnitY(), -90),
                               Transform::rotate(Vec3d::UnitX(), 180)};
    return turns[wall] * Transform::translate({0, 0, -2}) * Transform::scale({2, 2, 1});
  }

  // A dim sky with one bright texel of an eighth by a quarter of it.
  Environment sky() {
    std::vector<Spectrum> texels(32, Spectrum::Constant(Float(0.1)));
    texels[std::size_t(32 * number())] = Spectrum(2, Float(1.5), 1);
    return Environment(std::make_shared<const Texels>(8, 4, std::move(texels)),
                       Transform::rotate(random_axis(random_), 360 * number()));
  }

  Filter filter() {
    switch (static_cast<int>(4 * number())) {
    case 0: return BoxFilter();
    case 1: return TentFilter();
    case 2: return GaussianFilter();
    default: return SubpixelTentFilter();
    }
  }

  Bsdf surface(int kind) {
    const Spectrum tint = Spectrum::Ones() - Spectrum(random_.point<Float, 3>()) / 4;
    if (lights_ != RandomLights::lamps && kind == 3 && chance(0.5))
      return RoughDielectric(Float(1.5), Lobes::near_specular_roughness / 2, tint, tint);
    switch (kind) {
    case 0: return Dielectric(Float(1.1 + number()), tint, tint);
    case 1: return FuzzyMetal(tint);
    case 2: return FuzzyMetal(tint, Float(0.05 + 0.4 * number()));
    case 3:
      if (chance(0.5)) return RoughDielectric<BeckmannFacets>(Float(1.5), Float(0.1 + 0.5 * number()), tint, tint);
      return RoughDielectric(Float(1.5), Float(0.1 + 0.5 * number()), tint, tint);
    case 4: return RoughPlastic<LayeredBase>(Float(1.5), Float(0.1 + 0.4 * number()), tint / 2, tint);
    default: return Lambert(tint / 2);
    }
  }

  // A ball, a box, or a coarse ball with smooth normals.
  void add_object(SceneBuilder& builder) {
    const int kind = static_cast<int>(6 * number());
    SceneBuilder::SurfaceProperties cover{.bsdf = builder.add(surface(kind))};
    if (kind == 0 && chance(0.5)) cover.interior = HomogeneousMedium(Spectrum(random_.point<Float, 3>()));
    const Vec3d at = place(1.2);
    const double size = 0.3 + 0.4 * number();
    const double shape = number();
    if (shape < 0.5) builder.add(Sphere(at, size), cover);
    else if (shape < 0.8)
      builder.add(TriangleMesh::box(Transform::translate(at) * Transform::rotate(random_axis(random_), 360 * number()) *
                                    Transform::scale(Vec3d::Constant(size))),
                  cover);
    else builder.add(octahedron(at, size), cover);
  }

  static TriangleMesh octahedron(const Vec3d& at, double size) {
    std::vector<Vec3> corners, normals;
    for (int i = 0; i < 6; ++i) {
      const Vec3d d = (i % 2 ? 1 : -1) * Vec3d::Unit(i / 2);
      corners.push_back((at + size * d).cast<Float>());
      normals.push_back(d.cast<Float>());
    }
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (std::uint32_t i = 0; i < 8; ++i) {
      const std::uint32_t x = i & 1u, y = 2 + (i >> 1 & 1u), z = 4 + (i >> 2);
      const bool outward = ((x + y + z) & 1u) != 0;
      faces.push_back(outward ? std::array{x, y, z} : std::array{x, z, y});
    }
    return {corners, faces, normals};
  }

  // Large lamps, so that paths from the camera alone estimate their error reliably.
  void add_lamp(SceneBuilder& builder) {
    const Emission light{Spectrum(1, 2, 3), chance(0.3)};
    const BsdfId grey = builder.add(Lambert(Spectrum::Constant(Float(0.3))));
    const Vec3d at = place(0.5) + Vec3d(0, 1.3, 0);
    const double shape = number();
    if (shape < 0.4) builder.add(Sphere(at, 0.4), {grey, light});
    else if (shape < 0.6) builder.add(Sphere::cap(at, 0.5, random_axis(random_), 0.4), {grey, light});
    else
      builder.add(
          TriangleMesh::rectangle(Transform::translate(at) * Transform::rotate(random_axis(random_), 360 * number()) *
                                  Transform::scale(Vec3d::Constant(0.7))),
          {grey, light});
  }

  // A delta light or its equivalent sphere: a sphere of radius r and radiance L gives pi r^2 L / d^2 at distance d.
  void add_small_light(SceneBuilder& builder) {
    const Spectrum light(3, 2, 4);
    const bool far = chance(0.4);
    const Vec3d way = random_axis(random_), at = far ? Vec3d(2e4 * way) : Vec3d(place(0.5) + Vec3d(0, 1.2, 0));
    if (lights_ == RandomLights::deltas) {
      if (far) builder.add(Light(DirectionalLight(-way, light / 4)));
      else builder.add(Light(PointLight(at, light)));
      return;
    }
    const double radius = far ? 5 : 0.002, strength = far ? 1e8 : 1; // (2e4)^2 / 4
    builder.add(Sphere(at, radius), {builder.add(Lambert(Spectrum::Zero())),
                                     Emission{light * Float(strength / (mc::pi<double> * mc::sqr(radius))), false}});
  }

  mc::Pcg random_;
  RandomLights lights_;
};

/// Means of `count` independent images. Pixels are divided by `unit`, which contains their reference plus a tenth of
/// its mean, so that no visible lamp dominates.
inline mc::Moments picture_means(const Scene& scene, RenderOptions options, int count,
                                 const std::vector<Spectrum>& unit) {
  mc::Moments moments;
  for (int i = 0; i < count; ++i) {
    options.seed = mc::hash(options.seed, std::uint64_t(i));
    const RenderResult r = render::render(scene, options);
    EXPECT_EQ(r.invalid, 0u);
    double sum = 0;
    for (std::size_t p = 0; p < unit.size(); ++p) sum += double((r.image.pixels[p] / unit[p]).sum());
    moments.add(sum);
  }
  return moments;
}

inline std::vector<Spectrum> pixel_units(const Image& reference) {
  Spectrum mean = Spectrum::Zero();
  for (const Spectrum& p : reference.pixels) mean += p / Float(reference.pixels.size());
  std::vector<Spectrum> unit;
  for (const Spectrum& p : reference.pixels) unit.push_back(p + mean / 10);
  return unit;
}

inline RenderOptions options_of(std::uint64_t room, unsigned spp) {
  RenderOptions options;
  options.width = 8;
  options.height = 6;
  options.spp = spp;
  options.seed = room;
  options.max_depth = room % 4 == 3 ? 3 : -1;
  return options;
}

/// Tests whether two methods render the same image, by Welch's t. Skewness raises z-scores (from 3 to 4), so the bound
/// is 5.5, which chance exceeds in one case of 10^6.
struct Agreement {
  int scenes = 0, outliers = 0; ///< Number of all scenes, and of scenes beyond the two-sided bound of 5 %.

  void add(std::uint64_t room, const mc::Moments& one, const mc::Moments& two, double bound) {
    const double t = (two.mean() - one.mean()) / std::hypot(one.std_error(), two.std_error());
    ++scenes;
    outliers += std::abs(t) > bound;
    EXPECT_LE(std::abs(t), 5.5) << "room " << room << ": " << two.mean() << " +- " << two.std_error() << " for "
                                << one.mean() << " +- " << one.std_error();
  }
};

} // namespace support

#pragma once
/// Procedural geometry for ray tracing benchmarks, and the rays of an image of it.

#include <render/accel/bvh.h>
#include <render/scene/scene.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace bench {

using render::Float, render::Ray, render::Vec3;

/// Triangles or spheres, and a camera.
struct World {
  std::string name;
  std::vector<Vec3> positions = {};
  std::vector<std::array<std::uint32_t, 3>> triangles = {};
  struct Ball {
    Vec3 center;
    Float radius;
  };
  std::vector<Ball> spheres = {};
  render::ThinLens camera = render::ThinLens();
  /// Meshes of a scene with their normals and uvs; `triangles` are their triangles.
  std::vector<render::Shape> meshes = {};

  std::size_t size() const { return triangles.size() + spheres.size(); }
  /// The shapes as a scene stores them for surfaces without emission.
  std::vector<render::Shape> shapes() const;
};

/// A bumpy sphere of 2 n^2 triangles between five walls.
World bumpy_sphere(std::string name, int n);
/// Triangles at random positions with random directions, a hundred times as long as wide.
World needles(int count);
/// Random spheres in a cube, with radii from a hundredth to a fifth of their mean distance.
World balls(int count);
/// The meshes of a scene file and its camera.
World scene_file(const std::string& path);

/// The three kinds of rays that a path tracer traces for an image of n x n pixels.
///   primary : from the camera, row by row.
///   bounce  : from the hits of primary rays, with density proportional to the cosine to the normal.
///   shadow  : from the same hits to random points near the camera.
struct Rays {
  std::vector<Ray> primary, bounce, shadow;
  Rays(const World& world, const std::vector<render::Shape>& shapes, const render::Bvh& bvh, int n);
};

} // namespace bench

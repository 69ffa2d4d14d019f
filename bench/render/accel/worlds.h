#pragma once
/// Geometry to trace rays through, made by a formula, and the rays of a picture of it.

#include <render/accel/bvh.h>
#include <render/scene/scene.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace bench {

using render::Float, render::Ray, render::Vec3;

/// Triangles or spheres, and where they are looked at from.
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
  std::vector<render::Shape> meshes = {}; ///< of a scene, with their normals and uvs, which the triangles are of

  std::size_t size() const { return triangles.size() + spheres.size(); }
  /// As a scene holds what does not shine.
  std::vector<render::Shape> shapes() const;
};

/// A bumpy sphere of 2 n^2 triangles between five walls.
World bumpy_sphere(std::string name, int n);
/// Triangles of random places and directions, a hundred times as long as wide.
World needles(int count);
/// Random spheres in a cube, of radii from a hundredth to a fifth of their mean distance.
World balls(int count);
/// The meshes of a scene file, seen by its camera.
World scene_file(const std::string& path);

/// The three kinds of rays of a picture of n x n pixels, as a path tracer asks for them.
///   primary : from the camera, row by row
///   bounce  : from where these meet something, by the cosine of the angle to the normal
///   shadow  : from there to random points about the camera
struct Rays {
  std::vector<Ray> primary, bounce, shadow;
  Rays(const World& world, const std::vector<render::Shape>& shapes, const render::Bvh& bvh, int n);
};

} // namespace bench

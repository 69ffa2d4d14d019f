#pragma once
/// Everything that a picture is made of.

#include <render/accel/bvh.h>
#include <render/bsdf/bsdf.h>
#include <render/camera/thin_lens.h>
#include <render/film/filter.h>
#include <render/light/light.h>

#include <optional>
#include <string>
#include <vector>

namespace render {

/// What a scene file says about how to render it; the command line overrides it.
struct RenderDefaults {
  int width = 256, height = 256;
  int spp = 64;
  int max_depth = -1; ///< longest path in edges; -1: no limit
};

/// Shapes with their materials and lights, the background and the camera. Fill it, then call prepare().
struct Scene {
  std::vector<Shape> shapes;
  std::vector<int> shape_bsdf;  ///< per shape, index into bsdfs
  std::vector<int> shape_light; ///< per shape, index into lights, or -1
  std::vector<Bsdf> bsdfs;
  std::vector<AreaLight> lights;
  std::vector<int> guides; ///< shapes that the `mixture` strategy also aims at, besides the lights
  std::optional<Background> background;
  ThinLens camera;
  Filter filter;
  RenderDefaults defaults;

  /// Adds a shape, with a light when `radiance` is given; returns its index.
  int add(Shape shape, int bsdf, std::optional<AreaLight> light = {});

  /// Checks the scene, builds the BVH and the choice of lights.
  ///   throws : Error for an empty scene, an emitting shape without area, a BSDF's parameter or an index out of range
  void prepare();

  bool has_light() const { return !lights.empty() || background.has_value(); }

  /// A light chosen with probability proportional to its emitted power, and that probability.
  struct LightChoice {
    int light;
    Float pmf;
  };
  LightChoice choose_light(Float uc) const;
  Float light_pmf(int light) const { return light_pmf_[static_cast<std::size_t>(light)]; }

  /// Shapes that the `mixture` strategy aims at: those of the lights, and the guides.
  const std::vector<int>& targets() const { return targets_; }
  /// Spheres of glass or mirror that may cast caustics of the lights; none where there are so many that aiming would
  /// not pay.
  const std::vector<int>& speculars() const { return speculars_; }

  const Bvh& bvh() const { return bvh_; }

 private:
  static constexpr std::size_t most_speculars = 8;

  Bvh bvh_;
  std::vector<int> targets_, speculars_;
  std::vector<Float> light_pmf_, light_cdf_;
};

} // namespace render

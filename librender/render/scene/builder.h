#pragma once
/// How a scene is put together.

#include <render/scene/scene.h>

namespace render {

/// Collects what a reader finds and makes the Scene of it. What is added is right by its own constructor.
class SceneBuilder {
 public:
  BsdfId add(Bsdf bsdf) { return add(Material(std::move(bsdf))); }
  BsdfId add(TexturedBsdf bsdf) { return add(Material(std::move(bsdf))); }
  BsdfId add(Material material);

  struct SurfaceProperties {
    BsdfId bsdf;
    std::optional<Emission> emission = {};
    bool importance_target = false; ///< see Surface
    std::optional<HomogeneousMedium> interior = {};
    std::string missing_uv_reason = {}; ///< why the shape has no texture coordinates, for messages
  };
  /// throws : Error for a BSDF that was not added, a texture on a shape that has no texture coordinates, a mask on one
  ///          that shines, or what AreaLight refuses
  void add(Shape shape, const SurfaceProperties& properties);

  /// A light that is no surface.
  void add(Light light);

  void set(const ThinLens& camera) { camera_ = camera; }
  void set(const Filter& filter) { filter_ = filter; }

  /// The scene of all that was added; the builder is empty afterwards.
  ///   throws : Error when there is neither a shape nor an infinite light
  Scene build();

 private:
  std::vector<Surface> surfaces_;
  std::vector<Material> materials_;
  std::vector<Light> lights_;
  ThinLens camera_;
  Filter filter_;
};

} // namespace render

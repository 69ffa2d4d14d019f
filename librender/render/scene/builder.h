#pragma once
/// Construction of scenes.

#include <render/scene/scene.h>

namespace render {

/// Collects surfaces, lights, camera and filter, and builds a Scene. The constructors of the parts check them.
class SceneBuilder {
 public:
  /// Adds a material without mask.
  BsdfId add(Bsdf bsdf) { return add(Material(std::move(bsdf))); }
  /// Adds a material with texture and without mask.
  BsdfId add(TexturedBsdf bsdf) { return add(Material(std::move(bsdf))); }
  /// Adds a material.
  BsdfId add(Material material);

  /// Whether light passes through surfaces of a material: glass, or an invisible boundary.
  bool is_clear(BsdfId material) const;

  /// Properties of a surface besides its shape.
  struct SurfaceProperties {
    BsdfId bsdf;                                    ///< Material, from add().
    std::optional<Emission> emission = {};          ///< Emission; none: the surface does not emit.
    bool importance_target = false;                 ///< See Surface.
    std::optional<HomogeneousMedium> interior = {}; ///< See Surface.
    std::string missing_uv_reason = {}; ///< Reason why the shape has no texture coordinates, for error messages.
  };
  /// Adds a surface.
  ///   throws : Error for an unknown BSDF, or for a texture on a shape without texture coordinates. Error for a mask on
  ///            a surface that emits, and for a visible mask on the boundary of a medium. Error for a shape or emission
  ///            that AreaLight rejects.
  void add(Shape shape, const SurfaceProperties& properties);

  /// Adds a light without a shape.
  void add(Light light);

  /// Sets the medium outside of all surfaces.
  void set_ambient(const HomogeneousMedium& medium) {
    ambient_medium_ = std::make_shared<const HomogeneousMedium>(medium);
  }
  /// Sets the camera.
  void set(const ThinLens& camera) { camera_ = camera; }
  /// Sets the pixel filter.
  void set(const Filter& filter) { filter_ = filter; }

  /// Builds the scene of all parts. The builder is empty afterwards.
  ///   throws : Error if there is neither a shape nor an infinite light.
  Scene build();

 private:
  std::vector<Surface> surfaces_;
  std::vector<Material> materials_;
  std::vector<Light> lights_;
  std::shared_ptr<const HomogeneousMedium> ambient_medium_;
  ThinLens camera_;
  Filter filter_;
};

} // namespace render

#pragma once
/// Scenes, as renderers use them.

#include <render/accel/bvh.h>
#include <render/bsdf/textured_bsdf.h>
#include <render/camera/thin_lens.h>
#include <render/film/filter.h>
#include <render/light/light_sampler.h>
#include <render/scene/medium.h>
#include <render/texture/mask.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace render {

/// Index of a material in a scene, from SceneBuilder::add.
enum class BsdfId : std::uint32_t {};

/// A BSDF, possibly textured, with an optional mask.
struct Material {
  Bsdf bsdf;                                   ///< The BSDF; if `texture` is given, a BSDF of the same kind.
  std::shared_ptr<const TexturedBsdf> texture; ///< Variation over the surface; null: none.
  std::shared_ptr<const Mask> mask;            ///< Mask of opacity; null: opaque.
  bool one_sided = false;                      ///< Whether the side opposite to the normal absorbs all light.

  /// A material that no light meets: the boundary of a medium alone.
  static Material invisible() {
    Material material((Bsdf()));
    material.mask = std::make_shared<const Mask>(Float(0));
    return material;
  }

  /// An opaque material without texture.
  Material(Bsdf b) : bsdf(std::move(b)) {}
  /// An opaque material with texture.
  Material(TexturedBsdf t) : bsdf(t.untextured()), texture(std::make_shared<const TexturedBsdf>(std::move(t))) {}
  /// Whether it is invisible().
  bool is_invisible() const { return mask && !mask->varies() && mask->opacity(Vec2d::Zero()) == 0; }
  /// Whether the material needs texture coordinates.
  bool needs_uv() const { return texture || (mask && mask->varies()); }
};

/// A shape with its material and its role in the scene.
struct Surface {
  /// The shape.
  std::shared_ptr<const Shape> shape;
  /// Its material.
  BsdfId bsdf;
  std::optional<std::uint32_t> light; ///< Index of the area light of this shape; none: it does not emit.
  bool importance_target = false;     ///< Whether strategies with targets also aim at this shape.
  bool one_sided = false;             ///< As in its material.
  /// Medium on the side opposite to the normals; null: the surface separates no media.
  std::shared_ptr<const HomogeneousMedium> interior = {};

  /// Whether light that arrives at `point` in the direction d is absorbed, since d comes from the absorbing side.
  bool absorbs(const SurfacePoint& point, const Vec3& d) const { return one_sided && point.ng.dot(d) > 0; }
};

/// Surfaces, lights, camera and filter of a scene, with acceleration structures. SceneBuilder makes scenes. Immutable,
/// so threads can share it.
class Scene {
 public:
  /// The nearest hit of a ray, regardless of masks.
  std::optional<Hit> intersect(const Ray& ray) const { return bvh_.intersect(ray); }
  /// The surface point at a hit.
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const {
    return surface(hit).shape->surface_point(ray, hit);
  }
  /// Whether any surface is on the ray up to its t_max, regardless of masks.
  bool occluded(const Ray& ray) const { return bvh_.occluded(ray); }
  /// Bounds of all surfaces; empty if there are none.
  const Bounds& bounds() const { return bvh_.bounds(); }

  /// All surfaces.
  std::span<const Surface> surfaces() const { return surfaces_; }
  /// The surface of a hit.
  const Surface& surface(const Hit& hit) const { return surfaces_[static_cast<std::size_t>(hit.shape)]; }
  /// The BSDF of a surface; for a textured surface a BSDF of the same kind.
  const Bsdf& bsdf(const Surface& surface) const { return material(surface).bsdf; }
  /// The BSDF of a surface at the hit `point`. `bsdf_storage` holds it if a texture varies it.
  ///   footprint : size on the surface over which textures are averaged [scene units]; 0: a point.
  const Bsdf& bsdf(const Surface& surface, const Hit& hit, const SurfacePoint& point, std::optional<Bsdf>& bsdf_storage,
                   Float footprint = 0) const {
    const Material& m = material(surface);
    if (!m.texture) [[likely]]
      return m.bsdf;
    const Float in_uv =
        footprint > 0 && m.texture->is_filtered() ? footprint * Float(surface.shape->uv_scale(hit, point)) : Float(0);
    return bsdf_storage.emplace(m.texture->at(surface.shape->uv(hit, point), in_uv));
  }
  /// Whether some surface has a mask. Rays then need visibility.h.
  bool has_masks() const { return has_masks_; }
  /// Opacity of a surface at the hit `point`, in [0, 1].
  Float opacity(const Hit& hit, const SurfacePoint& point) const {
    const Surface& s = surface(hit);
    const auto& mask = material(s).mask;
    if (!mask) return 1;
    return mask->opacity(mask->varies() ? s.shape->uv(hit, point) : Vec2d::Zero());
  }

  /// Whether rays pass any medium. Visibility then depends on the media along a ray; see visibility.h.
  bool has_media() const { return has_media_; }
  /// Whether some medium scatters or has an invisible boundary. Camera paths alone find light there.
  bool has_volumes() const { return has_volumes_; }
  /// Whether some texture depends on the footprint of a path.
  bool has_filtered_textures() const { return has_filtered_textures_; }
  /// Medium outside of all surfaces; null: vacuum.
  const HomogeneousMedium* ambient_medium() const { return ambient_medium_.get(); }

  /// All lights.
  std::span<const Light> lights() const { return lights_; }
  /// Indices of the lights that emit along rays that leave the scene.
  std::span<const std::uint32_t> infinite_lights() const { return infinite_lights_; }
  /// Whether there are lights for next-event estimation. sample_light() and light_pmf() require this.
  bool has_light_sampler() const { return light_sampler_.has_value(); }
  /// Selects a light for the reference point `ref`; see LightSampler.
  mc::DiscreteSample<Float> sample_light(const Vec3& ref, Float u) const {
    return light_sampler_->sample_index(lights_, ref, u);
  }
  /// Probability of selecting a light for the reference point `ref`.
  Float light_pmf(const Vec3& ref, std::size_t light) const { return light_sampler_->pmf(lights_, ref, light); }

  /// The camera.
  const ThinLens& camera() const { return camera_; }
  /// The pixel filter.
  const Filter& filter() const { return filter_; }

 private:
  friend class SceneBuilder;
  Scene(std::vector<Surface> surfaces, std::vector<Material> materials, std::vector<Light> lights, ThinLens camera,
        Filter filter, std::shared_ptr<const HomogeneousMedium> ambient_medium);
  const Material& material(const Surface& surface) const { return materials_[static_cast<std::size_t>(surface.bsdf)]; }

  std::vector<Surface> surfaces_;
  std::vector<Material> materials_;
  std::vector<Light> lights_;
  std::vector<std::uint32_t> infinite_lights_;
  std::optional<LightSampler> light_sampler_;
  std::shared_ptr<const HomogeneousMedium> ambient_medium_;
  bool has_masks_, has_media_, has_volumes_, has_filtered_textures_;
  Bvh bvh_;
  ThinLens camera_;
  Filter filter_;
};

} // namespace render

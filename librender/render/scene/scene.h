#pragma once
/// What a renderer sees of a scene.

#include <render/accel/bvh.h>
#include <render/bsdf/bsdf.h>
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

/// A BSDF of a scene, as SceneBuilder::add names it.
enum class BsdfId : std::uint32_t {};

/// A BSDF, or one that varies, and how much of it is there.
struct Material {
  Bsdf bsdf;                                   ///< where a texture varies it, one of its kind
  std::shared_ptr<const TexturedBsdf> texture; ///< null: it is the same everywhere
  std::shared_ptr<const Mask> mask;            ///< null: all of it is there

  Material(Bsdf b) : bsdf(std::move(b)) {}
  Material(TexturedBsdf t) : bsdf(t.untextured()), texture(std::make_shared<const TexturedBsdf>(std::move(t))) {}
  bool needs_uv() const { return texture || (mask && mask->varies()); }
};

/// A shape with what covers it.
struct Surface {
  std::shared_ptr<const Shape> shape;
  BsdfId bsdf;
  std::optional<std::uint32_t> light;             ///< the light that it is; none: it does not shine
  bool importance_target = false;                 ///< the scene asks strategies that aim at lights to aim at it too
  std::optional<HomogeneousMedium> interior = {}; ///< on the side that its normals do not point to; none on the other
};

/// Surfaces, lights, camera and filter of a picture, and the tables to look them up. Made by SceneBuilder, immutable,
/// so threads share it.
class Scene {
 public:
  /// The nearest surface that a ray meets, and its point there.
  std::optional<Hit> intersect(const Ray& ray) const { return bvh_.intersect(ray); }
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const {
    return surface(hit).shape->surface_point(ray, hit);
  }
  bool occluded(const Ray& ray) const { return bvh_.occluded(ray); }
  /// Of all surfaces; empty where there are none.
  const Bounds& bounds() const { return bvh_.bounds(); }

  std::span<const Surface> surfaces() const { return surfaces_; }
  const Surface& surface(const Hit& hit) const { return surfaces_[static_cast<std::size_t>(hit.shape)]; }
  /// What covers a surface; of a texture only its kind, the rest varies.
  const Bsdf& bsdf(const Surface& surface) const { return material(surface).bsdf; }
  /// What covers it where it was hit, at `point`; made in `bsdf_storage` where a texture varies it.
  const Bsdf& bsdf(const Surface& surface, const Hit& hit, const SurfacePoint& point,
                   std::optional<Bsdf>& bsdf_storage) const {
    const Material& m = material(surface);
    if (!m.texture) [[likely]]
      return m.bsdf;
    return bsdf_storage.emplace(m.texture->at(surface.shape->uv(hit, point)));
  }
  /// Whether rays pass through parts of surfaces; visibility.h follows them.
  bool has_masks() const { return has_masks_; }
  /// How much of a surface is there where it was hit, at `point`, in [0, 1].
  Float opacity(const Hit& hit, const SurfacePoint& point) const {
    const Surface& s = surface(hit);
    const auto& mask = material(s).mask;
    if (!mask) return 1;
    return mask->opacity(mask->varies() ? s.shape->uv(hit, point) : Vec2d::Zero());
  }

  std::span<const Light> lights() const { return lights_; }
  /// Indices of the lights that shine where a ray leaves the scene.
  std::span<const std::uint32_t> infinite_lights() const { return infinite_lights_; }
  /// Whether there are lights to connect to. Then sample_light picks one for the point ref, as LightSampler says.
  bool has_light_sampler() const { return light_sampler_.has_value(); }
  mc::DiscreteSample<Float> sample_light(const Vec3& ref, Float u) const {
    return light_sampler_->sample_index(lights_, ref, u);
  }
  Float light_pmf(const Vec3& ref, std::size_t light) const { return light_sampler_->pmf(lights_, ref, light); }

  const ThinLens& camera() const { return camera_; }
  const Filter& filter() const { return filter_; }

 private:
  friend class SceneBuilder;
  Scene(std::vector<Surface> surfaces, std::vector<Material> materials, std::vector<Light> lights, ThinLens camera,
        Filter filter);
  const Material& material(const Surface& surface) const { return materials_[static_cast<std::size_t>(surface.bsdf)]; }

  std::vector<Surface> surfaces_;
  std::vector<Material> materials_;
  std::vector<Light> lights_;
  std::vector<std::uint32_t> infinite_lights_;
  std::optional<LightSampler> light_sampler_;
  bool has_masks_;
  Bvh bvh_;
  ThinLens camera_;
  Filter filter_;
};

} // namespace render

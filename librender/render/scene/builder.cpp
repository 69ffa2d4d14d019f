#include <render/scene/builder.h>

#include <mc/core/error.h>

#include <algorithm>
#include <utility>

namespace render {

BsdfId SceneBuilder::add(Material material) {
  materials_.push_back(std::move(material));
  return BsdfId(static_cast<std::uint32_t>(materials_.size() - 1));
}

bool SceneBuilder::is_clear(BsdfId material) const {
  const Material& m = materials_[static_cast<std::size_t>(material)];
  return m.is_invisible() || m.bsdf.lobes().transmits || std::holds_alternative<Dielectric>(m.bsdf) ||
         std::holds_alternative<ThinDielectric>(m.bsdf);
}

void SceneBuilder::add(Shape shape, const SurfaceProperties& properties) {
  const auto bsdf = static_cast<std::size_t>(properties.bsdf);
  mc::require(bsdf < materials_.size(), "scene: shape {} names BSDF {} of {}", surfaces_.size(), bsdf,
              materials_.size());
  const bool textured =
      materials_[bsdf].needs_uv() || (properties.emission && properties.emission->texture.has_value());
  mc::require(!textured || shape.has_uv(), "scene: shape {} has no texture coordinates, which its texture needs{}{}",
              surfaces_.size(), properties.missing_uv_reason.empty() ? "" : ": ", properties.missing_uv_reason);
  mc::require(!properties.emission || !materials_[bsdf].is_invisible(),
              "scene: shape {} shines and its BSDF is null, which is not supported; remove one of them",
              surfaces_.size());
  mc::require(!properties.emission || !materials_[bsdf].mask,
              "scene: shape {} shines through a mask, which is not supported; remove one of them", surfaces_.size());
  mc::require(!properties.interior || !materials_[bsdf].mask || materials_[bsdf].is_invisible(),
              "scene: shape {} holds a medium, and a mask has holes that light would leave it by; remove one of them",
              surfaces_.size());
  if (!textured) shape.discard_uvs();
  if (!properties.emission && !properties.importance_target) shape.discard_sampling_table();
  Surface surface{std::make_shared<const Shape>(std::move(shape)),
                  properties.bsdf,
                  {},
                  properties.importance_target,
                  materials_[bsdf].one_sided,
                  properties.interior ? std::make_shared<const HomogeneousMedium>(*properties.interior) : nullptr};
  if (properties.emission) {
    surface.light = static_cast<std::uint32_t>(lights_.size());
    lights_.emplace_back(AreaLight(surface.shape, *properties.emission));
  }
  surfaces_.push_back(std::move(surface));
}

void SceneBuilder::add(Light light) { lights_.push_back(std::move(light)); }

Scene SceneBuilder::build() {
  mc::require(!surfaces_.empty() ||
                  std::any_of(lights_.begin(), lights_.end(), [](const Light& l) { return l.is_infinite(); }),
              "scene: it has neither a shape nor a background; add at least one");
  SceneBuilder parts = std::exchange(*this, SceneBuilder());
  return {std::move(parts.surfaces_),
          std::move(parts.materials_),
          std::move(parts.lights_),
          parts.camera_,
          parts.filter_,
          std::move(parts.ambient_medium_)};
}

} // namespace render

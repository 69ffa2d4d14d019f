#include <render/scene/scene.h>

#include <algorithm>
#include <utility>

namespace render {

Scene::Scene(std::vector<Surface> surfaces, std::vector<Material> materials, std::vector<Light> lights, ThinLens camera,
             Filter filter, std::shared_ptr<const HomogeneousMedium> ambient_medium)
    : surfaces_(std::move(surfaces)), materials_(std::move(materials)), lights_(std::move(lights)),
      ambient_medium_(std::move(ambient_medium)), camera_(std::move(camera)), filter_(std::move(filter)) {
  std::vector<const Shape*> shapes;
  for (const Surface& s : surfaces_) shapes.push_back(s.shape.get());
  bvh_ = Bvh(shapes);
  const auto any_surface = [&](const auto& holds) { return std::any_of(surfaces_.begin(), surfaces_.end(), holds); };
  has_masks_ = any_surface([&](const Surface& s) { return material(s).mask != nullptr; });
  has_media_ = ambient_medium_ || any_surface([](const Surface& s) { return s.interior != nullptr; });
  has_volumes_ = (ambient_medium_ && ambient_medium_->scatters()) || any_surface([&](const Surface& s) {
                   return s.interior && (s.interior->scatters() || material(s).mask);
                 });
  has_filtered_textures_ = any_surface([&](const Surface& s) {
    const auto& texture = material(s).texture;
    return texture && texture->is_filtered();
  });

  const Bounds& bounds = bvh_.bounds();
  const double radius = surfaces_.empty() ? 1.0 : (bounds.hi - bounds.lo).cast<double>().norm() / 2;
  for (std::uint32_t i = 0; i < lights_.size(); ++i)
    if (lights_[i].is_infinite()) infinite_lights_.push_back(i);
  light_sampler_ = LightSampler::create(lights_, radius);
}

} // namespace render

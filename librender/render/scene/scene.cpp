#include <render/scene/scene.h>

#include <algorithm>
#include <utility>

namespace render {

Scene::Scene(std::vector<Surface> surfaces, std::vector<Material> materials, std::vector<Light> lights, ThinLens camera,
             Filter filter)
    : surfaces_(std::move(surfaces)), materials_(std::move(materials)), lights_(std::move(lights)),
      camera_(std::move(camera)), filter_(std::move(filter)) {
  std::vector<const Shape*> shapes;
  for (const Surface& s : surfaces_) shapes.push_back(s.shape.get());
  bvh_ = Bvh(shapes);
  has_masks_ =
      std::any_of(surfaces_.begin(), surfaces_.end(), [&](const Surface& s) { return material(s).mask != nullptr; });

  const Bounds& bounds = bvh_.bounds();
  const double radius = surfaces_.empty() ? 1.0 : (bounds.hi - bounds.lo).cast<double>().norm() / 2;
  for (std::uint32_t i = 0; i < lights_.size(); ++i)
    if (lights_[i].is_infinite()) infinite_lights_.push_back(i);
  light_sampler_ = LightSampler::create(lights_, radius);
}

} // namespace render

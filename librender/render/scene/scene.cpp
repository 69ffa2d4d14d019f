#include <render/scene/scene.h>

#include <algorithm>

namespace render {

Scene::Scene(std::vector<Surface> surfaces, std::vector<Material> materials, std::vector<Light> lights, ThinLens camera,
             Filter filter)
    : surfaces_(std::move(surfaces)), materials_(std::move(materials)), lights_(std::move(lights)), camera_(camera),
      filter_(filter) {
  std::vector<const Shape*> shapes;
  for (const Surface& s : surfaces_) shapes.push_back(s.shape.get());
  bvh_ = Bvh(shapes);

  const Box& bounds = bvh_.bounds();
  const double radius = surfaces_.empty() ? 1.0 : (bounds.hi - bounds.lo).cast<double>().norm() / 2;
  std::vector<double> power;
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    if (lights_[i].is_infinite()) infinite_lights_.push_back(i);
    power.push_back(lights_[i].is_sampled() ? lights_[i].power(radius) : 0.0);
  }
  if (std::any_of(power.begin(), power.end(), [](double p) { return p > 0; })) light_choice_.emplace(power);
}

} // namespace render

#include <render/scene/scene.h>

#include <mc/core/error.h>

#include <algorithm>

namespace render {

int Scene::add(Shape shape, int bsdf, std::optional<AreaLight> light) {
  const int index = static_cast<int>(shapes.size());
  shapes.push_back(std::move(shape));
  shape_bsdf.push_back(bsdf);
  shape_light.push_back(light ? static_cast<int>(lights.size()) : -1);
  if (light) {
    light->shape = index;
    lights.push_back(*light);
  }
  return index;
}

void Scene::prepare() {
  mc::require(!shapes.empty() || background, "scene: it has neither a shape nor a background; add at least one");
  mc::require(shape_bsdf.size() == shapes.size() && shape_light.size() == shapes.size(),
              "scene: every shape needs a BSDF and a light index");
  const auto in = [](int index, std::size_t size) { return index >= 0 && static_cast<std::size_t>(index) < size; };
  for (std::size_t i = 0; i < bsdfs.size(); ++i)
    mc::with_context(fmt::format("scene: BSDF {}", i), [&] { require_valid(bsdfs[i]); });
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    mc::require(in(shape_bsdf[i], bsdfs.size()), "scene: shape {} names BSDF {} of {}", i, shape_bsdf[i], bsdfs.size());
    mc::require(shape_light[i] == -1 || in(shape_light[i], lights.size()), "scene: shape {} names light {} of {}", i,
                shape_light[i], lights.size());
  }
  for (const int guide : guides)
    mc::require(in(guide, shapes.size()), "scene: the guides name shape {} of {}", guide, shapes.size());

  double total = 0;
  std::vector<double> power;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const AreaLight& light = lights[i];
    mc::require((light.radiance >= 0).all() && light.radiance.isFinite().all(),
                "scene: light {} has radiance ({}, {}, {}); it must be finite and >= 0", i, light.radiance[0],
                light.radiance[1], light.radiance[2]);
    mc::require(in(light.shape, shapes.size()), "scene: light {} names shape {} of {}", i, light.shape, shapes.size());
    const double area = shapes[static_cast<std::size_t>(light.shape)].area();
    mc::require(area > 0, "scene: light {} is shape {} of area {}; an emitting shape needs an area > 0", i, light.shape,
                area);
    power.push_back(area * double(luminance(light.radiance)) * (light.two_sided ? 2 : 1));
    total += power.back();
  }
  light_pmf_.clear();
  light_cdf_.clear();
  double below = 0;
  for (const double p : power) {
    const double pmf = total > 0 ? p / total : 1.0 / double(power.size());
    light_pmf_.push_back(Float(pmf));
    light_cdf_.push_back(Float(below += pmf));
  }
  targets_.clear();
  for (const AreaLight& light : lights) targets_.push_back(light.shape);
  targets_.insert(targets_.end(), guides.begin(), guides.end());
  speculars_.clear();
  for (std::size_t i = 0; i < shapes.size() && !lights.empty(); ++i)
    if (std::holds_alternative<Sphere>(shapes[i]) && bsdfs[static_cast<std::size_t>(shape_bsdf[i])].is_delta())
      speculars_.push_back(static_cast<int>(i));
  if (speculars_.size() > most_speculars) speculars_.clear();
  bvh_ = Bvh(shapes);
}

Scene::LightChoice Scene::choose_light(Float uc) const {
  MC_ASSERT(!lights.empty());
  auto i = static_cast<std::size_t>(std::upper_bound(light_cdf_.begin(), light_cdf_.end(), uc) - light_cdf_.begin());
  i = std::min(i, lights.size() - 1);
  while (i > 0 && light_pmf_[i] == 0) --i; // rounding may leave the last sum below uc
  return {static_cast<int>(i), light_pmf_[i]};
}

} // namespace render

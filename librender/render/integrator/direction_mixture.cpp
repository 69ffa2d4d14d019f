#include <render/integrator/direction_mixture.h>

#include <algorithm>

namespace render {

namespace {

constexpr std::size_t max_spheres = 8; // with more spheres aiming costs more than it gains

std::vector<const Shape*> importance_targets(const Scene& scene) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (s.importance_target) found.push_back(s.shape.get());
  return found;
}

std::vector<const Shape*> lights_and_importance_targets(const Scene& scene) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (s.light) found.push_back(s.shape.get());
  for (const Shape* guide : importance_targets(scene)) found.push_back(guide);
  return found;
}

std::vector<const Shape*> specular_spheres(const Scene& scene) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (s.shape->is_spherical() && scene.bsdf(s).lobes().is_delta()) found.push_back(s.shape.get());
  if (found.size() > max_spheres) found.clear();
  return found;
}

// Specular spheres through which a path may hit a light; none if all sampled lights are delta lights.
std::vector<const Shape*> speculars(const Scene& scene) {
  const auto& lights = scene.lights();
  const bool meets =
      std::any_of(lights.begin(), lights.end(), [](const Light& l) { return l.is_sampled() && !l.is_delta(); });
  return meets ? specular_spheres(scene) : std::vector<const Shape*>();
}

std::vector<const Shape*> enclosing_speculars(const Scene& scene) {
  std::vector<const Shape*> found = specular_spheres(scene);
  std::erase_if(found, [&](const Shape* s) { return !contains_area_light(scene, s->bounding_ball()); });
  return found;
}

} // namespace

bool contains_area_light(const Scene& scene, const Ball& ball) {
  const auto& surfaces = scene.surfaces();
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& s) {
    return s.light && s.shape->box().squaredExteriorDistance(ball.center) < mc::sqr(ball.radius);
  });
}

bool finds_all_lights(const Scene& scene, const Strategy& strategy) {
  const auto& lights = scene.lights();
  return strategy.direct_lighting != DirectLighting::bsdf_only ||
         std::none_of(lights.begin(), lights.end(), [](const Light& l) { return l.is_delta(); });
}

bool misses_light(const Scene& scene, const Strategy& strategy, int max_depth) {
  if (strategy.guiding_target != GuidingTarget::lights || strategy.guiding_fraction < 1 ||
      lights_and_importance_targets(scene).empty())
    return false;
  return max_depth < 0 || max_depth > 2 || (max_depth == 2 && !scene.infinite_lights().empty());
}

DirectionMixture::DirectionMixture(const Scene& scene, const Strategy& strategy)
    : guiding_fraction_(strategy.guiding_fraction), uses_bsdf_(strategy.guiding_fraction < 1),
      limited_by_absorption_(strategy.guiding_target == GuidingTarget::speculars ||
                             strategy.guiding_target == GuidingTarget::enclosing_speculars),
      resamples_misses_(strategy.direct_lighting == DirectLighting::bsdf_only) {
  if (strategy.guiding_target == GuidingTarget::lights) target_shapes_ = lights_and_importance_targets(scene);
  if (strategy.guiding_target == GuidingTarget::importance_targets) target_shapes_ = importance_targets(scene);
  if (strategy.guiding_target == GuidingTarget::speculars) target_shapes_ = speculars(scene);
  if (strategy.guiding_target == GuidingTarget::enclosing_speculars) target_shapes_ = enclosing_speculars(scene);
  const std::size_t targets = strategy.guiding_target == GuidingTarget::hemisphere ? 1 : target_shapes_.size();
  if (targets > 0) target_distribution_.emplace(targets);
}

DirectionMixture::DirectionMixture(std::vector<const Shape*> targets, Float guiding_fraction)
    : target_shapes_(std::move(targets)), guiding_fraction_(guiding_fraction), uses_bsdf_(guiding_fraction < 1),
      limited_by_absorption_(false), resamples_misses_(false) {
  if (!target_shapes_.empty()) target_distribution_.emplace(target_shapes_.size());
}

} // namespace render

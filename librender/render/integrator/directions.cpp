#include <render/integrator/directions.h>

#include <algorithm>

namespace render {

namespace {

constexpr std::size_t most_spheres = 8; // aiming at more would not pay

std::vector<const Shape*> guides(const Scene& scene) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (s.guide) found.push_back(s.shape.get());
  return found;
}

std::vector<const Shape*> lights_and_guides(const Scene& scene) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (s.light) found.push_back(s.shape.get());
  for (const Shape* guide : guides(scene)) found.push_back(guide);
  return found;
}

std::vector<const Shape*> specular_spheres(const Scene& scene) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (std::holds_alternative<Sphere>(*s.shape) && scene.bsdf(s).is_delta()) found.push_back(s.shape.get());
  if (found.size() > most_spheres) found.clear();
  return found;
}

// Through which a path may meet a light; nothing meets a delta light.
std::vector<const Shape*> speculars(const Scene& scene) {
  const auto& lights = scene.lights();
  const bool meets =
      std::any_of(lights.begin(), lights.end(), [](const Light& l) { return l.is_sampled() && !l.is_delta(); });
  return meets ? specular_spheres(scene) : std::vector<const Shape*>();
}

std::vector<const Shape*> shades(const Scene& scene) {
  std::vector<const Shape*> found = specular_spheres(scene);
  std::erase_if(found, [&](const Shape* s) { return !holds_a_lamp(scene, std::get<Sphere>(*s)); });
  return found;
}

} // namespace

bool holds_a_lamp(const Scene& scene, const Sphere& sphere) {
  const auto& lights = scene.lights();
  return std::any_of(lights.begin(), lights.end(), [&](const Light& light) {
    const auto* lamp = std::get_if<AreaLight>(&light);
    return lamp && lamp->shape().box().squaredExteriorDistance(sphere.center()) < mc::sqr(sphere.radius());
  });
}

bool finds_all_lights(const Scene& scene, const Strategy& strategy) {
  const auto& lights = scene.lights();
  return strategy.finding != Finding::by_chance ||
         std::none_of(lights.begin(), lights.end(), [](const Light& l) { return l.is_delta(); });
}

bool misses_light(const Scene& scene, const Strategy& strategy, int max_depth) {
  if (strategy.target != Target::lights || strategy.share < 1 || lights_and_guides(scene).empty()) return false;
  return max_depth < 0 || max_depth > 2 || (max_depth == 2 && !scene.infinite_lights().empty());
}

Directions::Directions(const Scene& scene, const Strategy& strategy)
    : share_(strategy.share), follows_(strategy.share < 1),
      spares_(strategy.target == Target::speculars || strategy.target == Target::shades),
      redraws_(strategy.finding == Finding::by_chance) {
  if (strategy.target == Target::lights) shapes_ = lights_and_guides(scene);
  if (strategy.target == Target::guides) shapes_ = guides(scene);
  if (strategy.target == Target::speculars) shapes_ = speculars(scene);
  if (strategy.target == Target::shades) shapes_ = shades(scene);
  const std::size_t targets = strategy.target == Target::hemisphere ? 1 : shapes_.size();
  if (targets > 0) targets_.emplace(targets);
}

Directions::Directions(std::vector<const Shape*> targets, Float share)
    : shapes_(std::move(targets)), share_(share), follows_(share < 1), spares_(false), redraws_(false) {
  if (!shapes_.empty()) targets_.emplace(shapes_.size());
}

} // namespace render

#include <render/integrator/directions.h>

#include <algorithm>

namespace render {

namespace {

constexpr std::size_t most_speculars = 8; // aiming at more would not pay

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

std::vector<const Shape*> speculars(const Scene& scene) {
  std::vector<const Shape*> found;
  const auto& lights = scene.lights();
  const bool can_shine_through = // on a path that meets it; nothing meets a delta light
      std::any_of(lights.begin(), lights.end(), [](const Light& l) { return l.is_sampled() && !l.is_delta(); });
  for (const Surface& s : scene.surfaces())
    if (can_shine_through && std::holds_alternative<Sphere>(*s.shape) && scene.bsdf(s).is_delta())
      found.push_back(s.shape.get());
  if (found.size() > most_speculars) found.clear();
  return found;
}

} // namespace

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
    : aims_(strategy.share), aims_for_delta_(std::min(strategy.share, Float(0.5))), follows_(strategy.share < 1) {
  if (strategy.target == Target::lights) shapes_ = lights_and_guides(scene);
  if (strategy.target == Target::guides) shapes_ = guides(scene);
  if (strategy.target == Target::speculars) shapes_ = speculars(scene);
  const std::size_t targets = strategy.target == Target::hemisphere ? 1 : shapes_.size();
  if (targets > 0) targets_.emplace(targets);
}

} // namespace render

#include <render/integrator/path.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <array>

namespace render {

namespace {
constexpr std::array<std::string_view, 6> names = {"bsdf", "hemisphere", "light", "mixture", "nee", "mis"};
}

Strategy strategy_from(std::string_view word) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == word) return static_cast<Strategy>(i);
  throw mc::Error(fmt::format("unknown strategy '{}'{}; use one of {}", word, mc::did_you_mean(word, names),
                              fmt::join(names, ", ")));
}

std::string_view name(Strategy strategy) { return names[static_cast<std::size_t>(strategy)]; }

namespace detail {

namespace {

constexpr std::size_t most_speculars = 8; // more would not pay

// The shapes of the lights, and the guides.
std::vector<const Shape*> targets(const Scene& scene) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (s.light) found.push_back(s.shape.get());
  for (const Surface& s : scene.surfaces())
    if (s.guide) found.push_back(s.shape.get());
  return found;
}

// Spheres of glass or mirror, which may cast caustics of the lights.
std::vector<const Shape*> speculars(const Scene& scene) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (scene.light_choice() && std::holds_alternative<Sphere>(*s.shape) && scene.bsdf(s).is_delta())
      found.push_back(s.shape.get());
  if (found.size() > most_speculars) found.clear();
  return found;
}

} // namespace

Aim aim_of(const Scene& scene, Strategy strategy) {
  Aim aim;
  switch (strategy) {
  case Strategy::light: aim = {targets(scene), Float(1)}; break;
  case Strategy::mixture: aim = {targets(scene), Float(0.5)}; break;
  case Strategy::mis: aim = {speculars(scene), Float(0.25)}; break;
  default: break;
  }
  if (aim.shapes.empty()) aim.share = 0;
  return aim;
}

} // namespace detail

} // namespace render

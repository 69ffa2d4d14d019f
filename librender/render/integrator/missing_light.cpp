#include <render/integrator/light_tracer.h>
#include <render/integrator/missing_light.h>

#include <algorithm>

namespace render {

std::optional<MissingLight> missing_light(const Scene& scene, const Strategy& strategy, int max_depth) {
  constexpr int min_edges = 3; // camera, rough surface, smooth surface, light
  if (max_depth >= 0 && max_depth < min_edges) return {};
  const auto lights = scene.lights();
  const auto surfaces = scene.surfaces();
  const auto is_smooth = [&](const Surface& s) { return scene.bsdf(s).lobes().is_delta(); };
  const auto light = std::find_if(lights.begin(), lights.end(), [](const Light& l) { return l.is_delta(); });
  const auto smooth = std::find_if(surfaces.begin(), surfaces.end(), is_smooth);
  const bool scatters = scene.has_volumes() || !std::all_of(surfaces.begin(), surfaces.end(), is_smooth);
  if (light == lights.end() || smooth == surfaces.end() || !scatters) return {};
  return MissingLight{static_cast<std::size_t>(light - lights.begin()),
                      static_cast<std::size_t>(smooth - surfaces.begin()),
                      LightTracer::create(scene, strategy, 1).has_value()};
}

} // namespace render

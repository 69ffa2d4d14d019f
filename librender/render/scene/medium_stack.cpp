#include <render/scene/medium_stack.h>

#include <render/scene/visibility.h>

#include <array>

namespace render {

MediumStack initial_media(const Scene& scene, Ray ray) {
  constexpr int most = 256; // largest number of surfaces along the ray
  const HomogeneousMedium* ambient = scene.ambient_medium();
  std::array<const HomogeneousMedium*, 2> left = {ambient, ambient};
  std::size_t found = 0;
  int entered = 0; // media that begin ahead of the origin and do not end yet
  for (int met = 0; met < most && found < left.size(); ++met) {
    const auto hit = scene.intersect(ray);
    if (!hit) break;
    const Surface& surface = scene.surface(*hit);
    const SurfacePoint point = scene.surface_point(ray, *hit);
    const bool leaves = ray.d.dot(point.ng) > 0;
    if (surface.interior && !leaves) ++entered;
    else if (surface.interior && entered > 0) --entered;
    else if (surface.interior) left[found++] = surface.interior.get();
    ray = continue_past(ray, *hit, point);
  }
  return {left[0], left[1], ambient};
}

} // namespace render

#pragma once
/// Rays through surfaces with masks.

#include <render/scene/scene.h>

#include <mc/table/discrete.h>

namespace render {

/// The rest of a ray beyond a hit at `point`.
inline Ray continue_past(const Ray& ray, const Hit& hit, const SurfacePoint& point) {
  Ray rest = point.spawn_ray(ray.d);
  rest.t_max = ray.t_max - Float(hit.t);
  return rest;
}

// Loops over masks are separate functions, since few scenes need them.
namespace detail {

template <class SceneType, class Passes>
[[gnu::noinline]] std::optional<Hit> nearest_hit_with_masks(const SceneType& scene, Ray& ray, std::uint64_t& rays,
                                                            const Passes& passes) {
  for (;;) {
    ++rays;
    const auto hit = scene.intersect(ray);
    if (!hit) return hit;
    const SurfacePoint point = scene.surface_point(ray, *hit);
    const Float opacity = scene.opacity(*hit, point);
    if (opacity == 1 || !passes(opacity)) return hit;
    ray = continue_past(ray, *hit, point);
  }
}

template <class SceneType>
[[gnu::noinline]] Float shadow_transmittance_with_masks(const SceneType& scene, Ray ray,
                                                        const std::optional<SurfacePoint>& end, std::uint64_t& rays) {
  Float share = 1;
  while (share > 0) {
    ++rays;
    const auto hit = scene.intersect(ray);
    if (!hit) return share;
    const SurfacePoint point = scene.surface_point(ray, *hit);
    share *= 1 - scene.opacity(*hit, point);
    const std::optional<Ray> rest = end ? point.spawn_ray_to(*end, ray.d) : continue_past(ray, *hit, point);
    if (!rest) return 0;
    ray = *rest;
  }
  return 0;
}

} // namespace detail

/// The nearest hit that the ray does not pass. `ray` becomes the rest of the ray beyond the last passed surface.
///   passes(opacity) : returns whether the ray passes a surface of this opacity, in [0, 1).
///   rays            : counts the rays traced.
/// A mask affects visibility, not scattering. A passed surface adds no vertex to the path and changes no MIS weight.
template <class SceneType, class Passes>
std::optional<Hit> nearest_hit(const SceneType& scene, Ray& ray, std::uint64_t& rays, const Passes& passes) {
  if (scene.has_masks()) [[unlikely]]
    return detail::nearest_hit_with_masks(scene, ray, rays, passes);
  ++rays;
  return scene.intersect(ray);
}

/// As nearest_hit; the ray passes a surface with probability 1 - opacity.
template <class SceneType, class Stream>
std::optional<Hit> sample_nearest_hit(const SceneType& scene, Ray& ray, Stream& stream, std::uint64_t& rays) {
  return nearest_hit(scene, ray, rays, [&](Float opacity) {
    return opacity == 0 || mc::Bernoulli<Float>(opacity).sample_index(stream.next()).index == 0;
  });
}

/// Share of light that arrives along a ray: the product of 1 - opacity over the surfaces on its way; 0 if one of them
/// is opaque.
///   end : surface point at which the ray ends; none: ray.t_max is the end.
///   rays : counts the rays traced.
template <class SceneType>
Float shadow_transmittance(const SceneType& scene, const Ray& ray, const std::optional<SurfacePoint>& end,
                           std::uint64_t& rays) {
  if (scene.has_masks()) [[unlikely]]
    return detail::shadow_transmittance_with_masks(scene, ray, end, rays);
  ++rays;
  return scene.occluded(ray) ? Float(0) : Float(1);
}

} // namespace render

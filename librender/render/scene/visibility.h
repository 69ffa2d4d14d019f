#pragma once
/// Rays through surfaces with masks, and through media.

#include <render/scene/medium_stack.h>

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

template <class SceneType> bool is_unoccluded(const SceneType& scene, const Ray& ray, std::uint64_t& rays) {
  ++rays;
  return !scene.occluded(ray);
}

// Whether a shadow ray arrives. cross(ray, hit, point) is called for every surface on its way, and returns whether
// light passes that surface.
template <class SceneType, class Cross>
bool arrives_through_masks(const SceneType& scene, Ray ray, const std::optional<SurfacePoint>& end, std::uint64_t& rays,
                           const Cross& cross) {
  for (;;) {
    ++rays;
    const auto hit = scene.intersect(ray);
    if (!hit) return true;
    const SurfacePoint point = scene.surface_point(ray, *hit);
    if (!cross(ray, *hit, point)) return false;
    const std::optional<Ray> rest = end ? point.spawn_ray_to(*end, ray.d) : continue_past(ray, *hit, point);
    if (!rest) return false;
    ray = *rest;
  }
}

template <class SceneType>
[[gnu::noinline]] Float shadow_transmittance_with_masks(const SceneType& scene, const Ray& ray,
                                                        const std::optional<SurfacePoint>& end, std::uint64_t& rays) {
  Float share = 1;
  const auto cross = [&](const Ray&, const Hit& hit, const SurfacePoint& point) {
    share *= 1 - scene.opacity(hit, point);
    return share > 0;
  };
  return arrives_through_masks(scene, ray, end, rays, cross) ? share : Float(0);
}

// As transmittance(). Invisible boundaries of media count as masks.
template <class SceneType>
[[gnu::noinline]] Spectrum transmittance_with_media(const SceneType& scene, const Ray& ray,
                                                    const std::optional<SurfacePoint>& end, Float length,
                                                    MediumStack media, std::uint64_t& rays) {
  Spectrum share = Spectrum::Ones();
  const auto pass_medium = [&](Float distance) {
    if (media.current) share *= media.current->transmittance(distance);
  };
  const auto cross = [&](const Ray& from, const Hit& hit, const SurfacePoint& point) {
    const Float distance = std::min((point.p - from.o).norm(), length); // the ray may have a direction of any length
    pass_medium(distance);
    share *= 1 - scene.opacity(hit, point);
    length -= distance;
    media = media.beyond(scene.surface(hit).interior.get(), from.d.dot(point.ng) < 0);
    return !is_black(share);
  };
  const bool arrives =
      scene.has_masks() ? arrives_through_masks(scene, ray, end, rays, cross) : is_unoccluded(scene, ray, rays);
  if (!arrives) return Spectrum::Zero();
  pass_medium(length);
  return share;
}

// Whether a ray passes a surface, with probability 1 - opacity.
template <class Stream> bool sample_passage(Float opacity, Stream& stream) {
  return opacity == 0 || mc::Bernoulli<Float>(opacity).sample_index(stream.next()).index == 0;
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
  return nearest_hit(scene, ray, rays, [&](Float opacity) { return detail::sample_passage(opacity, stream); });
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
  return detail::is_unoccluded(scene, ray, rays) ? Float(1) : Float(0);
}

/// As shadow_transmittance, times the transmittance of the media on the way, of each colour channel.
///   length : length of the ray on which media act [scene units]; it may be infinite.
///   media  : media at the origin of the ray.
template <class SceneType>
Spectrum transmittance(const SceneType& scene, const Ray& ray, const std::optional<SurfacePoint>& end, Float length,
                       const MediumStack& media, std::uint64_t& rays) {
  if (scene.has_media()) [[unlikely]]
    return detail::transmittance_with_media(scene, ray, end, length, media, rays);
  return Spectrum::Constant(shadow_transmittance(scene, ray, end, rays));
}

/// The end of an edge of a path: a point of scattering in a medium, a hit, or neither if the path leaves the scene.
struct EdgeEnd {
  std::optional<Vec3> scattering; ///< The point at which the current medium scatters the path.
  std::optional<Hit> hit;         ///< The hit of the ray.
};

/// Samples an edge of a path. Masks, media and scattering are sampled so that beta stays an unbiased throughput.
///   ray   : of unit direction; becomes the rest of the ray beyond the last passed surface.
///   from  : origin of the edge, on the line of the ray; the medium begins there.
///   media : becomes the media at the end.
///   beta  : throughput, not black; multiplied by the weight of the edge.
///   rays  : counts the rays traced.
template <class SceneType, class Stream>
[[gnu::noinline]] EdgeEnd sample_edge_in_media(const SceneType& scene, Ray& ray, Vec3 from, MediumStack& media,
                                               Spectrum& beta, Stream& stream, std::uint64_t& rays) {
  for (;;) {
    ++rays;
    const auto hit = scene.intersect(ray);
    const SurfacePoint point = hit ? scene.surface_point(ray, *hit) : SurfacePoint();
    const Float length = hit ? (point.p - from).norm() : mc::infinity<Float>;
    if (media.current && media.current->scatters()) {
      const auto edge = media.current->sample_edge(beta, stream.next2(), length);
      beta *= edge.weight;
      if (edge.distance) return {Vec3(from + *edge.distance * ray.d), {}};
    } else if (media.current) {
      beta *= media.current->transmittance(length);
    }
    if (!hit) return {};
    const Float opacity = scene.opacity(*hit, point);
    if (opacity == 1 || !detail::sample_passage(opacity, stream) || is_black(beta)) return {{}, hit};
    media = media.beyond(scene.surface(*hit).interior.get(), ray.d.dot(point.ng) < 0);
    ray = continue_past(ray, *hit, point);
    from = point.p;
  }
}

} // namespace render

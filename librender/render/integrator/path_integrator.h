#pragma once
/// Path tracing from the camera.

#include <render/film/image.h>
#include <render/integrator/path_steps.h>

namespace render {

/// Settings of a path tracer.
struct PathOptions {
  Strategy strategy = strategy_from("mis"); ///< How paths find light.
  int max_depth = -1;                       ///< Largest number of edges (1: only directly visible light); -1: no limit.
  /// The quantity to render.
  Aov aov = Aov::radiance;
  int branches = 2; ///< Number of branches at the first non-delta vertex.
};

/// Path tracer: estimates the radiance along camera rays as the strategy says. The scene must outlive it. Immutable, so
/// threads can share it.
///   Unsampled lights : lights without is_sampled() are found by hits alone and count fully, in every strategy.
///   Light paths : with a LightTracer, contributions carry MIS weights against light paths, which the caller traces.
///   Caustics    : connections to lights cannot find them. `mis` aims up to a quarter of its directions at spheres of
///                 glass or mirror.
///   Splitting   : a path splits at its first non-delta vertex, by default in two. The path to this vertex and the
///                 direct lighting cost much of the time and contribute little of the variance [ArvoKirk90].
///   Roulette    : from the fourth edge on a path survives with probability min(.99, max(4, g) max(beta) eta_scale).
///                 The factor 4 balances variance against cost. g is the guiding pdf ratio since the last rough vertex.
///                 Without g, paths toward a small lamp would rarely survive: their throughput is as small as the lamp.
/// See docs/methods/path-tracing.md and docs/methods/russian-roulette.md.
template <class SceneType> class PathIntegrator {
 public:
  /// Prepares path tracing of a scene.
  ///   light_tracer : traces light paths of the same scene and must outlive this; null: no light paths.
  PathIntegrator(const SceneType& scene, const PathOptions& options, const LightTracer* light_tracer = nullptr)
      : steps_(scene, options.strategy, options.max_depth, light_tracer), aov_(options.aov),
        branches_(options.branches) {}

  /// Estimates the radiance that arrives along `ray`, or the AOV, with one sample. `rays` counts the rays traced.
  ///   media : media at the origin of the ray.
  template <class Stream>
  Spectrum radiance(const Ray& ray, Stream& stream, std::uint64_t& rays, const MediumStack& media = {}) const;

 private:
  // The shading normal n at the ray's hit as the colour (n + 1) / 2; the radiance of infinite lights if there is no
  // hit.
  template <class Stream> Spectrum normal(Ray ray, Stream& stream, std::uint64_t& rays) const {
    if (const auto hit = steps_.nearest_hit(ray, stream, rays))
      return (steps_.scene().surface(*hit).shape->surface_point(ray, *hit).ns.array() + 1) / 2;
    Spectrum radiance = Spectrum::Zero();
    for (const std::uint32_t light : steps_.scene().infinite_lights())
      radiance += steps_.scene().lights()[light].Le(ray.d, nullptr);
    return radiance;
  }

  // Visibility along one cosine-distributed direction at the ray's hit; 1 if there is no hit.
  template <class Stream> Spectrum ambient_occlusion(Ray ray, Stream& stream, std::uint64_t& rays) const {
    const auto hit = steps_.nearest_hit(ray, stream, rays);
    if (!hit) return Spectrum::Ones();
    const SurfacePoint point = steps_.scene().surface(*hit).shape->surface_point(ray, *hit);
    const auto frame = mc::Frame<Float>::from_z(point.ns.dot(ray.d) < 0 ? point.ns : Vec3(-point.ns));
    const Vec3 d = frame.to_world(mc::CosineHemisphere<Float>{}.sample(stream.next2()));
    if (d.dot(point.ng) * ray.d.dot(point.ng) >= 0) return Spectrum::Zero(); // below the geometric surface
    Ray shadow = point.spawn_ray(d);
    shadow.t_max = Float(aov_.max_distance);
    return Spectrum::Constant(shadow_transmittance(steps_.scene(), shadow, {}, rays));
  }

  PathSteps<SceneType> steps_;
  Aov aov_;
  int branches_;
};

template <class SceneType>
template <class Stream>
Spectrum PathIntegrator<SceneType>::radiance(const Ray& ray, Stream& stream, std::uint64_t& rays,
                                             const MediumStack& media) const {
  if (aov_.kind == Aov::normals) return normal(ray, stream, rays);
  if (aov_.kind == Aov::ambient_occlusion) return ambient_occlusion(ray, stream, rays);
  Spectrum radiance = Spectrum::Zero();
  const auto add_radiance = [&](const RadianceContribution& light) { radiance += light.weighted(); };
  PathState state = steps_.start_path(ray, media);
  typename PathSteps<SceneType>::PathVertex vertex;
  if (!steps_.skip_delta_bounces(state, vertex, stream, rays, add_radiance)) return radiance;
  const auto isect = vertex.interaction(state);
  steps_.sample_direct(isect, state, stream, rays, add_radiance);
  const auto [copies, weight] = mc::split<Float>(Float(branches_), 0);
  Spectrum branches = Spectrum::Zero();
  for (std::uint32_t i = 0; i < copies; ++i) {
    PathState own = state;
    Stream numbers = stream.branch(i, copies);
    Spectrum branch = Spectrum::Zero();
    const auto add_to_branch = [&](const RadianceContribution& light) { branch += light.weighted(); };
    if (steps_.scatter(isect, own, numbers)) steps_.trace_remaining(own, numbers, rays, add_to_branch);
    branches += branch;
  }
  return radiance + branches * weight;
}

} // namespace render

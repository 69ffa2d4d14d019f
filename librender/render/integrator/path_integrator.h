#pragma once
/// Path tracing from the camera, by any of the strategies of the books.

#include <render/film/image.h>
#include <render/integrator/path_steps.h>

namespace render {

struct PathOptions {
  Strategy strategy = strategy_from("mis");
  int max_depth = -1; ///< longest path in edges (1: light seen directly); -1: no limit
  Aov aov = Aov::radiance;
  int branches = 2; ///< ways on from where a path first meets a surface that is not a delta
};

/// Traces paths through a scene, which must outlive it. Immutable, so threads share it.
///   Where LightTracer find light, too, what a path finds counts less, and the rest is theirs to add.
///   Lights that are not sampled (see LightLike) are met by following directions, in every strategy, and count fully.
///   Caustics cannot be reached by connecting to a light. Therefore `mis` aims up to a quarter of its directions at the
///   spheres of glass or mirror, where a scene has any: smallpt's box takes a quarter less time to a given error.
///   A path splits where it first meets a surface that is not a delta, unless told otherwise in two, since two fifths
///   of the time but little of the variance come from the way there and the light straight from the lights: a tenth to
///   a fifth less time to a given error, no less with three or four branches. Source: [ArvoKirk90]
///   Russian roulette: from the fourth edge on a path survives with four times the largest component of its throughput,
///                     corrected for the compression of radiance in glass, at most .99. The factor balances variance
///                     against cost: at one the Cornell box and smallpt's take a third more time to a given error.
///                     Where a direction was aimed, and through glass from there, the factor is how much denser that
///                     is than following the BSDF, if that is more than four: throughput towards a small lamp is as
///                     small as the lamp, and all its light would come on paths that hardly ever survive.
/// Times to a given error are measured as CPU seconds of `carlo render` times the relmse of `carlo compare` between two
/// seeds.
template <class SceneType> class PathIntegrator {
 public:
  /// light_tracer : that find some of the light; null: none are traced. It must outlive this, too
  PathIntegrator(const SceneType& scene, const PathOptions& options, const LightTracer* light_tracer = nullptr)
      : steps_(scene, options.strategy, options.max_depth, light_tracer), aov_(options.aov),
        branches_(options.branches) {}

  /// Radiance that arrives along `ray`, or what else is shown, one sample. `rays` counts the rays traced.
  ///   media : through what the ray starts
  template <class Stream>
  Spectrum radiance(const Ray& ray, Stream& stream, std::uint64_t& rays, const MediumStack& media = {}) const;

 private:
  // The normal of what a ray meets, as a colour.
  template <class Stream> Spectrum normal(Ray ray, Stream& stream, std::uint64_t& rays) const {
    if (const auto hit = steps_.nearest_hit(ray, stream, rays))
      return (steps_.scene().surface(*hit).shape->surface_point(ray, *hit).ns.array() + 1) / 2;
    Spectrum radiance = Spectrum::Zero();
    for (const std::uint32_t light : steps_.scene().infinite_lights())
      radiance += steps_.scene().lights()[light].Le(ray.d, nullptr);
    return radiance;
  }

  // Whether one direction from what a ray meets is open, of those that a uniform sky lights it from.
  template <class Stream> Spectrum ambient_occlusion(Ray ray, Stream& stream, std::uint64_t& rays) const {
    const auto hit = steps_.nearest_hit(ray, stream, rays);
    if (!hit) return Spectrum::Ones();
    const SurfacePoint point = steps_.scene().surface(*hit).shape->surface_point(ray, *hit);
    const auto frame = mc::Frame<Float>::from_z(point.ns.dot(ray.d) < 0 ? point.ns : Vec3(-point.ns));
    const Vec3 d = frame.to_world(mc::CosineHemisphere<Float>{}.sample(stream.next2()));
    if (d.dot(point.ng) * ray.d.dot(point.ng) >= 0) return Spectrum::Zero(); // into the true surface
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

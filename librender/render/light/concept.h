#pragma once
/// Concept of a light: emitted radiance, and samples of directions toward the light.

#include <render/light/emission.h>

#include <optional>

namespace render {

/// A sampled direction from a reference point toward a light.
struct LightSample {
  Vec3 wi;                           ///< Unit direction from the reference point.
  Spectrum radiance;                 ///< Radiance along wi if unoccluded; for a delta light its irradiance across wi.
  Float pdf = 0;                     ///< Density of wi [1/sr]; 1 for a delta light.
  std::optional<SurfacePoint> point; ///< Point of the light; none if it is infinitely far away.
};

/// Lights are a closed set (light.h). `light_point` is the hit of a ray on a light, or null if the ray leaves the
/// scene: infinite lights emit along such rays. A light models:
///   Le(wi, light_point)       : radiance that arrives along wi, a unit vector away from the reference point.
///   sample(ref, u)            : maps u in [0,1)^2 to a direction from ref; nullopt if there is none.
///   pdf(ref, wi, light_point) : density [1/sr] with which sample(ref, .) selects wi by way of `light_point`; 0 for a
///                               delta light.
///   sample_emission(targets, u, v) : maps u and v in [0,1)^2 to the first ray of a light path, aimed at the targets; u
///                               selects the point of the light, or the direction to infinity. nullopt if this ray
///                               carries no light.
///   emission_pdf(targets, ref, wi, light_point) : density with which sample_emission() selects the ray from
///                               `light_point` along -wi, at `ref`. light_point is null for a light without a shape.
///                               Measure: area of the light times solid angle for a shape; area across wi at ref for a
///                               light at a point; solid angle times area across wi for a light at infinity. A
///                               directional light has one direction, which wi must be, with the density 1.
///   power(radius)             : luminous power [W] into a scene within a ball of this radius.
///   irradiance(ref)           : approximate upper bound of the luminous irradiance [W/m^2] at ref; > 0 unless the
///                               light is black.
///   is_delta()                : rays cannot hit it; only sample() finds it.
///   is_infinite()             : it emits along rays that leave the scene.
///   is_sampled()              : sampling it is better than hits, so integrators connect to it.
template <class T>
concept LightLike = requires(const T l, Vec3 ref, Vec3 wi, Vec2 u, const SurfacePoint* light_point, double radius,
                             const EmissionTargets& targets) {
  { l.Le(wi, light_point) } -> std::convertible_to<Spectrum>;
  { l.sample(ref, u) } -> std::same_as<std::optional<LightSample>>;
  { l.pdf(ref, wi, light_point) } -> std::convertible_to<Float>;
  { l.sample_emission(targets, u, u) } -> std::same_as<std::optional<EmissionSample>>;
  { l.emission_pdf(targets, ref, wi, light_point) } -> std::same_as<double>;
  { l.power(radius) } -> std::convertible_to<double>;
  { l.irradiance(ref) } -> std::convertible_to<double>;
  { l.is_delta() } -> std::convertible_to<bool>;
  { l.is_infinite() } -> std::convertible_to<bool>;
  { l.is_sampled() } -> std::convertible_to<bool>;
};

/// The sample_emission() of a light at infinity: a direction as the light samples it, and a place across it.
template <class L>
std::optional<EmissionSample> sample_infinite_emission(const L& light, const EmissionTargets& targets, const Vec2& u,
                                                       const Vec2& v) {
  const auto s = light.sample(Vec3::Zero(), u);
  if (!s) return {};
  return targets.sample_parallel(s->wi, s->radiance, double(s->pdf), v);
}

} // namespace render

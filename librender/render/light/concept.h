#pragma once
/// What a light gives: radiance where it is met, and samples of the directions towards it.

#include <render/shape/concept.h>

#include <optional>

namespace render {

/// A direction from a reference point towards a light.
struct LightSample {
  Vec3 wi;           ///< unit direction from the reference point
  Spectrum radiance; ///< arrives along it where nothing stands between; of a delta light: its irradiance across wi
  Float pdf = 0;     ///< density of wi [1/sr]; of a delta light 1
  std::optional<SurfacePoint> point; ///< the light's point; none: it is infinitely far away
};

/// Lights are a closed set (light.h). What a ray meets is a point of a surface, or nothing (null): lights at infinity
/// shine where nothing is met. Each models:
///   emitted(wi, met)   : radiance that arrives along wi (unit, leaving the reference point) from what was met
///   sample(ref, u)     : u in [0,1)^2 -> a direction from ref; nullopt where none can be found
///   pdf(ref, wi, met)  : density [1/sr] with which sample(ref, .) picks wi, as far as it is due to what was met; 0 for
///                        a delta light
///   power(radius)      : luminous power [W] into a scene that a ball of this radius holds
///   irradiance(ref)    : about the most luminous irradiance [W/m^2] that it can cause at ref, > 0 unless it is dark
///   is_delta()         : no ray can meet it, only sample() finds it
///   is_infinite()      : it shines where a ray leaves the scene
///   is_sampled()       : sampling it beats meeting it by chance, so integrators connect to it
template <class T>
concept LightLike = requires(const T l, Vec3 ref, Vec3 wi, Vec2 u, const SurfacePoint* light_point, double radius) {
  { l.Le(wi, light_point) } -> std::convertible_to<Spectrum>;
  { l.sample(ref, u) } -> std::same_as<std::optional<LightSample>>;
  { l.pdf(ref, wi, light_point) } -> std::convertible_to<Float>;
  { l.power(radius) } -> std::convertible_to<double>;
  { l.irradiance(ref) } -> std::convertible_to<double>;
  { l.is_delta() } -> std::convertible_to<bool>;
  { l.is_infinite() } -> std::convertible_to<bool>;
  { l.is_sampled() } -> std::convertible_to<bool>;
};

} // namespace render

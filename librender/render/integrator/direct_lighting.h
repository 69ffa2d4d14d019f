#pragma once
/// Next-event estimation: connections of a path vertex to the lights.

#include <render/integrator/interaction.h>
#include <render/scene/visibility.h>

#include <mc/estimate/mis.h>

namespace render {

/// A connection of a vertex to a light.
struct LightConnection {
  Spectrum value;      ///< Radiance that leaves the vertex toward the path, times mis_weight over the density.
  Float mis_weight;    ///< MIS weight against directions of the BSDF that hit the light; 1 for a delta light.
  Float pdf;           ///< Density of the connection [1/sr].
  std::uint32_t index; ///< Index of the light.
  LightSample sample;  ///< Direction, and point of the light.
};

/// Connects a vertex to a point of one light, which the scene's light sampler selects; the scene must have one. Returns
/// nothing if no light arrives.
///   mixture : direction sampling of the path, for the MIS weight.
///   rays    : counts the rays traced.
template <class SceneType, class B, class Stream>
RENDER_FLAT std::optional<LightConnection>
connect_to_light(const SceneType& scene, DirectLighting direct_lighting, const DirectionMixture& mixture,
                 const Interaction<B>& isect, Stream& stream, std::uint64_t& rays) {
  const Vec2 u = stream.next2(); // u[0] also selects the light, so that the selection is stratified
  const auto choice = scene.sample_light(isect.point.p, u[0]);
  const Light& source = scene.lights()[choice.index];
  if (isect.bsdf.lobes().is_near_specular() && !source.is_delta()) return {};
  const auto s = source.sample(isect.point.p, {choice.u_remapped, u[1]});
  if (!s || is_black(s->radiance)) return {};
  const Vec3 wi = isect.frame.to_local(s->wi);
  const Spectrum f_cos = isect.f_cos(wi);
  if (is_black(f_cos)) return {};
  const std::optional<Ray> ray = s->point ? isect.point.spawn_ray_to(*s->point, s->wi) : isect.point.spawn_ray(s->wi);
  if (!ray) return {};
  const Float length = s->point ? (s->point->p - isect.point.p).norm() : mc::infinity<Float>;
  const Spectrum arriving = s->radiance * transmittance(scene, *ray, s->point, length, isect.media(s->wi), rays);
  if (is_black(arriving)) return {};
  const Float pdf = choice.pmf * s->pdf;
  const bool is_shared = direct_lighting == DirectLighting::mis && !source.is_delta();
  const Float weight = is_shared ? mc::power_heuristic(pdf, mixture.pdf(isect, wi, s->wi)) : Float(1);
  return LightConnection{f_cos * arriving * (weight / pdf), weight, pdf, static_cast<std::uint32_t>(choice.index), *s};
}

} // namespace render

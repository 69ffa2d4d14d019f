#pragma once
/// The closed set of lights.

#include <render/core/dispatch.h>
#include <render/light/area.h>
#include <render/light/background.h>
#include <render/light/delta.h>
#include <render/light/environment.h>
#include <render/light/spot.h>

namespace render {

/// Any of the lights; itself models LightLike.
struct Light : std::variant<AreaLight, ConstantBackground, GradientBackground, Environment, PointLight,
                            DirectionalLight, SpotLight> {
  using variant::variant;

  Spectrum Le(const Vec3& wi, const SurfacePoint* light_point) const {
    return dispatch(*this, [&](const auto& l) { return l.Le(wi, light_point); });
  }
  std::optional<LightSample> sample(const Vec3& ref, const Vec2& u) const {
    return dispatch(*this, [&](const auto& l) { return l.sample(ref, u); });
  }
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint* light_point) const {
    return dispatch(*this, [&](const auto& l) { return l.pdf(ref, wi, light_point); });
  }
  std::optional<EmissionSample> sample_emission(const EmissionTargets& targets, const Vec2& u, const Vec2& v) const {
    return dispatch(*this, [&](const auto& l) { return l.sample_emission(targets, u, v); });
  }
  double emission_pdf(const EmissionTargets& targets, const Vec3& ref, const Vec3& wi,
                      const SurfacePoint* light_point) const {
    return dispatch(*this, [&](const auto& l) { return l.emission_pdf(targets, ref, wi, light_point); });
  }
  /// Luminous power [W] into a ball of this radius.
  double power(double radius) const {
    return dispatch(*this, [&](const auto& l) { return l.power(radius); });
  }
  double irradiance(const Vec3& ref) const {
    return dispatch(*this, [&](const auto& l) { return l.irradiance(ref); });
  }
  bool is_delta() const {
    return dispatch(*this, [](const auto& l) { return l.is_delta(); });
  }
  bool is_infinite() const {
    return dispatch(*this, [](const auto& l) { return l.is_infinite(); });
  }
  bool is_sampled() const {
    return dispatch(*this, [](const auto& l) { return l.is_sampled(); });
  }
};

} // namespace render

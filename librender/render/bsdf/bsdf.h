#pragma once
/// The closed set of BSDFs.

#include <render/bsdf/dielectric.h>
#include <render/bsdf/lambert.h>
#include <render/bsdf/metal.h>
#include <render/bsdf/rough_conductor.h>
#include <render/bsdf/rough_dielectric.h>
#include <render/bsdf/rough_plastic.h>
#include <render/core/dispatch.h>

namespace render {

/// One of the BSDFs; itself models BsdfLike.
struct Bsdf : std::variant<Lambert, Metal, Dielectric, RoughPlastic<LayeredBase>, RoughPlastic<LajollaBase>,
                           RoughDielectric, RoughConductor<Microfacets>, RoughConductor<BlinnPhongFacets>> {
  using variant::variant;

  std::optional<BsdfSample> sample(const Vec3& wo, Float uc, const Vec2& u) const {
    return dispatch(*this, [&](const auto& b) { return b.sample(wo, uc, u); });
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const {
    return dispatch(*this, [&](const auto& b) { return b.eval(wo, wi); });
  }
  Float pdf(const Vec3& wo, const Vec3& wi) const {
    return dispatch(*this, [&](const auto& b) { return b.pdf(wo, wi); });
  }
  Float eta(const Vec3& wo, const Vec3& wi) const {
    return dispatch(*this, [&](const auto& b) { return b.eta(wo, wi); });
  }
  Float albedo(const Vec3& wo) const {
    return dispatch(*this, [&](const auto& b) { return b.albedo(wo); });
  }
  bool is_delta() const {
    return dispatch(*this, [](const auto& b) { return b.is_delta(); });
  }
  bool is_narrow() const {
    return dispatch(*this, [](const auto& b) { return b.is_narrow(); });
  }
  bool has_delta() const {
    return dispatch(*this, [](const auto& b) { return b.has_delta(); });
  }
  bool transmits() const {
    return dispatch(*this, [](const auto& b) { return b.transmits(); });
  }
  /// It looks the same from everywhere on one side.
  bool is_diffuse() const { return std::holds_alternative<Lambert>(*this); }
  bool casts_caustics() const {
    return dispatch(*this, [](const auto& b) { return b.casts_caustics(); });
  }
};

} // namespace render

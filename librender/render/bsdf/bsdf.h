#pragma once
/// The closed set of BSDFs.

#include <render/bsdf/dielectric.h>
#include <render/bsdf/lambert.h>
#include <render/bsdf/metal.h>
#include <render/core/dispatch.h>

#include <mc/core/error.h>

namespace render {

/// One of the BSDFs; itself models BsdfLike.
struct Bsdf : std::variant<Lambert, Metal, Dielectric> {
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
  bool is_delta() const {
    return dispatch(*this, [](const auto& b) { return b.is_delta(); });
  }
};

/// Throws Error where a parameter is out of its range.
inline void require_valid(const Bsdf& bsdf) {
  const auto color = [](std::string_view what, const Spectrum& s) {
    mc::require((s >= 0).all() && s.isFinite().all(), "{} ({}, {}, {}) must be finite and >= 0", what, s[0], s[1],
                s[2]);
  };
  if (const auto* lambert = std::get_if<Lambert>(&bsdf)) color("albedo", lambert->albedo);
  if (const auto* metal = std::get_if<Metal>(&bsdf)) {
    color("albedo", metal->albedo);
    mc::require(metal->fuzz >= 0 && metal->fuzz <= 1, "fuzz {} must lie in [0, 1]", metal->fuzz);
  }
  if (const auto* glass = std::get_if<Dielectric>(&bsdf)) {
    color("reflectance", glass->reflectance);
    color("transmittance", glass->transmittance);
    mc::require(glass->eta > 0 && std::isfinite(glass->eta), "relative index {} must be finite and > 0", glass->eta);
  }
}

} // namespace render

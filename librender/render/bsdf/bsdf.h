#pragma once
/// The closed set of BSDFs.

#include <render/bsdf/dielectric.h>
#include <render/bsdf/fuzzy_metal.h>
#include <render/bsdf/lambert.h>
#include <render/bsdf/phase_function.h>
#include <render/bsdf/rough_conductor.h>
#include <render/bsdf/rough_dielectric.h>
#include <render/bsdf/rough_plastic.h>
#include <render/bsdf/smooth_conductor.h>
#include <render/bsdf/smooth_plastic.h>
#include <render/bsdf/thin_dielectric.h>
#include <render/core/dispatch.h>

namespace render {

/// Any of the BSDFs; itself models BsdfLike. sample(), whose result is large, and lobes() are in line. The others are
/// compiled once: a call costs little beside its computation.
struct Bsdf : std::variant<Lambert, FuzzyMetal, Dielectric, RoughPlastic<LayeredBase>, RoughPlastic<LajollaBase>,
                           RoughDielectric<>, RoughConductor<TrowbridgeReitzFacets>, RoughConductor<BlinnPhongFacets>,
                           SmoothPlastic<LayeredBase>, SmoothPlastic<LajollaBase>, SmoothConductor,
                           RoughPlastic<LayeredBase, BeckmannFacets>, RoughDielectric<BeckmannFacets>,
                           RoughConductor<BeckmannFacets>, ThinDielectric, PhaseFunction> {
  using variant::variant;

  std::optional<BsdfSample> sample(const Vec3& wo, Float uc, const Vec2& u) const {
    return dispatch(*this, [&](const auto& b) { return b.sample(wo, uc, u); });
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const;
  Float pdf(const Vec3& wo, const Vec3& wi) const;
  Float eta(const Vec3& wo, const Vec3& wi) const;
  Float albedo(const Vec3& wo) const;
  Lobes lobes() const {
    return dispatch(*this, [](const auto& b) { return b.lobes(); });
  }
};

} // namespace render

#pragma once
/// What rough plastic and rough glass share: facets of the Trowbridge-Reitz (GGX) distribution.

#include <render/bsdf/dielectric.h>

#include <mc/warp/trowbridge_reitz.h>

namespace render {

/// alpha itself, for initialisers. Throws Error naming `what` unless it lies in [1e-4, 1].
inline Float checked_alpha(std::string_view what, Float alpha) {
  mc::require(alpha >= Float(1e-4) && alpha <= 1, "{} {} must lie in [0.0001, 1]", what, alpha);
  return alpha;
}

/// Facets of roughness alpha. Shadowing and masking are separable: G = G1(wo) G1(wi). Source: [WalterEtAl07]
class Microfacets {
 public:
  explicit Microfacets(Float alpha) : surface_(alpha, alpha) {}

  Float alpha() const { return surface_.alpha_x; }
  Float d(const Vec3& m) const { return surface_.d(m); }
  /// G1(w) / |cos w|: finite at the horizon too.
  Float g1_over_cos(const Vec3& w) const { return 2 / (std::abs(w.z()) + surface_.stretch(w).norm()); }
  /// Normals seen from wo, which lies above the surface.
  mc::TrowbridgeReitzVisibleNormals<Float> seen_from(const Vec3& wo) const {
    return {wo.normalized(), surface_.alpha_x}; // rotations leave lengths a few ulps off, which the warp refuses
  }

 private:
  mc::TrowbridgeReitzSurface<Float> surface_;
};

} // namespace render

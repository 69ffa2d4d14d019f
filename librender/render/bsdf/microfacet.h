#pragma once
/// What rough surfaces share: facets, and how they hide each other.

#include <render/bsdf/dielectric.h>

#include <mc/warp/blinn_phong.h>
#include <mc/warp/trowbridge_reitz.h>

namespace render {

/// The roughness of facets itself, for their initialisers.
///   throws : Error unless it lies in [1e-4, 1]
inline Float checked_alpha(Float alpha) {
  mc::require(alpha >= Float(1e-4) && alpha <= 1, "facets: alpha {} must lie in [0.0001, 1]", alpha);
  return alpha;
}

/// Lobes of a smaller alpha are narrow: they fill less than about 1e-6 sr, the sun 7e-5 sr.
inline constexpr Float near_specular_alpha = Float(2e-4);

/// w as it is seen with wo above the surface, and back.
inline Vec3 to_upper_side(const Vec3& w, const Vec3& wo) { return wo.z() < 0 ? Vec3(w.x(), w.y(), -w.z()) : w; }

/// The unit vector nearest to w, whose length is 1 but for rounding: of its height and its part along the surface the
/// smaller stays and gives the larger.
inline Vec3d unit_in_double(const Vec3& w) {
  Vec3d v = w.cast<double>();
  const double height2 = v.z() * v.z(), flat2 = v.x() * v.x() + v.y() * v.y();
  if (height2 > flat2) v.z() = std::copysign(std::sqrt(1 - flat2), v.z());
  else v.head<2>() *= std::sqrt((1 - height2) / flat2);
  return v;
}

/// The normal of the facet that mirrors o to i. What nearly cancels, as at grazing angles, leaves a small difference:
/// it is taken in double, of lengths that are 1 in double.
inline Vec3 half_vector(const Vec3& o, const Vec3& i) {
  const Vec3 sum = o + i;
  if (sum.squaredNorm() > Float(0.25)) [[likely]]
    return sum.normalized();
  return (unit_in_double(o) + unit_in_double(i)).normalized().cast<Float>();
}

/// Directions of one side as they are seen from above it, and the normal that mirrors one to the other.
struct Reflection {
  Vec3 wo, wi, m;

  /// m is of the two directions alone, so that everyone who knows them has the same.
  Reflection(const Vec3& o, const Vec3& i) : wo(o), wi(i), m(half_vector(o, i)) {}
};
/// None where wo and wi lie on different sides.
inline std::optional<Reflection> reflection(const Vec3& wo, const Vec3& wi) {
  if (!(wo.z() * wi.z() > 0)) return {};
  return Reflection(to_upper_side(wo, wo), to_upper_side(wi, wo));
}

/// Facets of the Trowbridge-Reitz (GGX) distribution of roughness alpha. Shadowing and masking are separable:
/// G = G1(wo) G1(wi).
///   throws : Error unless alpha is a checked_alpha
///   Source : [WalterEtAl07]
class TrowbridgeReitzFacets {
 public:
  explicit TrowbridgeReitzFacets(Float alpha) : surface_(checked_alpha(alpha), alpha) {}

  Float alpha() const { return surface_.alpha_x; }
  Float d(const Vec3& m) const { return surface_.d(m); }
  /// G1(w) / |cos w|: finite at the horizon too.
  Float g1_over_cos(const Vec3& w) const { return 2 / (std::abs(w.z()) + surface_.stretch(w).norm()); }
  /// D G / |cos wo cos wi| of facets with the normal m.
  Float dg_over_cosines(const Vec3& wo, const Vec3& wi, const Vec3& m) const {
    return d(m) * g1_over_cos(wo) * g1_over_cos(wi);
  }
  /// Normals seen from wo, which lies above the surface.
  mc::TrowbridgeReitzVisibleNormals<Float> visible_normals(const Vec3& wo) const {
    return {wo.normalized(), surface_.alpha_x}; // rotations leave lengths a few ulps off, which the warp refuses
  }

 private:
  mc::TrowbridgeReitzSurface<Float> surface_;
};

/// Facets of Blinn-Phong's distribution D(m) = (n + 2) / (2 pi) cos^n, of which the integral of D cos is 1. They are
/// the sides of V-shaped grooves: G = min(1, 2 cos m cos wo / wo.m, 2 cos m cos wi / wo.m).
///   n      : 2 / alpha^2 - 2, so that small slopes are distributed as Beckmann's of roughness alpha [WalterEtAl07]
///   throws : Error unless alpha is a checked_alpha
///   Source : [Blinn77]
class BlinnPhongFacets {
 public:
  explicit BlinnPhongFacets(Float alpha) : alpha_(checked_alpha(alpha)), normals_(2 / (alpha * alpha) - 1) {}

  Float alpha() const { return alpha_; }
  Float d(const Vec3& m) const { return normals_.pdf(m) / m.z(); }
  /// D G / |cos wo cos wi| of facets with the normal m, which bisects wo and wi, both above the surface.
  Float dg_over_cosines(const Vec3& wo, const Vec3& wi, const Vec3& m) const {
    const Float groove = 2 * m.z() / wo.dot(m);
    return d(m) * std::min({1 / (wo.z() * wi.z()), groove / wi.z(), groove / wo.z()});
  }
  /// All normals, by D cos, of those who are looked at from wo.
  struct ReflectedNormals {
    mc::BlinnPhong<Float> normals;
    Vec3 wo;
    Vec3 sample(const Vec2& u) const { return normals.sample(u); }
    /// Density of the direction that wo is mirrored to; 0 for a normal that faces away.
    Float pdf_reflected(const Vec3& m) const {
      const Float cosine = wo.dot(m);
      return cosine > 0 ? normals.pdf(m) / (4 * cosine) : Float(0);
    }
  };
  ReflectedNormals visible_normals(const Vec3& wo) const { return {normals_, wo}; }

 private:
  Float alpha_;
  mc::BlinnPhong<Float> normals_; ///< of density D cos
};

} // namespace render

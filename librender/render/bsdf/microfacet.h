#pragma once
/// Microfacet distributions with shadowing and masking.

#include <render/bsdf/dielectric.h>

#include <mc/warp/beckmann.h>
#include <mc/warp/blinn_phong.h>
#include <mc/warp/trowbridge_reitz.h>

namespace render {

/// Smallest supported roughness of facets.
inline constexpr Float least_alpha = Float(1e-4);

/// Returns the roughness `alpha` if it is in the supported range.
///   throws : Error unless alpha lies in [1e-4, 1].
inline Float checked_alpha(Float alpha) {
  mc::require(alpha >= least_alpha && alpha <= 1, "facets: alpha {} must lie in [0.0001, 1]", alpha);
  return alpha;
}

/// w in the frame in which wo is above the surface. The map is its own inverse.
inline Vec3 to_upper_side(const Vec3& w, const Vec3& wo) { return wo.z() < 0 ? Vec3(w.x(), w.y(), -w.z()) : w; }

/// Normalises, in double, a vector of length 1 up to rounding. The smaller of its height and its tangential length is
/// kept exactly, and the other follows from it.
inline Vec3d unit_in_double(const Vec3& w) {
  Vec3d v = w.cast<double>();
  const double height2 = v.z() * v.z(), flat2 = v.x() * v.x() + v.y() * v.y();
  if (height2 > flat2) v.z() = std::copysign(std::sqrt(1 - flat2), v.z());
  else v.head<2>() *= std::sqrt((1 - height2) / flat2);
  return v;
}

/// Normal of the facet that mirrors o to i: the normalised sum. At grazing angles the sum nearly cancels. It is then
/// computed in double from vectors of length 1 in double.
inline Vec3 half_vector(const Vec3& o, const Vec3& i) {
  const Vec3 sum = o + i;
  if (sum.squaredNorm() > Float(0.25)) [[likely]]
    return sum.normalized();
  return (unit_in_double(o) + unit_in_double(i)).normalized().cast<Float>();
}

/// Two directions above the surface and the half vector m that mirrors one to the other.
struct Reflection {
  Vec3 wo, ///< Direction toward the viewer.
      wi,  ///< Direction toward the light.
      m;   ///< Half vector.

  /// m depends on both directions alone, so that sample, eval and pdf use the same half vector.
  Reflection(const Vec3& o, const Vec3& i) : wo(o), wi(i), m(half_vector(o, i)) {}
};
/// The reflection of wo to wi in the frame in which both are above the surface; none if they are on different sides.
inline std::optional<Reflection> reflection(const Vec3& wo, const Vec3& wi) {
  if (!(wo.z() * wi.z() > 0)) return {};
  return Reflection(to_upper_side(wo, wo), to_upper_side(wi, wo));
}

/// Facets of the Trowbridge-Reitz (GGX) distribution of roughness alpha, with separable shadowing and masking: G =
/// G1(wo) G1(wi).
///   throws : Error unless alpha is a checked_alpha.
///   Source : [WalterEtAl07].
class TrowbridgeReitzFacets {
 public:
  /// Facets of roughness alpha.
  explicit TrowbridgeReitzFacets(Float alpha) : surface_(checked_alpha(alpha), alpha) {}

  /// Roughness.
  Float alpha() const { return surface_.alpha_x; }
  /// Density of facet area D(m) [1/sr].
  Float d(const Vec3& m) const { return surface_.d(m); }
  /// G1(w) / |cos w|; finite at the horizon, too.
  Float g1_over_cos(const Vec3& w) const { return 2 / (std::abs(w.z()) + surface_.stretch(w).norm()); }
  /// D G / |cos wo cos wi| for the facet normal m.
  Float dg_over_cosines(const Vec3& wo, const Vec3& wi, const Vec3& m) const {
    return d(m) * g1_over_cos(wo) * g1_over_cos(wi);
  }
  /// Distribution of the normals visible from wo, which lies above the surface.
  mc::TrowbridgeReitzVisibleNormals<Float> visible_normals(const Vec3& wo) const {
    // rotations change lengths by a few ulps, and the warp requires unit vectors
    return {wo.normalized(), surface_.alpha_x};
  }

 private:
  mc::TrowbridgeReitzSurface<Float> surface_;
};

/// Facets of Beckmann's distribution of roughness alpha: Gaussian slopes. The shadowing and masking are separable, with
/// the exact G1 of such a surface.
///   throws : Error unless alpha is a checked_alpha.
///   Source : [WalterEtAl07], without its rational approximation of G1.
class BeckmannFacets {
 public:
  /// Facets of roughness alpha.
  explicit BeckmannFacets(Float alpha) : alpha_(checked_alpha(alpha)), normals_(alpha) {}

  /// Roughness.
  Float alpha() const { return alpha_; }
  /// Density of facet area D(m) [1/sr].
  Float d(const Vec3& m) const { return normals_.pdf(m) / m.z(); }
  /// G1(w) / |cos w|; finite at the horizon, too.
  Float g1_over_cos(const Vec3& w) const { return 1 / visible_normals({w.x(), w.y(), std::abs(w.z())}).area(); }
  /// D G / |cos wo cos wi| for the facet normal m.
  Float dg_over_cosines(const Vec3& wo, const Vec3& wi, const Vec3& m) const {
    return d(m) * g1_over_cos(wo) * g1_over_cos(wi);
  }
  /// Distribution of the normals visible from wo, which lies above the surface.
  mc::BeckmannVisibleNormals<Float> visible_normals(const Vec3& wo) const { return {wo.normalized(), alpha_}; }

 private:
  Float alpha_;
  mc::BeckmannNormals<Float> normals_;
};

/// Facets of the Blinn-Phong distribution D(m) = (n + 2) / (2 pi) cos^n, normalised so that the integral of D cos is 1.
/// The facets are the sides of V-shaped grooves: G = min(1, 2 cos m cos wo / wo.m, 2 cos m cos wi / wo.m).
///   n      : 2 / alpha^2 - 2, so that small slopes are distributed as with Beckmann's roughness alpha [WalterEtAl07].
///   throws : Error unless alpha is a checked_alpha.
///   Source : [Blinn77].
class BlinnPhongFacets {
 public:
  /// Facets of roughness alpha.
  explicit BlinnPhongFacets(Float alpha) : alpha_(checked_alpha(alpha)), normals_(2 / (alpha * alpha) - 1) {}

  /// Roughness.
  Float alpha() const { return alpha_; }
  /// Density of facet area D(m) [1/sr].
  Float d(const Vec3& m) const { return normals_.pdf(m) / m.z(); }
  /// D G / |cos wo cos wi| for the facet normal m, which bisects wo and wi. Both directions lie above the surface.
  Float dg_over_cosines(const Vec3& wo, const Vec3& wi, const Vec3& m) const {
    const Float groove = 2 * m.z() / wo.dot(m);
    return d(m) * std::min({1 / (wo.z() * wi.z()), groove / wi.z(), groove / wo.z()});
  }
  /// Distribution D cos of all normals, with the density of mirrored directions.
  struct ReflectedNormals {
    mc::BlinnPhong<Float> normals; ///< Distribution of the normals.
    Vec3 wo;                       ///< Direction that is mirrored.
    /// Samples a normal.
    Vec3 sample(const Vec2& u) const { return normals.sample(u); }
    /// Density [1/sr] of the direction to which m mirrors wo; 0 if m faces away from wo.
    Float pdf_reflected(const Vec3& m) const {
      const Float cosine = wo.dot(m);
      return cosine > 0 ? normals.pdf(m) / (4 * cosine) : Float(0);
    }
  };
  /// Distribution of normals for wo.
  ReflectedNormals visible_normals(const Vec3& wo) const { return {normals_, wo}; }

 private:
  Float alpha_;
  mc::BlinnPhong<Float> normals_; ///< Density D cos.
};

} // namespace render

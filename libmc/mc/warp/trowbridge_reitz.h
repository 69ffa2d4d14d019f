#pragma once
/// Normals of the Trowbridge-Reitz (GGX) microsurface: all normals, and the normals visible from a direction.

#include <mc/core/dot.h>
#include <mc/core/error.h>
#include <mc/core/turns.h>
#include <mc/warp/concept.h>
#include <mc/warp/hemisphere.h>

namespace mc {

/// The microsurface as a unit sphere stretched by diag(alpha_x, alpha_y, 1).
///   throws : Error unless both roughnesses lie in [1e-6, 1e3].
template <Real S> struct TrowbridgeReitzSurface {
  S alpha_x = 1,   ///< Roughness along x.
      alpha_y = 1; ///< Roughness along y.

  /// A surface of roughness ax along x and ay along y.
  TrowbridgeReitzSurface(S ax, S ay) : alpha_x(ax), alpha_y(ay) {
    require(ax >= S(1e-6) && ax <= S(1e3) && ay >= S(1e-6) && ay <= S(1e3),
            "TrowbridgeReitz: alpha_x = {}, alpha_y = {}: both must lie in [1e-6, 1000]", static_cast<double>(ax),
            static_cast<double>(ay));
  }
  /// (alpha_x x, alpha_y y, z).
  Vec3<S> stretch(const Vec3<S>& v) const { return {alpha_x * v.x(), alpha_y * v.y(), v.z()}; }
  /// Inverse of stretch.
  Vec3<S> unstretch(const Vec3<S>& v) const { return {v.x() / alpha_x, v.y() / alpha_y, v.z()}; }

  /// Density of normals D(m) [1/sr], relative error 8 eps. It uses the components of m, each with its relative
  /// precision, and never 1 - z^2. A float normal therefore suffices at alpha = 1e-4.
  S d(const Vec3<S>& m) const {
    const S q = unstretch(m).squaredNorm();
    return 1 / (pi<S> * (alpha_x * q) * (alpha_y * q));
  }
};

/// All normals with density D(m) m_z: directions of a cosine hemisphere, stretched.
///   sample : cosine-distributed h, then m = normalized (alpha_x h_x, alpha_y h_y, h_z), within 16 eps.
///   pdf    : D(m) m_z [1/sr], relative error 16 eps; 0 below the horizon.
///   invert : |invert(sample(u)) - u| <= 16 eps.
///   throws : Error unless both roughnesses lie in [1e-6, 1e3].
///   Source : [WalterEtAl07]; the stretched sphere from [Heitz18].
template <Real S> class TrowbridgeReitzNormals {
 public:
  using Scalar = S;
  using Domain = Hemisphere<S>;

  /// Normals of an isotropic surface of roughness alpha.
  explicit TrowbridgeReitzNormals(S alpha) : surface_(alpha, alpha) {}
  /// Normals of a surface of roughness alpha_x along x and alpha_y along y.
  TrowbridgeReitzNormals(S alpha_x, S alpha_y) : surface_(alpha_x, alpha_y) {}

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const { return surface_.stretch(CosineHemisphere<S>{}.sample(u)).normalized(); }
  S pdf(const Vec3<S>& m) const { return m.z() > 0 ? S(surface_.d(m) * m.z()) : S(0); }
  Vec2<S> invert(const Vec3<S>& m) const { return CosineHemisphere<S>{}.invert(surface_.unstretch(m).normalized()); }
  template <Real T> TrowbridgeReitzNormals<T> cast() const { return {T(surface_.alpha_x), T(surface_.alpha_y)}; }

 private:
  TrowbridgeReitzSurface<S> surface_;
};

/// Normals visible from wo, with density D(m) max(wo.m, 0) G1(wo) / wo_z.
///   sample : w is the stretched and normalized wo. Its reflections off a sphere cover a spherical cap uniformly: c on
///            the cap, h = c + w, m = h stretched and normalized. No frame is built, so none is skewed near the pole.
///            w.h is at least 4 eps, so wo.m > 0 for every u.
///   pdf    : 2 D(m) wo.m / (wo_z + |stretched wo|) [1/sr]; finite on the horizon. Relative error 16 eps: wo.m is
///            computed without cancellation. As a function of a rounded m, the pdf is ill-conditioned by 1 / wo.m.
///   invert : |invert(sample(u)) - u| <= 8 eps max(1, 2 / |h|) / sin(angle between c and z). The azimuth is inaccurate
///            near the pole of the cap, and the normal is inaccurate at grazing facets, near c = -w.
///   throws : Error unless both roughnesses lie in [1e-6, 1e3] and wo is a unit vector with wo_z >= 0.
///   Source : [DupuyBenyoub23]; the density from [Heitz18].
template <Real S> class TrowbridgeReitzVisibleNormals {
 public:
  using Scalar = S;
  using Domain = Hemisphere<S>;

  /// Visible normals of an isotropic surface of roughness alpha.
  TrowbridgeReitzVisibleNormals(const Vec3<S>& wo, S alpha) : TrowbridgeReitzVisibleNormals(wo, alpha, alpha) {}
  /// Visible normals of a surface of roughness alpha_x along x and alpha_y along y.
  TrowbridgeReitzVisibleNormals(const Vec3<S>& wo, S alpha_x, S alpha_y)
      : TrowbridgeReitzVisibleNormals(TrowbridgeReitzSurface<S>(alpha_x, alpha_y), wo) {
    require(wo.z() >= 0 && is_unit(wo),
            "TrowbridgeReitzVisibleNormals: wo = ({}, {}, {}) must be a unit vector with z >= 0",
            static_cast<double>(wo.x()), static_cast<double>(wo.y()), static_cast<double>(wo.z()));
  }

  Domain domain() const { return {}; }

  Vec3<S> sample(const Vec2<S>& u) const {
    using std::sqrt;
    // h_z = c_z + w_z and 1 - c_z are products. Only 1 + c_z = (1 - w_z) + h_z needs a sum, and its terms are positive.
    const S hz = (1 - u[1]) * (1 + w_.z());
    const S sin_c = sqrt(S(u[1] * (1 + w_.z()) * (below_one_ + hz)));
    const CosSin<S> phi = cos_sin<S>(u[0]);
    Vec3<S> h(sin_c * phi.cos + w_.x(), sin_c * phi.sin + w_.y(), hz);
    const S lacking = 4 * std::numeric_limits<S>::epsilon() - h.dot(w_);
    if (lacking > 0) [[unlikely]]
      h += lacking * w_;
    return surface_.stretch(h).normalized();
  }

  S pdf(const Vec3<S>& m) const {
    if (!(m.z() > 0)) return S(0);
    const S cosine = accurate_dot(wo_, m);
    return cosine > 0 ? S(scale_ * cosine * surface_.d(m)) : S(0);
  }

  /// Density of wi = reflect(wo, m) [1/sr]: pdf(m) / (4 wo.m), with the cosine cancelled. Well-conditioned wherever m
  /// is.
  S pdf_reflected(const Vec3<S>& m) const { return m.z() > 0 && wo_.dot(m) > 0 ? S(scale_ / 4 * surface_.d(m)) : S(0); }

  Vec2<S> invert(const Vec3<S>& m) const {
    const Vec3<S> n = surface_.unstretch(m).normalized();
    const S twice = 2 * accurate_dot(w_, n);
    const S u1 = 1 - twice * n.z() / (1 + w_.z());
    return {azimuth_turns<S>(twice * n.x() - w_.x(), twice * n.y() - w_.y()), clamp_to_unit(u1)};
  }

  /// Direction from which the normals are visible.
  const Vec3<S>& wo() const { return wo_; }

  template <Real T> TrowbridgeReitzVisibleNormals<T> cast() const {
    return TrowbridgeReitzVisibleNormals<T>({T(surface_.alpha_x), T(surface_.alpha_y)}, cast_point<T>(wo_));
  }

 private:
  template <Real T> friend class TrowbridgeReitzVisibleNormals;

  /// Does not normalize wo: a float unit vector is not a unit vector to 50 digits, and the oracle needs the same wo.
  TrowbridgeReitzVisibleNormals(const TrowbridgeReitzSurface<S>& surface, const Vec3<S>& wo)
      : surface_(surface), wo_(wo) {
    const Vec3<S> stretched = surface_.stretch(wo);
    const S length = stretched.norm();
    w_ = stretched / length;
    below_one_ = (w_.x() * w_.x() + w_.y() * w_.y()) / (1 + w_.z());
    scale_ = 2 / (wo.z() + length);
  }

  TrowbridgeReitzSurface<S> surface_;
  Vec3<S> wo_, w_;
  S below_one_, scale_; ///< 1 - w_z, 2 / (wo_z + |stretched wo|)
};

} // namespace mc

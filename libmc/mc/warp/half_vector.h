#pragma once
/// Directions in which microfacets send light: reflected about a random normal, or refracted through it.
///
/// A direction tells its normal by the half vector: s = wo + wi for reflection, s = wo + eta wi for refraction,
/// normalized and turned upward. Rounding wi by eps turns that normal by eps / |s|, and a surface of roughness alpha
/// amplifies this by 1 / alpha. So pdf(wi) is right for the wi that it is given, to its stated bound, yet away from
/// grazing incidence it differs from the density at the normal that was drawn by up to 8 eps / (alpha |s|): half a
/// percent for float, alpha = 1e-4 and |s| = 2. Whoever still has the normal has the density without that loss:
///   m = normals.sample(u);  wi = lobe.direction(m);  pdf = lobe.pdf_at_normal(m)

#include <mc/core/dot.h>
#include <mc/core/error.h>
#include <mc/domain/sphere.h>
#include <mc/warp/concept.h>

#include <utility>

namespace mc {

/// A distribution of normals that knows the direction it is seen from, as visible normals do.
template <class N>
concept VisibleNormalDistribution = Warp<N> && requires(const N n) {
  { n.wo() } -> std::convertible_to<PointOf<N>>;
};

namespace detail {

/// v / |v| - v of a vector that is unit up to rounding. Relative error that of |v|^2 - 1, taken with twice the digits
/// of S.
template <Real S> Vec3<S> normalization_correction(const Vec3<S>& v) {
  if constexpr (std::floating_point<S>) {
    S sum(-1), low(0);
    for (int i = 0; i < 3; ++i) {
      const S p = v[i] * v[i], t = sum + p, b = t - sum;
      low += std::fma(v[i], v[i], -p) + ((sum - (t - b)) + (p - b));
      sum = t;
    }
    return -(sum + low) / 2 * v;
  } else {
    return v.normalized() - v;
  }
}

/// A direction and the normals that it meets.
template <Warp N> struct MicrofacetGeometry {
  using S = typename N::Scalar;
  N normals;
  Vec3<S> wo;
  S floor = 16 * std::numeric_limits<S>::epsilon(); ///< least |wo.m| at which wi still tells m from its neighbours

  void require_unit(const char* who) const {
    require(is_unit(wo), "{}: wo = ({}, {}, {}) must be a unit vector", who, static_cast<double>(wo.x()),
            static_cast<double>(wo.y()), static_cast<double>(wo.z()));
  }

  /// The normal turned toward wo, and lifted to the floor where wo grazes it.
  Vec3<S> facing(const Vec3<S>& m) const {
    const S c = accurate_dot(wo, m);
    const Vec3<S> n = c < 0 ? Vec3<S>(-m) : m;
    const S lacking = floor - (c < 0 ? S(-c) : c);
    if (lacking > 0) [[unlikely]]
      return Vec3<S>(n + lacking * wo).normalized();
    return n;
  }
  Vec3<S> reflect(const Vec3<S>& n) const { return Vec3<S>(2 * accurate_dot(wo, n) * n - wo).normalized(); }
  Vec3<S> refract(const Vec3<S>& n, const S& eta) const {
    using std::sqrt;
    const S c = accurate_dot(wo, n), g = (eta - 1) * (eta + 1);
    // c - eta cos_t without its cancellation.
    return Vec3<S>(-wo - (g / (c + S(sqrt(S(g + c * c))))) * n).normalized();
  }
  bool refracts(const Vec3<S>& n, const S& eta) const {
    return sqr<S>(accurate_dot(wo, n)) + (eta - 1) * (eta + 1) > 0;
  }

  /// wo + eta wi of the directions of both: what their lengths lack of 1 matters as much as a turn by the same amount.
  Vec3<S> sum(const Vec3<S>& wi, const S& eta) const {
    using std::fma;
    const Vec3<S> rest = normalization_correction(wo) + eta * normalization_correction(wi);
    return Vec3<S>(S(fma(eta, wi.x(), wo.x())), S(fma(eta, wi.y(), wo.y())), S(fma(eta, wi.z(), wo.z()))) + rest;
  }
  /// The upper one of the two normals +-s / |s|; a normal that rounding may have carried below the horizon counts as
  /// above it.
  Vec3<S> upward(const Vec3<S>& s, const S& length) const {
    const S eps = std::numeric_limits<S>::epsilon();
    Vec3<S> h = s / length;
    if (h.z() * length < -2 * eps) h = -h;
    if (!(h.z() > 0)) h.z() = eps / 4;
    return h;
  }

  /// pdf(m) / (4 |wo.m|), given 4 |wo.m|; visible normals know it with the cosine cancelled, for a wo of unit length.
  S reflected_pdf(const Vec3<S>& m, const S& four_cosines) const {
    if constexpr (std::floating_point<S> && requires { normals.pdf_reflected(m); }) return normals.pdf_reflected(m);
    else return normals.pdf(m) / four_cosines;
  }
  S reflected_pdf_at(const Vec3<S>& m) const {
    using std::abs;
    return reflected_pdf(m, S(4 * abs(accurate_dot(wo, m))));
  }
  S reflected_pdf_of(const Vec3<S>& wi) const {
    const Vec3<S> s = sum(wi, S(1));
    const S length = s.norm(); // 2 |wo.h|
    return length > 0 ? reflected_pdf(upward(s, length), S(2 * length)) : S(0);
  }
  /// Jacobian eta^2 cos_t / (wo.h + eta wi.h)^2, [WalterEtAl07] equation 17; the sum in the denominator is |wo + eta
  /// wi|.
  S refracted_pdf_at(const Vec3<S>& m, const S& eta) const {
    using std::abs, std::sqrt;
    const S c = abs(accurate_dot(wo, m)), g = (eta - 1) * (eta + 1), k2 = g + c * c;
    if (!(k2 > 0)) return S(0);
    const S k = sqrt(k2); // eta cos_t
    return normals.pdf(m) * (eta * k * sqr<S>((c + k) / g));
  }
  S refracted_pdf_of(const Vec3<S>& wi, const S& eta) const {
    const Vec3<S> s = eta > 1 ? Vec3<S>(-sum(wi, eta)) : sum(wi, eta);
    const S length = s.norm();
    const Vec3<S> h = s / length;
    const S cos_t = -accurate_dot(wi, h);
    if (!(cos_t > 0 && accurate_dot(wo, h) > 0)) return S(0);
    return normals.pdf(upward(s, length)) * (cos_t * sqr<S>(eta / length));
  }
  Vec2<S> invert(const Vec3<S>& s) const { return normals.invert(upward(s, s.norm())); }

  /// wo is unit only in the narrower scalar.
  template <Real T> auto cast() const {
    return MicrofacetGeometry<decltype(normals.template cast<T>())>{normals.template cast<T>(),
                                                                    cast_point<T>(wo).normalized()};
  }
};

} // namespace detail

/// wo reflected about a random normal.
///   sample : wi = 2 (wo.m) m - wo for the sample m of the normals, which may face away from wo: still one-to-one.
///            Within 64 eps
///   pdf    : pdf(m) / (4 |wo.m|) [1/sr] at m = the half vector. Relative error that of the normals' pdf + 32 eps,
///            but for m within 2 eps / |wo + wi| of the horizon, which may stand for the one below it
///   invert : |invert(sample(u)) - u| <= 16 eps / (alpha |wo + wi|), the conditioning above, where the normals' own
///            inverse is exact
///   throws : Error unless wo is a unit vector
///   Source : [WalterEtAl07] equation 14
template <Warp N> class Reflected {
 public:
  using Scalar = typename N::Scalar;
  using S = Scalar;
  using Domain = Sphere<S>;

  Reflected(const Vec3<S>& wo, N normals) requires(!VisibleNormalDistribution<N>) : geometry_{std::move(normals), wo} {
    geometry_.require_unit("Reflected");
  }
  explicit Reflected(N normals) requires VisibleNormalDistribution<N> : geometry_{normals, normals.wo()} {}

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const { return direction(geometry_.normals.sample(u)); }
  S pdf(const Vec3<S>& wi) const { return geometry_.reflected_pdf_of(wi); }
  Vec2<S> invert(const Vec3<S>& wi) const { return geometry_.invert(geometry_.sum(wi, S(1))); }

  Vec3<S> direction(const Vec3<S>& m) const { return geometry_.reflect(geometry_.facing(m)); }
  /// Density of direction(m) [1/sr], as accurate as the density of the normals at m.
  S pdf_at_normal(const Vec3<S>& m) const { return geometry_.reflected_pdf_at(m); }

  template <Real T> auto cast() const {
    auto wide = geometry_.template cast<T>();
    return Reflected<decltype(wide.normals)>(std::move(wide));
  }

 private:
  template <Warp M> friend class Reflected;
  explicit Reflected(detail::MicrofacetGeometry<N> geometry)
      : geometry_(std::move(geometry)) {} // wo is unit only in the narrower scalar
  detail::MicrofacetGeometry<N> geometry_;
};

template <class S, class N> Reflected(const Vec3<S>&, N) -> Reflected<N>;
template <class N> explicit Reflected(N) -> Reflected<N>;

/// wo refracted through a random normal into a denser medium.
///   eta    : index of refraction on the far side over that on wo's, in [1.0001, 1e4]; every normal refracts
///   sample : wi = -(wo + (eta^2 - 1) / (wo.m + eta cos_t) m) / eta by Snell's law, for the normal m turned toward wo.
///            Within 64 eps
///   pdf    : pdf(m) eta^2 cos_t / |wo + eta wi|^2 [1/sr]. Relative error (64 + 4 / |wo.m|) eps
///   invert : |invert(sample(u)) - u| <= 16 eps eta / (alpha |wo + eta wi|), likewise
///   throws : Error unless wo is a unit vector and eta in its range
///   Source : [WalterEtAl07] equations 16 and 17
template <Warp N> class RefractedIn {
 public:
  using Scalar = typename N::Scalar;
  using S = Scalar;
  using Domain = Sphere<S>;

  RefractedIn(const Vec3<S>& wo, N normals, S eta) requires(!VisibleNormalDistribution<N>)
      : RefractedIn(detail::MicrofacetGeometry<N>{std::move(normals), wo}, eta) {
    check();
  }
  RefractedIn(N normals, S eta) requires VisibleNormalDistribution<N>
      : RefractedIn(detail::MicrofacetGeometry<N>{normals, normals.wo()}, eta) {
    check();
  }

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const { return direction(geometry_.normals.sample(u)); }
  S pdf(const Vec3<S>& wi) const { return geometry_.refracted_pdf_of(wi, eta_); }
  Vec2<S> invert(const Vec3<S>& wi) const { return geometry_.invert(geometry_.sum(wi, eta_)); }

  Vec3<S> direction(const Vec3<S>& m) const { return geometry_.refract(geometry_.facing(m), eta_); }
  /// Density of direction(m) [1/sr], as accurate as the density of the normals at m.
  S pdf_at_normal(const Vec3<S>& m) const { return geometry_.refracted_pdf_at(m, eta_); }

  template <Real T> auto cast() const {
    auto wide = geometry_.template cast<T>();
    return RefractedIn<decltype(wide.normals)>(std::move(wide), T(eta_));
  }

 private:
  template <Warp M> friend class RefractedIn;
  RefractedIn(detail::MicrofacetGeometry<N> geometry, S eta) : geometry_(std::move(geometry)), eta_(eta) {
    using std::sqrt;
    if (eta > 1) geometry_.floor *= 1 + 1 / S(sqrt(S((eta - 1) * (eta + 1)))); // wi tells m to eps / |wo + eta wi|
  }
  void check() const {
    geometry_.require_unit("RefractedIn");
    require(eta_ >= S(1.0001) && eta_ <= S(1e4), "RefractedIn: eta = {} must lie in [1.0001, 10000]",
            static_cast<double>(eta_));
  }
  detail::MicrofacetGeometry<N> geometry_;
  S eta_;
};

template <class S, class N> RefractedIn(const Vec3<S>&, N, S) -> RefractedIn<N>;
template <class N, class S> RefractedIn(N, S) -> RefractedIn<N>;

/// wo refracted through a random normal into a rarer medium, or reflected where the normal reflects totally.
///   eta    : index of refraction on the far side over that on wo's, in [1e-4, 0.9999]
///   sample : the refraction of RefractedIn where (wo.m)^2 > 1 - eta^2, else the reflection. Within 64 eps / cos_t
///   pdf    : the sum of both densities [1/sr]: a direction may be the refraction by one normal and the reflection by
///            another. Relative error (64 + 4 / |wo.m| + 4 / cos_t) eps
///   invert : none, for that reason
///   throws : Error unless wo is a unit vector and eta in its range
///   Source : [WalterEtAl07] equations 14, 16 and 17
template <Warp N> class RefractedOut {
 public:
  using Scalar = typename N::Scalar;
  using S = Scalar;
  using Domain = Sphere<S>;

  RefractedOut(const Vec3<S>& wo, N normals, S eta) requires(!VisibleNormalDistribution<N>)
      : RefractedOut(detail::MicrofacetGeometry<N>{std::move(normals), wo}, eta) {
    check();
  }
  RefractedOut(N normals, S eta) requires VisibleNormalDistribution<N>
      : RefractedOut(detail::MicrofacetGeometry<N>{normals, normals.wo()}, eta) {
    check();
  }

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const { return direction(geometry_.normals.sample(u)); }
  S pdf(const Vec3<S>& wi) const {
    // Rounding may carry a wi that was reflected at the critical angle beyond it, by less than this.
    const S slack = 16 * std::numeric_limits<S>::epsilon();
    const bool total = geometry_.sum(wi, S(1)).squaredNorm() / 4 <= (1 - eta_) * (1 + eta_) + slack;
    return geometry_.refracted_pdf_of(wi, eta_) + (total ? geometry_.reflected_pdf_of(wi) : S(0));
  }

  Vec3<S> direction(const Vec3<S>& m) const {
    const Vec3<S> n = geometry_.facing(m);
    return geometry_.refracts(n, eta_) ? geometry_.refract(n, eta_) : geometry_.reflect(n);
  }
  /// Density of direction(m) [1/sr] by way of m alone: pdf less what other normals add. As accurate as the density of
  /// the normals.
  S pdf_at_normal(const Vec3<S>& m) const {
    return geometry_.refracts(m, eta_) ? geometry_.refracted_pdf_at(m, eta_) : geometry_.reflected_pdf_at(m);
  }

  template <Real T> auto cast() const {
    auto wide = geometry_.template cast<T>();
    return RefractedOut<decltype(wide.normals)>(std::move(wide), T(eta_));
  }

 private:
  template <Warp M> friend class RefractedOut;
  RefractedOut(detail::MicrofacetGeometry<N> geometry, S eta) : geometry_(std::move(geometry)), eta_(eta) {}
  void check() const {
    geometry_.require_unit("RefractedOut");
    require(eta_ >= S(1e-4) && eta_ <= S(0.9999), "RefractedOut: eta = {} must lie in [0.0001, 0.9999]",
            static_cast<double>(eta_));
  }
  detail::MicrofacetGeometry<N> geometry_;
  S eta_;
};

template <class S, class N> RefractedOut(const Vec3<S>&, N, S) -> RefractedOut<N>;
template <class N, class S> RefractedOut(N, S) -> RefractedOut<N>;

} // namespace mc

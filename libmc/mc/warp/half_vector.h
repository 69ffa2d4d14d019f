#pragma once
/// Directions into which microfacets scatter light: reflected about a random normal, or refracted through it.
///
/// The half vector recovers the normal of a direction: s = wo + wi for reflection, s = wo + eta wi for refraction,
/// normalized and turned upward. An error of eps in wi turns this normal by eps / |s|. A surface of roughness alpha
/// amplifies the turn by 1 / alpha.
///
/// Hence pdf(wi) satisfies its stated bound at the rounded wi. It may still differ from the density at the sampled
/// normal, away from grazing incidence by up to 8 eps / (alpha |s|). For float, alpha = 1e-4 and |s| = 2 this is half a
/// percent. A caller that still has the normal avoids the loss:
///   m = normals.sample(u);  wi = lobe.direction(m);  pdf = lobe.pdf_at_normal(m)

#include <mc/core/dot.h>
#include <mc/core/error.h>
#include <mc/domain/sphere.h>
#include <mc/warp/concept.h>

#include <utility>

namespace mc {

/// A distribution of normals that stores the direction wo from which the normals are visible.
template <class N>
concept VisibleNormalDistribution = Warp<N> && requires(const N n) {
  { n.wo() } -> std::convertible_to<PointOf<N>>;
};

namespace detail {

/// v / |v| - v for a vector v that is a unit vector up to rounding. |v|^2 - 1 is computed with twice the digits of S;
/// its relative error is the relative error of the result.
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

/// A direction wo and the distribution of the normals at which it scatters.
template <Warp N> struct MicrofacetGeometry {
  using S = typename N::Scalar;
  N normals;
  Vec3<S> wo;
  /// Least |wo.m| at which wi still determines m to working precision.
  S floor = 16 * std::numeric_limits<S>::epsilon();

  void require_unit(const char* who) const {
    require(is_unit(wo), "{}: wo = ({}, {}, {}) must be a unit vector", who, static_cast<double>(wo.x()),
            static_cast<double>(wo.y()), static_cast<double>(wo.z()));
  }

  /// The normal m turned toward wo. At grazing incidence it is tilted until wo.m reaches `floor`.
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
    // c - eta cos_t, written without its cancellation.
    return Vec3<S>(-wo - (g / (c + S(sqrt(S(g + c * c))))) * n).normalized();
  }
  bool refracts(const Vec3<S>& n, const S& eta) const {
    return sqr<S>(accurate_dot(wo, n)) + (eta - 1) * (eta + 1) > 0;
  }

  /// wo + eta wi of the normalized directions. The deviation of a length from 1 matters as much as a turn by the same
  /// amount, so it is corrected.
  Vec3<S> sum(const Vec3<S>& wi, const S& eta) const {
    using std::fma;
    const Vec3<S> rest = normalization_correction(wo) + eta * normalization_correction(wi);
    return Vec3<S>(S(fma(eta, wi.x(), wo.x())), S(fma(eta, wi.y(), wo.y())), S(fma(eta, wi.z(), wo.z()))) + rest;
  }
  /// The upper one of the two normals +-s / |s|. A normal that rounding may have moved below the horizon counts as
  /// above
  /// it.
  Vec3<S> upward(const Vec3<S>& s, const S& length) const {
    const S eps = std::numeric_limits<S>::epsilon();
    Vec3<S> h = s / length;
    if (h.z() * length < -2 * eps) h = -h;
    if (!(h.z() > 0)) h.z() = eps / 4;
    return h;
  }

  /// pdf(m) / (4 |wo.m|), given four_cosines = 4 |wo.m|. Visible normals provide this quotient with the cosine
  /// cancelled,
  /// for wo of unit length.
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
  /// Jacobian eta^2 cos_t / (wo.h + eta wi.h)^2, [WalterEtAl07] equation 17. The sum in the denominator is |wo + eta
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

  /// Normalizes wo again: it is a unit vector only to the precision of S.
  template <Real T> auto cast() const {
    return MicrofacetGeometry<decltype(normals.template cast<T>())>{normals.template cast<T>(),
                                                                    cast_point<T>(wo).normalized()};
  }
};

} // namespace detail

/// wo reflected about a random normal.
///   sample : wi = 2 (wo.m) m - wo for a sampled normal m, within 64 eps. m may face away from wo; the map is still
///            one-to-one.
///   pdf    : pdf(m) / (4 |wo.m|) [1/sr] at the half vector m. Relative error: 32 eps plus the relative error of the
///            density of normals. Exception: a normal within 2 eps / |wo + wi| of the horizon may stand for its
///            neighbour below the horizon.
///   invert : |invert(sample(u)) - u| <= 16 eps / (alpha |wo + wi|) where invert of the normals is exact. The bound is
///            the conditioning described at the top of this file.
///   throws : Error unless wo is a unit vector.
///   Source : [WalterEtAl07] equation 14.
template <Warp N> class Reflected {
 public:
  using Scalar = typename N::Scalar;
  using S = Scalar; ///< Shorthand for Scalar.
  using Domain = Sphere<S>;

  /// Reflects wo about normals that do not depend on wo.
  Reflected(const Vec3<S>& wo, N normals) requires(!VisibleNormalDistribution<N>) : geometry_{std::move(normals), wo} {
    geometry_.require_unit("Reflected");
  }
  /// Reflects normals.wo() about the normals visible from it.
  explicit Reflected(N normals) requires VisibleNormalDistribution<N> : geometry_{normals, normals.wo()} {}

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const { return direction(geometry_.normals.sample(u)); }
  S pdf(const Vec3<S>& wi) const { return geometry_.reflected_pdf_of(wi); }
  Vec2<S> invert(const Vec3<S>& wi) const { return geometry_.invert(geometry_.sum(wi, S(1))); }

  /// wo reflected about the normal m, or about -m if m faces away from wo.
  Vec3<S> direction(const Vec3<S>& m) const { return geometry_.reflect(geometry_.facing(m)); }
  /// Density of direction(m) [1/sr], as accurate as the density of normals at m.
  S pdf_at_normal(const Vec3<S>& m) const { return geometry_.reflected_pdf_at(m); }

  template <Real T> auto cast() const {
    auto wide = geometry_.template cast<T>();
    return Reflected<decltype(wide.normals)>(std::move(wide));
  }

 private:
  template <Warp M> friend class Reflected;
  explicit Reflected(detail::MicrofacetGeometry<N> geometry)
      : geometry_(std::move(geometry)) {} // wo is a unit vector only to the precision of the narrower scalar
  detail::MicrofacetGeometry<N> geometry_;
};

/// Deduces the type of the normals.
template <class S, class N> Reflected(const Vec3<S>&, N) -> Reflected<N>;
/// Deduces the type of the normals.
template <class N> explicit Reflected(N) -> Reflected<N>;

/// wo refracted through a random normal into a denser medium.
///   eta    : index of refraction on the far side divided by the index on the side of wo, in [1.0001, 1e4]. Every
///            normal refracts.
///   sample : wi = -(wo + (eta^2 - 1) / (wo.m + eta cos_t) m) / eta by Snell's law, for the normal m turned toward wo.
///            Within 64 eps.
///   pdf    : pdf(m) eta^2 cos_t / |wo + eta wi|^2 [1/sr]. Relative error (64 + 4 / |wo.m|) eps.
///   invert : |invert(sample(u)) - u| <= 16 eps eta / (alpha |wo + eta wi|), as for Reflected.
///   throws : Error unless wo is a unit vector and eta lies in its range.
///   Source : [WalterEtAl07] equations 16 and 17.
template <Warp N> class RefractedIn {
 public:
  using Scalar = typename N::Scalar;
  using S = Scalar; ///< Shorthand for Scalar.
  using Domain = Sphere<S>;

  /// Refracts wo through normals that do not depend on wo.
  RefractedIn(const Vec3<S>& wo, N normals, S eta) requires(!VisibleNormalDistribution<N>)
      : RefractedIn(detail::MicrofacetGeometry<N>{std::move(normals), wo}, eta) {
    check();
  }
  /// Refracts normals.wo() through the normals visible from it.
  RefractedIn(N normals, S eta) requires VisibleNormalDistribution<N>
      : RefractedIn(detail::MicrofacetGeometry<N>{normals, normals.wo()}, eta) {
    check();
  }

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const { return direction(geometry_.normals.sample(u)); }
  S pdf(const Vec3<S>& wi) const { return geometry_.refracted_pdf_of(wi, eta_); }
  Vec2<S> invert(const Vec3<S>& wi) const { return geometry_.invert(geometry_.sum(wi, eta_)); }

  /// wo refracted through the normal m, turned toward wo.
  Vec3<S> direction(const Vec3<S>& m) const { return geometry_.refract(geometry_.facing(m), eta_); }
  /// Density of direction(m) [1/sr], as accurate as the density of normals at m.
  S pdf_at_normal(const Vec3<S>& m) const { return geometry_.refracted_pdf_at(m, eta_); }

  template <Real T> auto cast() const {
    auto wide = geometry_.template cast<T>();
    return RefractedIn<decltype(wide.normals)>(std::move(wide), T(eta_));
  }

 private:
  template <Warp M> friend class RefractedIn;
  RefractedIn(detail::MicrofacetGeometry<N> geometry, S eta) : geometry_(std::move(geometry)), eta_(eta) {
    using std::sqrt;
    if (eta > 1) geometry_.floor *= 1 + 1 / S(sqrt(S((eta - 1) * (eta + 1)))); // wi determines m to eps / |wo + eta wi|
  }
  void check() const {
    geometry_.require_unit("RefractedIn");
    require(eta_ >= S(1.0001) && eta_ <= S(1e4), "RefractedIn: eta = {} must lie in [1.0001, 10000]",
            static_cast<double>(eta_));
  }
  detail::MicrofacetGeometry<N> geometry_;
  S eta_;
};

/// Deduces the type of the normals.
template <class S, class N> RefractedIn(const Vec3<S>&, N, S) -> RefractedIn<N>;
/// Deduces the type of the normals.
template <class N, class S> RefractedIn(N, S) -> RefractedIn<N>;

/// wo refracted through a random normal into a rarer medium, or reflected at a normal with total internal reflection.
///   eta    : index of refraction on the far side divided by the index on the side of wo, in [1e-4, 0.9999].
///   sample : the refraction of RefractedIn if (wo.m)^2 > 1 - eta^2, else the reflection. Within 64 eps / cos_t.
///   pdf    : sum of both densities [1/sr]: one direction may be the refraction at one normal and the reflection at
///            another. Relative error (64 + 4 / |wo.m| + 4 / cos_t) eps.
///   invert : none, because two normals may give the same direction.
///   throws : Error unless wo is a unit vector and eta lies in its range.
///   Source : [WalterEtAl07] equations 14, 16 and 17.
template <Warp N> class RefractedOut {
 public:
  using Scalar = typename N::Scalar;
  using S = Scalar; ///< Shorthand for Scalar.
  using Domain = Sphere<S>;

  /// Refracts wo through normals that do not depend on wo.
  RefractedOut(const Vec3<S>& wo, N normals, S eta) requires(!VisibleNormalDistribution<N>)
      : RefractedOut(detail::MicrofacetGeometry<N>{std::move(normals), wo}, eta) {
    check();
  }
  /// Refracts normals.wo() through the normals visible from it.
  RefractedOut(N normals, S eta) requires VisibleNormalDistribution<N>
      : RefractedOut(detail::MicrofacetGeometry<N>{normals, normals.wo()}, eta) {
    check();
  }

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const { return direction(geometry_.normals.sample(u)); }
  S pdf(const Vec3<S>& wi) const {
    // Rounding may move a wi that was reflected at the critical angle beyond this angle, by less than `slack`.
    const S slack = 16 * std::numeric_limits<S>::epsilon();
    const bool total = geometry_.sum(wi, S(1)).squaredNorm() / 4 <= (1 - eta_) * (1 + eta_) + slack;
    return geometry_.refracted_pdf_of(wi, eta_) + (total ? geometry_.reflected_pdf_of(wi) : S(0));
  }

  /// wo refracted at the normal m turned toward wo, or reflected there if m reflects totally.
  Vec3<S> direction(const Vec3<S>& m) const {
    const Vec3<S> n = geometry_.facing(m);
    return geometry_.refracts(n, eta_) ? geometry_.refract(n, eta_) : geometry_.reflect(n);
  }
  /// The part of pdf(direction(m)) that comes from m alone [1/sr], without other normals that give the same direction.
  /// As accurate as the density of normals at m.
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

/// Deduces the type of the normals.
template <class S, class N> RefractedOut(const Vec3<S>&, N, S) -> RefractedOut<N>;
/// Deduces the type of the normals.
template <class N, class S> RefractedOut(N, S) -> RefractedOut<N>;

} // namespace mc

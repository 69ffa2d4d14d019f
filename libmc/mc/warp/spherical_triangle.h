#pragma once
/// Uniform directions through a triangle.

#include <mc/domain/patch.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

namespace detail {

/// a / |a| and the difference b / |b| - a / |a|, where b - a is known to relative precision.
template <Real S> Vec3<S> unit_difference(const Vec3<S>& a, const Vec3<S>& b_minus_a) {
  const Vec3<S> b = a + b_minus_a;
  const S la = a.norm(), lb = b.norm();
  const S longer = b_minus_a.dot(a + b) / (la + lb); // |b| - |a|
  return (b_minus_a - b * (longer / lb)) / la;
}

/// The spherical triangle of a and its neighbours b, c: area and inverse, all from differences of unit vectors, so that
/// nothing cancels when it is tiny.
template <Real S> struct SphericalTriangleMap {
  Vec3<S> b;                    ///< unit vector to the apex
  Vec3<S> ba;                   ///< a - b, of unit vectors
  Vec3<S> a, arc;               ///< unit vector to a, and the unit tangent there of the arc to c
  S sides, skew, volume, angle; ///< 1 + a.b, b.arc, det(a, b, arc), solid angle

  /// pa: a; ab, ac: from a to the other two, not unit.
  SphericalTriangleMap(const Vec3<S>& pa, const Vec3<S>& ab, const Vec3<S>& ac) {
    using std::abs, std::atan2;
    a = pa.normalized();
    const Vec3<S> delta_b = unit_difference<S>(pa, ab), delta_c = unit_difference<S>(pa, ac);
    b = (pa + ab).normalized();
    ba = -delta_b;
    // Tangent of the arc a -> c: the part of the chord orthogonal to a; a . chord = -|chord|^2 / 2.
    const Vec3<S> tangent = delta_c + a * (delta_c.squaredNorm() / 2);
    const S sine = tangent.norm();
    arc = tangent / sine;
    volume = abs(a.dot(cross<S>(delta_b, arc)));
    sides = 2 - delta_b.squaredNorm() / 2;
    skew = delta_b.dot(arc);
    // [VanOosteromStrackee83] with c = a cos + arc sin.
    const S t = half_tangent(sine, 1 - delta_c.squaredNorm() / 2);
    angle = 2 * S(atan2(S(volume * t), S(sides + skew * t)));
  }

  static S half_tangent(const S& sine, const S& cosine) {
    return cosine > 0 ? S(sine / (1 + cosine)) : S((1 - cosine) / sine);
  }

  Vec3<S> sample(const S& part, const S& u1) const {
    using std::cos, std::max, std::sin, std::sqrt;
    // The arc from b through a cos(x) + arc sin(x) cuts off the area part * angle: tau = tan(x/2).
    const S half = part * angle / 2, s = sin(half);
    const S tau = s * sides / (volume * S(cos(half)) - skew * s), q = 1 / (1 + tau * tau);
    const Vec3<S> chord = ba - a * (2 * tau * tau * q) + arc * (2 * tau * q); // c' - b
    const S tm = chord.squaredNorm() / 2, t = u1 * tm;                        // 1 - cosine at the far end, and here
    const S r = sqrt(S(u1 * (2 - t) / max(S(2 - tm), std::numeric_limits<S>::min())));
    return b + (chord + b * tm) * r - b * t;
  }

  Vec2<S> invert(const Vec3<S>& w) const {
    using std::abs, std::atan2, std::min;
    const Vec3<S> off = w - b;
    const Vec3<S> n = cross<S>(b, off);
    const S num = abs(n.dot(ba)), sign = n.dot(ba) > 0 ? S(-1) : S(1), den = sign * n.dot(arc);
    const S length = S(sqrt_of(num * num + den * den));
    if (!(length > 0)) return {S(0), S(0)};
    const S tau = half_tangent(num / length, den / length), q = 1 / (1 + tau * tau);
    const Vec3<S> chord = ba - a * (2 * tau * tau * q) + arc * (2 * tau * q);
    const S part = 2 * S(atan2(S(volume * tau), S(sides + skew * tau))) / angle;
    return {min(part, one_minus_epsilon<S>), min(S(off.squaredNorm() / chord.squaredNorm()), one_minus_epsilon<S>)};
  }

 private:
  static S sqrt_of(const S& x) {
    using std::sqrt;
    return sqrt(x);
  }
};

} // namespace detail

/// Uniform directions through the triangle with the given corners, the origin being the point that sees it.
///   made from : corner a and the edges to b and c, all relative to the viewer and of any length: a tiny triangle is
///               known by its edges, not by differences of far corners
///   sample    : the arc from b cuts off the share u0 of the solid angle; along it 1 - cosine to b grows like u1.
///               Within 16 eps of exact for edges up to a radian, 64 eps for a triangle that fills most of a hemisphere
///   pdf       : 1 / solid angle [1/sr], relative error 16 eps unless seen edge-on; 0 outside
///   invert    : |invert(sample(u)) - u| <= 64 eps / (shortest angular edge * sqrt(u1)): a unit vector holds no more
///   throws    : Error unless a, ab, ac span a finite volume > 0
///   Source    : [Arvo95]; area and its inverse in closed form from [VanOosteromStrackee83], without the angles whose
///               excess over pi cancels below 1e-3 sr. Measured down to 1e-8 sr
template <Real S> class SphericalTriangle {
 public:
  using Scalar = S;
  using Domain = TrianglePatch<S>;

  SphericalTriangle(const Vec3<S>& a, const Vec3<S>& ab, const Vec3<S>& ac) : domain_(a, ab, ac), map_(a, ab, ac) {}

  Domain domain() const { return domain_; }
  S solid_angle() const { return map_.angle; }
  Vec3<S> sample(const Vec2<S>& u) const { return map_.sample(u[0], u[1]).normalized(); }
  S pdf(const Vec3<S>& w) const { return domain_.contains(w) ? S(1 / map_.angle) : S(0); }
  Vec2<S> invert(const Vec3<S>& w) const { return map_.invert(w); }
  template <Real T> SphericalTriangle<T> cast() const {
    return {cast_point<T>(domain_.origin), cast_point<T>(domain_.edge1), cast_point<T>(domain_.edge2)};
  }

 private:
  Domain domain_;
  detail::SphericalTriangleMap<S> map_;
};

} // namespace mc

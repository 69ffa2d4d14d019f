#pragma once
/// Uniform directions through a triangle.

#include <mc/domain/patch.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

namespace detail {

/// An arc, given by its cosine, sine, far = 1 - cosine and near = 1 + cosine. None of them cancels.
template <Real S> struct Arc {
  S cos, sin, far, near;

  /// Arc between two vectors with the given dot product, length of the cross product, and product of lengths.
  Arc(const S& dot, const S& cross, const S& lengths) : cos(dot / lengths), sin(cross / lengths) {
    near = cos > 0 ? S(1 + cos) : S(sin * sin / (1 - cos));
    far = cos > 0 ? S(sin * sin / (1 + cos)) : S(1 - cos);
  }
  /// Arc with cosine and sine proportional to x and y >= 0.
  static Arc of(const S& x, const S& y) {
    using std::sqrt;
    return {x, y, S(sqrt(S(x * x + y * y)))};
  }
};

/// Sine and cosine, up to a common factor, of half the solid angle between two arcs from one corner.
template <Real S> struct HalfExcess {
  S sin, cos;
  HalfExcess(const Arc<S>& b, const Arc<S>& c, const S& sin_angle, const S& cos_angle) {
    using std::sqrt;
    const S across = sqrt(S(b.far * c.far)), along = sqrt(S(b.near * c.near));
    sin = across * sin_angle;
    cos = along + across * cos_angle;
  }
  S square() const { return sin * sin + cos * cos; }
};

/// The spherical triangle of a and its neighbours b, c. Computes area, samples and inverse by the trigonometry of side
/// ab and the angle at a. All quantities come from cross products of corners and edges. Nothing cancels for tiny
/// triangles, or for nearly opposite corners, which occur next to the plane of the triangle.
template <Real S> struct SphericalTriangleMap {
  Vec3<S> b, toward_a, inward; ///< Apex b, and unit tangents at b.
  S sin_a, cos_a;              ///< Sine and cosine of the angle at a.
  Arc<S> side;                 ///< Arc from a to b.
  S angle;                     ///< Solid angle [sr].

  /// pa: corner a. ab, ac: the edges from a to b and c. None need be unit vectors.
  SphericalTriangleMap(const Vec3<S>& pa, const Vec3<S>& ab, const Vec3<S>& ac)
      : SphericalTriangleMap(pa, ab, ac, power_of_two(pa, ab, ac)) {}

  Vec3<S> sample(const S& part, const S& u1) const {
    using std::cos, std::max, std::sin, std::sqrt;
    const S half = part * angle / 2, s = sin(half), c = cos(half);
    // The tangent of the angle at b that cuts off this area. One of the two forms of x does not cancel.
    const S rest = sin_a * c - cos_a * s, y = max(S(2 * s * rest), S(0));
    const S x =
        side.cos > 0 ? S(sin_a * side.far - 2 * s * (cos_a * c + sin_a * s)) : S(2 * c * rest - sin_a * side.near);
    const Arc<S> turn = Arc<S>::of(x, y);
    const S t = u1 * across(turn).far; // 1 - cosine of the angle to b
    return b * (1 - t) + (toward_a * turn.cos + inward * turn.sin) * S(sqrt(S(t * (2 - t))));
  }

  Vec2<S> invert(const Vec3<S>& w) const {
    using std::atan2, std::max;
    const S x = w.dot(toward_a), y = max(S(w.dot(inward)), S(0));
    if (!(x != 0 || y > 0)) return {S(0), S(0)};
    const Arc<S> turn = Arc<S>::of(x, y), end = across(turn);
    const HalfExcess<S> half(side, end, turn.sin, turn.cos);
    const S part = 2 * S(atan2(half.sin, half.cos)) / angle, u1 = (w - b).squaredNorm() / 2 / end.far;
    return {clamp_to_unit(part), clamp_to_unit(u1)};
  }

 private:
  SphericalTriangleMap(const Vec3<S>& pa, const Vec3<S>& ab, const Vec3<S>& ac, const S& scale)
      : SphericalTriangleMap(Corners{pa * scale, ab * scale, ac * scale}) {}

  struct Corners {
    Vec3<S> a, b, c, x, y, z; ///< Corners, and a x b, a x c, b x c.
    S la, lb, lc, lx, ly, lz; ///< Lengths of these vectors.
    S volume;                 ///< a . (b x c).

    Corners(const Vec3<S>& pa, const Vec3<S>& ab, const Vec3<S>& ac)
        : a(pa), b(pa + ab), c(pa + ac), x(cross<S>(pa, ab)), y(cross<S>(pa, ac)), z(cross<S>(b, Vec3<S>(ac - ab))),
          la(a.norm()), lb(b.norm()), lc(c.norm()), lx(x.norm()), ly(y.norm()), lz(z.norm()) {
      volume = nearest().dot(cross<S>(ab, ac));
    }
    const Vec3<S>& nearest() const {
      if (la <= lb && la <= lc) return a;
      return lb <= lc ? b : c;
    }
  };
  explicit SphericalTriangleMap(const Corners& k)
      : b(k.b / k.lb), toward_a(cross<S>(b, k.x / k.lx)), inward(k.x / (k.volume > 0 ? k.lx : S(-k.lx))),
        side(k.a.dot(k.b), k.lx, k.la * k.lb) {
    using std::abs, std::atan2;
    const S volume = abs(k.volume);
    sin_a = volume * k.la / (k.lx * k.ly);
    cos_a = k.x.dot(k.y) / (k.lx * k.ly);
    const Arc<S> ac(k.a.dot(k.c), k.ly, k.la * k.lc), bc(k.b.dot(k.c), k.lz, k.lb * k.lc);
    // All three corners give the solid angle; takes the corner with the least cancellation.
    HalfExcess<S> half(side, ac, sin_a, cos_a);
    const HalfExcess<S> at_b(side, bc, volume * k.lb / (k.lx * k.lz), -k.x.dot(k.z) / (k.lx * k.lz));
    const HalfExcess<S> at_c(ac, bc, volume * k.lc / (k.ly * k.lz), k.y.dot(k.z) / (k.ly * k.lz));
    if (at_b.square() > 2 * half.square()) half = at_b;
    if (at_c.square() > 2 * half.square()) half = at_c;
    angle = 2 * S(atan2(half.sin, half.cos));
  }

  /// The arc from b to the far side, at the given angle from side ab.
  Arc<S> across(const Arc<S>& turn) const {
    return Arc<S>::of(turn.cos * sin_a * side.cos + turn.sin * cos_a, sin_a * side.sin);
  }
  /// Power of two that brings the largest coordinate near 1, so that products stay in range.
  static S power_of_two(const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& c) {
    using std::frexp, std::ldexp, std::max;
    int exponent;
    frexp(max(a.cwiseAbs().maxCoeff(), max(b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff())), &exponent);
    return S(ldexp(S(1), -exponent));
  }
};

} // namespace detail

/// Uniform directions through a triangle, viewed from the origin.
///   made from : corner a relative to the viewer, and the edges from a to b and c, of any length. A tiny triangle keeps
///               its digits in its edges; differences of far corners would lose them.
///   sample    : the arc from b cuts off the share u0 of the solid angle. Along the arc, 1 - cosine to b is
///               proportional to u1. Error: 32 eps times the flatness (defined below) in double. Float is computed in
///               double and keeps 32 eps up to a flatness of 1e4; beyond, the error grows with the square of the
///               flatness.
///   pdf       : 1 / solid angle [1/sr]; 0 outside. Relative error 16 eps, with the same dependence on the flatness.
///   invert    : |invert(sample(u)) - u| <= 64 eps / (shortest angular edge * sqrt(u1)) for a flatness up to 20. The
///               precision of a unit vector allows no better bound. Flatter triangles viewed nearly edge-on lose more;
///               no bound is stated.
///   throws    : Error unless a, ab, ac span a finite volume > 0.
///   Source    : [Arvo95], with two changes. Half the excess is computed as in [VanOosteromStrackee83]; the excess of
///               three angles over pi cancels below 1e-3 sr. The angle at b replaces the point on the far side, which
///               lies opposite to b when the viewer is next to the plane.
/// Flatness is the distance of the farthest corner divided by the height of the viewer above the plane, plus the
/// longest edge divided by the height of the triangle on it.
template <Real S> class SphericalTriangle {
 public:
  using Scalar = S;
  using Domain = TrianglePatch<S>;

  /// A triangle with corner a relative to the viewer, and its edges from a.
  SphericalTriangle(const Vec3<S>& a, const Vec3<S>& ab, const Vec3<S>& ac)
      : domain_(a, ab, ac), map_(cast_point<W>(a), cast_point<W>(ab), cast_point<W>(ac)) {}

  Domain domain() const { return domain_; }
  /// Solid angle of the triangle [sr].
  S solid_angle() const { return S(map_.angle); }
  Vec3<S> sample(const Vec2<S>& u) const { return cast_point<S>(map_.sample(W(u[0]), W(u[1])).normalized()); }
  S pdf(const Vec3<S>& w) const { return domain_.contains(w) ? S(1 / map_.angle) : S(0); }
  Vec2<S> invert(const Vec3<S>& w) const {
    return cast_point<S>(map_.invert(cast_point<W>(w).normalized())).cwiseMin(one_minus_epsilon<S>);
  }
  template <Real T> SphericalTriangle<T> cast() const {
    return {cast_point<T>(domain_.origin), cast_point<T>(domain_.edge1), cast_point<T>(domain_.edge2)};
  }

 private:
  using W = detail::Wide<S>;
  Domain domain_;
  detail::SphericalTriangleMap<W> map_;
};

} // namespace mc

#pragma once
/// Uniform directions through a triangle.

#include <mc/domain/patch.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

namespace detail {

/// An arc by its cosine and sine, 1 - cosine and 1 + cosine, none of which cancels.
template <Real S> struct Arc {
  S cos, sin, far, near;

  /// Between vectors of the given dot product, length of the cross product, and product of lengths.
  Arc(const S& dot, const S& cross, const S& lengths) : cos(dot / lengths), sin(cross / lengths) {
    near = cos > 0 ? S(1 + cos) : S(sin * sin / (1 - cos));
    far = cos > 0 ? S(sin * sin / (1 + cos)) : S(1 - cos);
  }
  /// Of the given multiples of its cosine and sine, the latter not negative.
  static Arc of(const S& x, const S& y) {
    using std::sqrt;
    return {x, y, S(sqrt(S(x * x + y * y)))};
  }
};

/// Numerator and denominator of the tangent of half the solid angle between two arcs from one corner.
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

/// The spherical triangle of a and its neighbours b, c: area, samples and inverse by the trigonometry of side ab and
/// the angle at a. All come from cross products of corners and edges, so that nothing cancels when the triangle is tiny
/// or when two corners lie in opposite directions, as they do next to its plane.
template <Real S> struct SphericalTriangleMap {
  Vec3<S> b, toward_a, inward; ///< the apex, and unit tangents there
  S sin_a, cos_a;              ///< of the angle at a
  Arc<S> side;                 ///< from a to b
  S angle;                     ///< solid angle

  /// pa: a; ab, ac: from a to the other two, not unit.
  SphericalTriangleMap(const Vec3<S>& pa, const Vec3<S>& ab, const Vec3<S>& ac)
      : SphericalTriangleMap(pa, ab, ac, power_of_two(pa, ab, ac)) {}

  Vec3<S> sample(const S& part, const S& u1) const {
    using std::cos, std::max, std::sin, std::sqrt;
    const S half = part * angle / 2, s = sin(half), c = cos(half);
    // The angle at b that cuts off this area, from its tangent; two forms, of which one does not cancel.
    const S rest = sin_a * c - cos_a * s, y = max(S(2 * s * rest), S(0));
    const S x =
        side.cos > 0 ? S(sin_a * side.far - 2 * s * (cos_a * c + sin_a * s)) : S(2 * c * rest - sin_a * side.near);
    const Arc<S> turn = Arc<S>::of(x, y);
    const S t = u1 * across(turn).far; // 1 - cosine to b
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
    Vec3<S> a, b, c, x, y, z; ///< the corners, and a x b, a x c, b x c
    S la, lb, lc, lx, ly, lz; ///< their lengths
    S volume;                 ///< a . (b x c)

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
    // Of the three corners the one whose sum cancels least.
    HalfExcess<S> half(side, ac, sin_a, cos_a);
    const HalfExcess<S> at_b(side, bc, volume * k.lb / (k.lx * k.lz), -k.x.dot(k.z) / (k.lx * k.lz));
    const HalfExcess<S> at_c(ac, bc, volume * k.lc / (k.ly * k.lz), k.y.dot(k.z) / (k.ly * k.lz));
    if (at_b.square() > 2 * half.square()) half = at_b;
    if (at_c.square() > 2 * half.square()) half = at_c;
    angle = 2 * S(atan2(half.sin, half.cos));
  }

  /// The arc from b, at the given angle from side ab, to the far side.
  Arc<S> across(const Arc<S>& turn) const {
    return Arc<S>::of(turn.cos * sin_a * side.cos + turn.sin * cos_a, sin_a * side.sin);
  }
  /// That brings the largest coordinate near 1, so that products stay in range.
  static S power_of_two(const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& c) {
    using std::frexp, std::ldexp, std::max;
    int exponent;
    frexp(max(a.cwiseAbs().maxCoeff(), max(b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff())), &exponent);
    return S(ldexp(S(1), -exponent));
  }
};

} // namespace detail

/// Uniform directions through the triangle with the given corners, the origin being the point that sees it.
///   made from : corner a and the edges to b and c, all relative to the viewer and of any length: a tiny triangle is
///               known by its edges, not by differences of far corners
///   sample    : the arc from b cuts off the share u0 of the solid angle; along it 1 - cosine to b grows like u1.
///               Within 32 eps of exact times the flatness in double: the farthest corner over the height of the viewer
///               over the plane, plus the longest edge over the height of the triangle on it. Float is computed in
///               double and keeps its 32 eps up to a flatness of 1e4, beyond which they grow like its square
///   pdf       : 1 / solid angle [1/sr], relative error 16 eps likewise; 0 outside
///   invert    : |invert(sample(u)) - u| <= 64 eps / (shortest angular edge * sqrt(u1)) for a flatness up to 20: a unit
///               vector holds no more. Flatter ones seen nearly edge-on lose more, by no bound that is known
///   throws    : Error unless a, ab, ac span a finite volume > 0
///   Source    : [Arvo95], by half the excess as in [VanOosteromStrackee83] instead of angles whose excess over pi
///               cancels below 1e-3 sr, and by the angle at b instead of the point on the far side, which lies
///               opposite to b where the viewer is next to the plane
template <Real S> class SphericalTriangle {
 public:
  using Scalar = S;
  using Domain = TrianglePatch<S>;

  SphericalTriangle(const Vec3<S>& a, const Vec3<S>& ab, const Vec3<S>& ac)
      : domain_(a, ab, ac), map_(cast_point<W>(a), cast_point<W>(ab), cast_point<W>(ac)) {}

  Domain domain() const { return domain_; }
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

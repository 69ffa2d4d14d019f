#pragma once
/// Uniform directions through a rectangle or parallelogram.

#include <mc/warp/spherical_triangle.h>

namespace mc {

/// Uniform directions through a parallelogram, viewed from the origin.
///   made from : the corner relative to the viewer, and the two edges from it.
///   sample    : arcs from the corner sweep the patch: first the half between edge1 and the diagonal, then the other
///               half. u0 is the share of the solid angle swept. Along an arc, 1 - cosine to the corner is proportional
///               to u1. Continuous in u.
///   pdf       : 1 / solid angle [1/sr]; 0 outside. Relative error as for SphericalTriangle. In double it contains one
///               more factor of the flatness, because the opposite corner is itself rounded.
///   invert    : as for SphericalTriangle.
///   throws    : Error unless corner and edges span a finite volume > 0.
///   Source    : a fan of two [Arvo95] triangles in the closed form of spherical_triangle.h.
/// The azimuthal cuts of Urena et al. 2013 were rejected. Their solid angle is an excess of angles over 2 pi, which
/// cancels for small patches; the fan keeps its precision there. In exchange the fan takes longer to construct, and its
/// samples are less accurate beyond 6 sr, next to the horizon. bench_spherical_rectangle compares both.
template <Real S> class SphericalRectangle {
 public:
  using Scalar = S;
  using Domain = ParallelogramPatch<S>;

  /// A parallelogram with its corner relative to the viewer.
  SphericalRectangle(const Vec3<S>& corner, const Vec3<S>& edge1, const Vec3<S>& edge2)
      : domain_(corner, edge1, edge2), first_(wide(corner) + wide(edge1), -wide(edge1), wide(edge2)),
        second_(wide(corner) + wide(edge1) + wide(edge2), -(wide(edge1) + wide(edge2)), -wide(edge1)),
        share_(first_.angle / (first_.angle + second_.angle)) {}

  Domain domain() const { return domain_; }
  /// Solid angle of the patch [sr].
  S solid_angle() const { return S(first_.angle + second_.angle); }
  Vec3<S> sample(const Vec2<S>& u) const {
    const W u0(u[0]), u1(u[1]);
    return cast_point<S>(
        (u0 < share_ ? first_.sample(u0 / share_, u1) : second_.sample((u0 - share_) / (1 - share_), u1)).normalized());
  }
  S pdf(const Vec3<S>& w) const { return domain_.contains(w) ? S(1 / solid_angle()) : S(0); }
  Vec2<S> invert(const Vec3<S>& direction) const {
    // The side of the diagonal plane decides the half.
    const Vec3<W> w = wide(direction).normalized(), e1 = wide(domain_.edge1), e2 = wide(domain_.edge2);
    const Vec3<W> n = cross<W>(wide(domain_.origin), Vec3<W>(e1 + e2));
    const bool first = n.dot(w) * n.dot(e1) >= 0;
    Vec2<W> v = first ? first_.invert(w) : second_.invert(w);
    v[0] = first ? W(v[0] * share_) : W(share_ + v[0] * (1 - share_));
    return cast_point<S>(v).cwiseMin(one_minus_epsilon<S>);
  }
  template <Real T> SphericalRectangle<T> cast() const {
    return {cast_point<T>(domain_.origin), cast_point<T>(domain_.edge1), cast_point<T>(domain_.edge2)};
  }

 private:
  using W = detail::Wide<S>;
  static Vec3<W> wide(const Vec3<S>& v) { return cast_point<W>(v); }

  Domain domain_;
  detail::SphericalTriangleMap<W> first_, second_; ///< both have their apex at the corner
  W share_;
};

} // namespace mc

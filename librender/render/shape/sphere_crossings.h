#pragma once
/// Where a line meets a sphere.

#include <render/core/lanes.h>

namespace render {

/// A line in double.
struct Line {
  Vec3d o, d;
  double d2, inverse_d2;

  Line(const Vec3d& origin, const Vec3d& direction)
      : o(origin), d(direction), d2(d.squaredNorm()), inverse_d2(1 / d2) {}
};

/// How a line o + t d passes spheres: one (T = double) or eight (EightDoubles); o relative to the centre.
///   error  : the squared distance of the centre from the line is known without the cancellation of b^2 - 4 a c
///   Source : [HainesGuntherAkenineMoller19]
template <class T> struct SphereQuadratic {
  T b;            ///< the centre is nearest at t = b / d^2
  T c;            ///< squared distance of the centre from o, less radius^2
  T discriminant; ///< radius^2 less the squared distance of the centre from the line

  auto crosses() const { return discriminant >= 0; }
  /// Where it crosses at some t > 0: not where it leaves a sphere behind that does not hold o.
  auto crosses_ahead() const { return crosses() & ((b >= 0) | (c < 0)); }
};

template <class T>
SphereQuadratic<T> sphere_quadratic(const T& ox, const T& oy, const T& oz, const Line& line, const T& radius2) {
  const Vec3d& d = line.d;
  const T b = -(ox * d.x() + oy * d.y() + oz * d.z()), nearest = b * line.inverse_d2;
  const T px = ox + d.x() * nearest, py = oy + d.y() * nearest, pz = oz + d.z() * nearest;
  return {b, ox * ox + oy * oy + oz * oz - radius2, radius2 - (px * px + py * py + pz * pz)};
}

/// Distances t0 <= t1 [lengths of d] of its crossings, where there are any; a NaN t is none.
template <class T> struct SphereCrossings { T t0, t1; };

template <class T> SphereCrossings<T> sphere_crossings(const SphereQuadratic<T>& pass, const Line& line) {
  const T root = detail::square_root(pass.crosses() ? line.d2 * pass.discriminant : T{});
  const T q = pass.b < 0 ? pass.b - root : pass.b + root;
  const T first = q * line.inverse_d2, second = pass.c / q; // q = 0 gives NaN, which is no crossing
  return {first < second ? first : second, first < second ? second : first};
}

} // namespace render

#pragma once
/// Intersection of a line with a sphere.

#include <render/core/lanes.h>

namespace render {

/// A line o + t d in double, with |d|^2 and its inverse.
struct Line {
  Vec3d o,        ///< Origin.
      d;          ///< Direction, not necessarily unit.
  double d2,      ///< |d|^2.
      inverse_d2; ///< 1 / |d|^2.

  /// A line through `origin` along `direction`.
  Line(const Vec3d& origin, const Vec3d& direction)
      : o(origin), d(direction), d2(d.squaredNorm()), inverse_d2(1 / d2) {}
};

/// The quadratic equation of a line o + t d and a sphere, with o relative to the centre. T is double for one sphere,
/// EightDoubles for eight.
///   error  : the squared distance of the centre from the line is computed without the cancellation of b^2 - 4 a c.
///   Source : [HainesGuntherAkenineMoller19].
template <class T> struct SphereQuadratic {
  T b;            ///< The line is nearest to the centre at t = b / d^2.
  T c;            ///< Squared distance of o from the centre, minus radius^2.
  T discriminant; ///< radius^2 minus the squared distance of the centre from the line.

  /// Whether the line crosses the sphere.
  auto crosses() const { return discriminant >= 0; }
  /// Whether the line crosses the sphere at some t > 0. False for a sphere behind o that does not contain o.
  auto crosses_ahead() const { return crosses() & ((b >= 0) | (c < 0)); }
};

/// The quadratic of `line` and a sphere with squared radius radius2; (ox, oy, oz) is line.o relative to the centre.
template <class T>
SphereQuadratic<T> sphere_quadratic(const T& ox, const T& oy, const T& oz, const Line& line, const T& radius2) {
  const Vec3d& d = line.d;
  const T b = -(ox * d.x() + oy * d.y() + oz * d.z()), nearest = b * line.inverse_d2;
  const T px = ox + d.x() * nearest, py = oy + d.y() * nearest, pz = oz + d.z() * nearest;
  return {b, ox * ox + oy * oy + oz * oz - radius2, radius2 - (px * px + py * py + pz * pz)};
}

/// Parameters t0 <= t1 of the crossings. A NaN is no crossing.
template <class T> struct SphereCrossings {
  T t0,   ///< Parameter of the first crossing.
      t1; ///< Parameter of the second crossing.
};

/// The crossings of a line for which pass.crosses() holds.
template <class T> SphereCrossings<T> sphere_crossings(const SphereQuadratic<T>& pass, const Line& line) {
  const T root = detail::square_root(pass.crosses() ? line.d2 * pass.discriminant : T{});
  const T q = pass.b < 0 ? pass.b - root : pass.b + root;
  const T first = q * line.inverse_d2, second = pass.c / q; // q = 0 gives NaN: no crossing
  return {first < second ? first : second, first < second ? second : first};
}

} // namespace render

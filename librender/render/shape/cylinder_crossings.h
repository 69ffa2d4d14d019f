#pragma once
/// Intersection of a line with a cylinder.

#include <render/core/lanes.h>

namespace render {

/// Crossings of a line with the infinite cylinder around the z axis, at parameters t0 <= t1 and heights z0 and z1. A
/// NaN is no crossing.
template <class T> struct CylinderCrossings {
  decltype(T() > T()) crosses; ///< Whether the line meets the cylinder; false for a line along the axis off its wall.
  T t0,                        ///< Parameter of the first crossing.
      t1,                      ///< Parameter of the second crossing.
      z0,                      ///< Height of the first crossing.
      z1;                      ///< Height of the second crossing.
};

/// The crossings of the line o + t d with a cylinder of squared radius radius2. T is double for one cylinder,
/// EightDoubles for eight.
///   error : the discriminant is computed without the cancellation of b^2 - a c, from the distance of the line to the
///           axis, and each root without that of -b + sqrt.
template <class T>
CylinderCrossings<T> cylinder_crossings(const T& ox, const T& oy, const T& oz, const T& dx, const T& dy, const T& dz,
                                        const T& radius2) {
  const T a = dx * dx + dy * dy, b = ox * dx + oy * dy, c = ox * ox + oy * oy - radius2, cross = ox * dy - oy * dx;
  const T discriminant = radius2 * a - cross * cross;
  const auto crosses = discriminant >= 0;
  const T root = detail::square_root(crosses ? discriminant : T{});
  const T q = b > 0 ? -b - root : root - b;
  const T first = q / a, second = c / q;
  const T t0 = first < second ? first : second, t1 = first < second ? second : first;
  return {crosses, t0, t1, oz + t0 * dz, oz + t1 * dz};
}

} // namespace render

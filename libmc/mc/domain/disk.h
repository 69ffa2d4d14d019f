#pragma once
/// The unit disk.

#include <mc/core/turns.h>
#include <mc/domain/concept.h>

namespace mc {

/// Points of the plane with |p| <= 1.
///   chart : v = (|p|^2, phi / 2 pi), uniform in area. The Jacobian is the constant pi.
template <Real S> struct Disk {
  using Scalar = S;
  using Point = Vec2<S>;
  using UnitPoint = Vec2<S>;
  static constexpr int dim = 2;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::area;

  Point from_unit(const UnitPoint& v) const { return polar_point<S>(safe_sqrt<S>(v[0]), v[1]); }
  UnitPoint to_unit(const Point& p) const { return {p.squaredNorm(), azimuth_turns<S>(p.x(), p.y())}; }
  S jacobian(const UnitPoint&) const { return pi<S>; }
  bool contains(const Point& p) const { return p.squaredNorm() <= 1 + 4 * std::numeric_limits<S>::epsilon(); }
  template <Real T> Disk<T> cast() const { return {}; }
};

} // namespace mc

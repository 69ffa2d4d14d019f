#pragma once
/// Rings about the origin.

#include <mc/core/error.h>
#include <mc/core/turns.h>
#include <mc/domain/concept.h>

namespace mc {

/// Points of the plane with inner <= |p| <= outer.
///   chart  : v = ((|p|^2 - inner^2) / (outer^2 - inner^2), phi / 2 pi), uniform in area. The Jacobian is the area.
///   error  : v0 is accurate to about eps outer / (outer - inner), the effect of rounding p.
///   throws : Error unless 0 <= inner < outer, both are finite, and the area passes is_valid_scale().
template <Real S> struct Annulus {
  using Scalar = S;
  using Point = Vec2<S>;
  using UnitPoint = Vec2<S>;
  static constexpr int dim = 2;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::area;

  S inner = 0,   ///< Inner radius.
      outer = 1; ///< Outer radius.

  /// The unit disk.
  Annulus() = default;
  /// The ring with these radii.
  Annulus(S inner_, S outer_) : inner(inner_), outer(outer_) {
    using std::isfinite;
    require(
        inner >= 0 && inner < outer && isfinite(outer) && is_valid_scale(area()),
        "Annulus: radii {} and {}; 0 <= inner < outer, both finite, and an area that is neither denormal nor next to "
        "the largest number are needed",
        static_cast<double>(inner), static_cast<double>(outer));
  }

  /// Area of the ring.
  S area() const { return pi<S> * (outer - inner) * (outer + inner); }
  Point from_unit(const UnitPoint& v) const {
    return polar_point<S>(safe_sqrt<S>(inner * inner + v[0] * ((outer - inner) * (outer + inner))), v[1]);
  }
  UnitPoint to_unit(const Point& p) const {
    using std::max, std::min;
    const S r = p.norm(), v = ((r - inner) * (r + inner)) / ((outer - inner) * (outer + inner));
    return {min(max(v, S(0)), S(1)), azimuth_turns<S>(p.x(), p.y())};
  }
  S jacobian(const UnitPoint&) const { return area(); }
  bool contains(const Point& p) const {
    const S r = p.norm(), slack = 4 * std::numeric_limits<S>::epsilon() * outer;
    return r >= inner - slack && r <= outer + slack;
  }
  template <Real T> Annulus<T> cast() const { return {T(inner), T(outer)}; }
};

} // namespace mc

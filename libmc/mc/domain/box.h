#pragma once
/// Axis-aligned boxes of any dimension.

#include <mc/core/error.h>
#include <mc/domain/concept.h>

namespace mc {

/// Points x with lo <= x <= hi in each coordinate. N = Eigen::Dynamic takes the dimension from the bounds.
///   chart  : v = (x - lo) / (hi - lo). The Jacobian is the volume. Rounding never carries a point out of the box.
///   throws : Error unless lo and hi have the same dimension >= 1, and lo < hi with both finite in each coordinate.
template <Real S, int N> struct Box {
  using Scalar = S;
  using Point = Vec<S, N>;
  using UnitPoint = Vec<S, N>;
  static constexpr int dim = N;
  /// Measure of densities on the domain.
  static constexpr Measure measure = N == 2 ? Measure::area : Measure::volume;

  Point lo, ///< Lower corner.
      hi;   ///< Upper corner.

  /// The unit cube.
  Box() requires(N != Eigen::Dynamic) : lo(Point::Zero()), hi(Point::Ones()) {}
  /// The box with these corners.
  Box(const Point& lo_, const Point& hi_) : lo(lo_), hi(hi_) {
    using std::isfinite;
    require(lo.size() >= 1 && lo.size() == hi.size(),
            "Box: bounds of dimension {} and {}; both need the same, at least 1", lo.size(), hi.size());
    for (Eigen::Index i = 0; i < lo.size(); ++i)
      require(isfinite(lo[i]) && isfinite(hi[i]) && lo[i] < hi[i],
              "Box: side {} is [{}, {}]; finite bounds with lo < hi are needed", i, static_cast<double>(lo[i]),
              static_cast<double>(hi[i]));
  }

  /// Number of coordinates, also for N = Eigen::Dynamic.
  int dimension() const { return static_cast<int>(lo.size()); }
  Point from_unit(const UnitPoint& v) const {
    return (lo.array() * (1 - v.array()) + hi.array() * v.array()).max(lo.array()).min(hi.array()).matrix();
  }
  UnitPoint to_unit(const Point& x) const { return ((x - lo).array() / (hi - lo).array()).matrix(); }
  S jacobian(const UnitPoint&) const {
    S volume = 1; // sequential: Eigen's order of products depends on the instruction set
    for (Eigen::Index i = 0; i < lo.size(); ++i) volume *= hi[i] - lo[i];
    return volume;
  }
  bool contains(const Point& x) const { return (x.array() >= lo.array()).all() && (x.array() <= hi.array()).all(); }
  template <Real T> Box<T, N> cast() const { return {lo.template cast<T>().eval(), hi.template cast<T>().eval()}; }
};

/// A rectangle; by default the unit square.
template <Real S> using Square = Box<S, 2>;

} // namespace mc

#pragma once
/// Sets of directions rotated to another axis.

#include <mc/core/frame.h>
#include <mc/domain/sphere.h>

namespace mc {

/// The directions of D, a set about +z, rotated to the z axis of a frame.
///   chart    : The chart of D in the frame.
///   contains : As for D, but accepts directions that rounding carried out over the rim by up to 8 eps.
template <Domain D> struct RotatedDomain {
  using Scalar = typename D::Scalar;
  using Point = typename D::Point;
  using UnitPoint = typename D::UnitPoint;
  static constexpr int dim = D::dim;
  /// Measure of densities on the domain.
  static constexpr Measure measure = D::measure;

  D inner;             ///< The set about +z.
  Frame<Scalar> frame; ///< Its z axis is the new axis.

  /// Rotates a direction from the frame to the world.
  Point to_world(const Point& w) const { return frame.to_world(w).normalized(); }
  /// Rotates a direction from the world to the frame. Moves a direction that is just outside of the rim inside.
  Point to_local(const Point& w) const {
    Point local = frame.to_local(w);
    if (!is_unit<Scalar>(w)) return local;
    local.normalize();
    if (inner.contains(local)) return local;
    // Rotates by 8 eps toward the axis. Changes x and y as well as z, because x and y determine the rim of a narrow
    // cap.
    using std::max, std::sqrt;
    const Scalar turn = 8 * std::numeric_limits<Scalar>::epsilon();
    const Scalar sine = sqrt(Scalar(local.x() * local.x() + local.y() * local.y()));
    const Scalar factor = sine > 0 ? Scalar(max(Scalar(1 - turn * local.z() / sine), Scalar(0))) : Scalar(1);
    return Point(local.x() * factor, local.y() * factor, local.z() + turn * sine).normalized();
  }
  Point from_unit(const UnitPoint& v) const { return to_world(inner.from_unit(v)); }
  UnitPoint to_unit(const Point& w) const { return inner.to_unit(to_local(w)); }
  Scalar jacobian(const UnitPoint& v) const { return inner.jacobian(v); }
  bool contains(const Point& w) const { return is_unit<Scalar>(w) && inner.contains(to_local(w).normalized()); }
  template <Real T> auto cast() const {
    return RotatedDomain<decltype(inner.template cast<T>())>{inner.template cast<T>(),
                                                             Frame<T>::from_z(cast_point<T>(frame.z).normalized())};
  }
};

} // namespace mc

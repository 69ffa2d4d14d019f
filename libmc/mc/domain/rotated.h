#pragma once
/// Sets of directions turned to another axis.

#include <mc/core/frame.h>
#include <mc/domain/sphere.h>

namespace mc {

/// The directions of D, a set about +z, in the frame whose z axis is the new axis.
///   chart    : that of D in the frame
///   contains : as D, but a direction on the rim that rounding carried out by up to 8 eps still counts
template <Domain D> struct RotatedDomain {
  using Scalar = typename D::Scalar;
  using Point = typename D::Point;
  using UnitPoint = typename D::UnitPoint;
  static constexpr int dim = D::dim;
  static constexpr Measure measure = D::measure;

  D inner;
  Frame<Scalar> frame;

  Point to_world(const Point& w) const { return frame.to_world(w).normalized(); }
  Point to_local(const Point& w) const {
    Point local = frame.to_local(w);
    if (!is_unit<Scalar>(w)) return local;
    local.normalize();
    if (inner.contains(local)) return local;
    // Turned by 8 eps toward the axis: of a narrow cap the rim lies in x and y, not in z.
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

#pragma once
/// Axis-aligned boxes.

#include <render/core/types.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace render {

/// A ball, in double.
struct Ball {
  Vec3d center = Vec3d::Zero(); ///< Centre.
  double radius = 0;            ///< Radius >= 0.
};

/// An axis-aligned box; empty until something is added.
struct Bounds {
  /// Smallest and largest coordinates.
  Vec3 lo = Vec3::Constant(mc::infinity<Float>), ///< Smallest coordinates.
      hi = Vec3::Constant(-mc::infinity<Float>); ///< Largest coordinates.

  /// The box of Floats around a box of doubles, rounded outward.
  static Bounds around(const Eigen::AlignedBox3d& box) {
    Bounds b;
    for (int a = 0; a < 3; ++a) {
      b.lo[a] = std::nextafter(Float(box.min()[a]), -mc::infinity<Float>);
      b.hi[a] = std::nextafter(Float(box.max()[a]), mc::infinity<Float>);
    }
    return b;
  }

  /// Extends the box to contain p.
  void add(const Vec3& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  /// Extends the box to contain b.
  void add(const Bounds& b) {
    lo = lo.cwiseMin(b.lo);
    hi = hi.cwiseMax(b.hi);
  }
  /// Half the surface area; 0 for an empty box.
  Float half_area() const {
    const Vec3 e = hi - lo;
    return e.x() >= 0 ? e.x() * e.y() + e.y() * e.z() + e.z() * e.x() : Float(0);
  }
  /// For a line p + t d that crosses the box, the t at which it leaves. For other lines, no point with larger t lies in
  /// the box.
  double exit_distance(const Vec3d& p, const Vec3d& d) const {
    double t = mc::infinity<double>;
    for (int i = 0; i < 3; ++i)
      if (d[i] != 0) t = std::min(t, (double(d[i] > 0 ? hi[i] : lo[i]) - p[i]) / d[i]);
    return t;
  }
};

} // namespace render

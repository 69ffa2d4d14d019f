#pragma once
/// Distributions on the unit disk.

#include <mc/domain/disk.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

/// Uniform points on the unit disk by the low-distortion concentric map.
///   sample : u in [0,1)^2 -> p in R^2, |p| <= 1.
///   pdf    : 1 / pi [1/area]; 0 for |p| > 1.
///   invert : |invert(sample(u)) - u| <= 8 eps.
///   Source : [ShirleyChiu97]. The polar map (UniformDiskPolar) distorts strata near the centre.
template <Real S> struct UniformDisk {
  using Scalar = S;
  using Domain = Disk<S>;

  Domain domain() const { return {}; }

  Vec2<S> sample(const Vec2<S>& u) const {
    using std::abs;
    const S a = 2 * u[0] - 1, b = 2 * u[1] - 1;
    // The wedge |a| > |b| measures the azimuth from the x axis, the other wedge from the y axis. Both angles stay
    // within
    // an eighth of a turn.
    const bool wide = abs(a) > abs(b);
    const S r = wide ? a : b, other = wide ? b : a;
    const CosSin<S> phi = cos_sin_octant<S>(other / (r == 0 ? S(1) : r) / 8);
    const S along = r * phi.cos, across = r * phi.sin;
    return {choose<S>(wide, along, across), choose<S>(wide, across, along)};
  }

  S pdf(const Vec2<S>& p) const { return domain().contains(p) ? S(1 / pi<S>) : S(0); }

  Vec2<S> invert(const Vec2<S>& p) const {
    using std::abs, std::atan;
    const S r = p.norm();
    if (r == 0) return {S(0.5), S(0.5)};
    S a, b;
    if (abs(p.x()) > abs(p.y())) {
      a = p.x() < 0 ? S(-r) : r;
      b = a * (4 / pi<S>)*S(atan(S(p.y() / p.x())));
    } else {
      b = p.y() < 0 ? S(-r) : r;
      a = b * (4 / pi<S>)*S(atan(S(p.x() / p.y())));
    }
    return clamp_to_unit<S, 2>({(a + 1) / 2, (b + 1) / 2});
  }

  template <Real T> UniformDisk<T> cast() const { return {}; }
};

/// Uniform points on the unit disk by the polar map, kept for comparison with UniformDisk.
/// Strata become slivers near the centre and bands at the rim.
///   sample : r = sqrt(u0), phi = 2 pi u1, so that u0 = |p|^2.
///   pdf    : 1 / pi [1/area]; 0 for |p| > 1.
///   invert : |invert(sample(u)) - u| <= 8 eps.
template <Real S> struct UniformDiskPolar {
  using Scalar = S;
  using Domain = Disk<S>;

  Domain domain() const { return {}; }
  Vec2<S> sample(const Vec2<S>& u) const { return domain().from_unit(u); }
  S pdf(const Vec2<S>& p) const { return domain().contains(p) ? S(1 / pi<S>) : S(0); }
  Vec2<S> invert(const Vec2<S>& p) const { return clamp_to_unit<S, 2>(domain().to_unit(p)); }
  template <Real T> UniformDiskPolar<T> cast() const { return {}; }
};

} // namespace mc

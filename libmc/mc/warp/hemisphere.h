#pragma once
/// Distributions on the upper hemisphere about +z.

#include <mc/domain/hemisphere.h>
#include <mc/warp/concept.h>
#include <mc/warp/disk.h>

#include <algorithm>

namespace mc {

/// Uniform directions on the hemisphere.
///   sample : z = 1 - u0, phi = 2 pi u1.
///   pdf    : 1 / (2 pi) [1/sr]; 0 below the horizon.
///   invert : |invert(sample(u)) - u| <= 8 eps.
///   Source : [ShirleyWangZimmerman96]. The map computes with 1 - z instead of z, so directions near the pole keep
///            their precision.
template <Real S> struct UniformHemisphere {
  using Scalar = S;
  using Domain = Hemisphere<S>;

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const { return domain().from_unit(u); }
  S pdf(const Vec3<S>& w) const { return w.z() >= 0 ? S(1 / (2 * pi<S>)) : S(0); }
  Vec2<S> invert(const Vec3<S>& w) const { return clamp_to_unit<S, 2>(domain().to_unit(w)); }
  template <Real T> UniformHemisphere<T> cast() const { return {}; }
};

/// Directions with density proportional to cos(theta): a uniform point of the disk, lifted to the hemisphere.
///   sample : concentric disk point p, z = sqrt(1 - |p|^2). 1 - |p|^2 is computed from u without cancellation. It is at
///            least eps / 2, half a step of u, so the pdf of a sample is positive on the rim too.
///   pdf    : z / pi [1/sr]; 0 below the horizon.
///   invert : |invert(sample(u)) - u| <= 8 eps.
///   Source : [Malley88]; the disk by [ShirleyChiu97].
template <Real S> struct CosineHemisphere {
  using Scalar = S;
  using Domain = Hemisphere<S>;

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const {
    using std::max, std::min, std::sqrt;
    const Vec2<S> p = UniformDisk<S>{}.sample(u);
    // 1 - |p| is twice the distance to the nearest edge of the square, without rounding.
    const S t = 2 * min(min(u[0], S(1 - u[0])), min(u[1], S(1 - u[1])));
    return {p.x(), p.y(), S(sqrt(max(S(t * (2 - t)), S(std::numeric_limits<S>::epsilon() / 2))))};
  }
  S pdf(const Vec3<S>& w) const { return w.z() > 0 ? S(w.z() / pi<S>) : S(0); }
  Vec2<S> invert(const Vec3<S>& w) const { return UniformDisk<S>{}.invert({w.x(), w.y()}); }
  template <Real T> CosineHemisphere<T> cast() const { return {}; }
};

} // namespace mc

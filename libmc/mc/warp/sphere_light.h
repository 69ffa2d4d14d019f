#pragma once
/// Directions towards a sphere.

#include <mc/core/frame.h>
#include <mc/warp/cone.h>

namespace mc {

/// Uniform directions, about +z, of the cone that a sphere fills; z points from the viewer to its centre (frame()).
///   made from : the centre relative to the viewer, and the radius; the viewer may be anywhere
///   sample    : outside, the cone with 1 - cos = s^2 / (1 + cos), s = radius / distance, which no distance cancels; on
///               the surface the hemisphere towards the centre; inside every direction
///   pdf       : 1 / (2 pi (1 - cos)) [1/sr]; 0 outside the cone. Relative error 16 eps in the local frame: a world
///               direction in S holds the offset from the axis only to eps, so narrower cones than eps need the local
///               form
///   invert    : |invert(sample(u)) - u| <= 16 eps
///   throws    : Error unless the centre is finite, radius is finite and > 0, and radius / distance > 1e-18
///   Source    : [ShirleyWangZimmerman96]
template <Real S> class SphereLight {
 public:
  using Scalar = S;
  using Domain = Cap<S>;

  SphereLight(const Vec3<S>& center, S radius)
      : SphereLight(center, radius, center.allFinite() ? S(center.stableNorm()) : std::numeric_limits<S>::quiet_NaN()) {
  }

  Domain domain() const { return cone_.domain(); }
  Vec3<S> sample(const Vec2<S>& u) const { return cone_.sample(u); }
  S pdf(const Vec3<S>& w) const { return cone_.pdf(w); }
  Vec2<S> invert(const Vec3<S>& w) const { return cone_.invert(w); }
  const Frame<S>& frame() const { return frame_; }
  S solid_angle() const { return 2 * pi<S> * cone_.domain().h; }
  template <Real T> SphereLight<T> cast() const { return {cast_point<T>(center_), T(radius_)}; }

 private:
  SphereLight(const Vec3<S>& center, S radius, S distance)
      : center_(center), radius_(radius),
        frame_(Frame<S>::from_z(distance > 0 ? Vec3<S>(center / distance) : Vec3<S>(0, 0, 1))),
        cone_(UniformCone<S>::from_one_minus_cos(filled(radius, distance))) {}

  static S filled(const S& radius, const S& distance) {
    using std::isfinite, std::sqrt;
    require(isfinite(radius) && radius > 0 && isfinite(distance) && distance >= 0,
            "SphereLight: radius {} must be finite and > 0, distance {} finite", static_cast<double>(radius),
            static_cast<double>(distance));
    if (distance < radius) return S(2);
    const S s = radius / distance;
    require(s > S(1e-18), "SphereLight: radius / distance = {} must exceed 1e-18", static_cast<double>(s));
    return s * s / (1 + S(sqrt(S(((distance - radius) / distance) * (1 + s)))));
  }

  Vec3<S> center_;
  S radius_;
  Frame<S> frame_;
  UniformCone<S> cone_;
};

} // namespace mc

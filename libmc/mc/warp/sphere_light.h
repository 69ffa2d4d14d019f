#pragma once
/// Directions towards a sphere.

#include <mc/core/dot.h>
#include <mc/core/frame.h>
#include <mc/warp/cone.h>

namespace mc {

/// Uniform directions in the cone that a sphere subtends. They are relative to frame(): z points from the viewer to the
/// centre of the sphere.
///   made from : the centre relative to the viewer, and the radius. The viewer may be anywhere.
///   sample    : outside the sphere, the cone with 1 - cos = s^2 / (1 + cos), s = radius / distance; it does not cancel
///               at any distance. Near the surface, cos = sqrt(distance^2 - radius^2) / distance with twice the digits.
///               On the surface, the hemisphere towards the centre. Inside, all directions.
///   pdf       : 1 / (2 pi (1 - cos)) [1/sr]; 0 outside the cone. Relative error 16 eps in the local frame. A world
///               direction in S holds its offset from the axis only to eps, so cones narrower than eps need local
///               directions.
///   invert    : |invert(sample(u)) - u| <= 16 eps.
///   throws    : Error unless the centre is finite, radius passes is_valid_scale, and radius / distance > 1e-18.
///   Source    : [ShirleyWangZimmerman96].
template <Real S> class SphereLight {
 public:
  using Scalar = S;
  using Domain = Cap<S>;

  /// A sphere with its centre relative to the viewer.
  SphereLight(const Vec3<S>& center, S radius) : SphereLight(center, radius, length(center)) {}

  Domain domain() const { return cone_.domain(); }
  Vec3<S> sample(const Vec2<S>& u) const { return cone_.sample(u); }
  S pdf(const Vec3<S>& w) const { return cone_.pdf(w); }
  Vec2<S> invert(const Vec3<S>& w) const { return cone_.invert(w); }
  /// Frame with z from the viewer to the centre of the sphere.
  const Frame<S>& frame() const { return frame_; }
  /// Solid angle of the cone [sr].
  S solid_angle() const { return 2 * pi<S> * cone_.domain().h; }
  template <Real T> SphereLight<T> cast() const { return {cast_point<T>(center_), T(radius_)}; }

 private:
  SphereLight(const Vec3<S>& center, S radius, S distance)
      : center_(center), radius_(radius),
        frame_(Frame<S>::from_z(distance > 0 ? Vec3<S>(center * (1 / distance)) : Vec3<S>(0, 0, 1))),
        cone_(UniformCone<S>::from_one_minus_cos(filled(center, radius, distance))) {}

  // |v|. Eigen's stableNorm is slow, and only lengths far from 1 need it.
  static S length(const Vec3<S>& v) {
    using Limits = std::numeric_limits<S>;
    using std::sqrt;
    const S square = v.squaredNorm();
    if (square > Limits::min() / Limits::epsilon() && square <= Limits::max()) return S(sqrt(square));
    return v.allFinite() ? S(v.stableNorm()) : Limits::quiet_NaN();
  }

  // 1 - cosine of the half angle of the cone.
  static S filled(const Vec3<S>& center, const S& radius, const S& distance) {
    using std::frexp, std::isfinite, std::ldexp, std::sqrt;
    require(
        is_valid_scale(radius) && isfinite(distance),
        "SphereLight: radius {} must be finite and > 0, neither denormal nor next to the largest number, distance {} "
        "finite",
        static_cast<double>(radius), static_cast<double>(distance));
    if (distance < radius / 2) return S(2);
    const S sine = radius / distance;
    require(sine > S(1e-18), "SphereLight: radius / distance = {} must exceed 1e-18", static_cast<double>(sine));
    if (sine < S(0.75)) return sine * sine / (1 + S(sqrt(S(1 - sine * sine))));
    // Near the surface the cosine is the root of distance^2 - radius^2, which cancels. A rounded distance has too few
    // digits for it.
    int exponent;
    frexp(radius, &exponent);
    const auto scaled = [&](const S& x) { return S(ldexp(x, -exponent)); }; // keeps squares in range; exact
    const Vec<S, 4> sum(scaled(center.x()), scaled(center.y()), scaled(center.z()), scaled(radius));
    const Vec<S, 4> difference(sum[0], sum[1], sum[2], -sum[3]);
    const S root2 = accurate_dot<S, 4>(sum, difference);
    return root2 >= 0 ? S(1 - S(sqrt(root2)) / scaled(distance)) : S(2);
  }

  Vec3<S> center_;
  S radius_;
  Frame<S> frame_;
  UniformCone<S> cone_;
};

} // namespace mc

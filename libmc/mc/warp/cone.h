#pragma once
/// Uniform directions in a cone.

#include <mc/domain/cap.h>
#include <mc/warp/concept.h>

namespace mc {

/// Uniform directions within a given angle of +z.
///   made from : the angle [rad], its cosine, 1 - cosine, or its squared sine (angle <= pi / 2). Pass the form that you
///               have: the rounded cosine of a narrow cone has lost most digits of the angle.
///   sample    : 1 - z = u0 (1 - cos), phi = 2 pi u1.
///   pdf       : 1 / (2 pi (1 - cos)) [1/sr]; 0 outside the cone.
///   invert    : |invert(sample(u)) - u| <= 16 eps for any angle.
///   throws    : Error unless the angle lies in (0, pi] and 1 - cos is at least 1e-37.
///   Source    : [ShirleyWangZimmerman96], written in 1 - cos so that nothing cancels.
template <Real S> class UniformCone {
 public:
  using Scalar = S;
  using Domain = Cap<S>;

  /// Cone with 1 - cos(angle) = h.
  static UniformCone from_one_minus_cos(S h) { return UniformCone(h); }
  /// Cone with the given half angle [rad].
  static UniformCone from_angle(S angle) {
    using std::sin;
    require(angle > 0 && angle <= pi<S>, "UniformCone: angle {} must lie in (0, pi]", static_cast<double>(angle));
    return UniformCone(2 * sqr<S>(sin(S(angle / 2)))); // 1 - cos a = 2 sin^2(a/2)
  }
  /// Cone with cos(angle) = cosine.
  static UniformCone from_cos(S cosine) {
    require(cosine >= -1 && cosine < 1, "UniformCone: cosine {} must lie in [-1, 1)", static_cast<double>(cosine));
    return UniformCone(1 - cosine);
  }
  /// Cone with sin(angle)^2 = sin2 and angle <= pi / 2.
  static UniformCone from_sin2(S sin2) {
    using std::sqrt;
    require(sin2 > 0 && sin2 <= 1, "UniformCone: squared sine {} must lie in (0, 1]", static_cast<double>(sin2));
    return UniformCone(sin2 / (1 + S(sqrt(S(1 - sin2)))));
  }

  /// Density of from_sin2(sin2) inside its cone [1/sr], within 4 eps, without making the cone. Saves one division.
  /// Does not check sin2.
  static S pdf_from_sin2(S sin2) {
    using std::sqrt;
    return (1 + S(sqrt(S(1 - sin2)))) / (2 * pi<S> * sin2);
  }

  Domain domain() const { return cap_; }
  Vec3<S> sample(const Vec2<S>& u) const { return cap_.from_unit(u); }
  S pdf(const Vec3<S>& w) const { return cap_.contains_direction(w) ? S(1 / (2 * pi<S> * cap_.h)) : S(0); }
  Vec2<S> invert(const Vec3<S>& w) const { return clamp_to_unit<S, 2>(cap_.to_unit(w)); }
  template <Real T> UniformCone<T> cast() const { return UniformCone<T>::from_one_minus_cos(T(cap_.h)); }

 private:
  explicit UniformCone(S h) : cap_(h) {}
  Cap<S> cap_;
};

} // namespace mc

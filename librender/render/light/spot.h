#pragma once
/// Spot lights.

#include <render/core/transform.h>
#include <render/light/concept.h>

#include <mc/warp/cone.h>
#include <mc/warp/rotated.h>

#include <algorithm>
#include <numbers>

namespace render {

/// A point that emits into a cone. Its intensity is constant up to the beam angle. From there it falls linearly in the
/// angle to 0 at the cutoff angle.
///   sample : the direction toward the point; the irradiance across it is intensity / distance^2. None outside the
///            cone.
///   power  : 2 pi I (1 - (sin c - sin b) / (c - b)) for the beam angle b and the cutoff angle c.
///   throws : Error unless the position is finite and the axis is finite and not 0. Error unless the intensity on the
///            axis [W/sr] is finite and >= 0 and 0 <= beam <= cutoff, 0 < cutoff <= 180 degrees.
///   Source : the emitter `spot` of Mitsuba.
class SpotLight {
 public:
  /// Angles to the axis [degrees].
  struct Cone {
    double cutoff = 20; ///< Angle at which the light ends.
    double beam = 15;   ///< Angle up to which the intensity is constant.
  };

  /// A light at a position [scene units] that shines along an axis of any length, with an intensity [W/sr].
  SpotLight(const Vec3d& position, const Vec3d& axis, const Spectrum& intensity, const Cone& cone)
      : position_(position), intensity_(checked_radiance("spot light: intensity", intensity)), cutoff_(cone.cutoff),
        beam_(cone.beam), directions_(checked_cone(position, axis, cone)) {
    cutoff_ *= degree;
    beam_ *= degree;
  }

  Spectrum Le(const Vec3&, const SurfacePoint*) const { return Spectrum::Zero(); }
  std::optional<LightSample> sample(const Vec3& ref, const Vec2&) const {
    const Vec3d way = position_ - ref.cast<double>();
    const double d2 = way.squaredNorm(), share = d2 > 0 ? falloff(-way) : 0;
    if (!(share > 0)) return {};
    SurfacePoint end; // with the normals toward the reference point
    end.p = position_.cast<Float>();
    end.ng = end.ns = -(way / std::sqrt(d2)).cast<Float>();
    return LightSample{-end.ng, (intensity_.cast<double>() * (share / d2)).cast<Float>(), 1, end};
  }
  Float pdf(const Vec3&, const Vec3&, const SurfacePoint*) const { return 0; }
  std::optional<EmissionSample> sample_emission(const EmissionTargets& targets, const Vec2&, const Vec2& v) const {
    const Vec3 p = position_.cast<Float>();
    const auto s = targets.sample_direction(p, v, directions_);
    const double share = s ? falloff(s->wi.cast<double>()) : 0;
    if (!(share > 0)) return {};
    return emission_from_point(p, *s, intensity_ * Float(share));
  }
  double emission_pdf(const EmissionTargets& targets, const Vec3& ref, const Vec3& wi, const SurfacePoint*) const {
    return double(targets.direction_pdf(position_.cast<Float>(), -wi, directions_)) /
           (position_ - ref.cast<double>()).squaredNorm();
  }
  /// Luminous power [W].
  double power(double) const {
    // sin c - sin b = 2 cos m sin h for the mean angle m and half the difference h
    const double m = (cutoff_ + beam_) / 2, h = (cutoff_ - beam_) / 2, sinc = h > 0 ? std::sin(h) / h : 1;
    return 2 * mc::pi<double> * double(luminance(intensity_)) *
           (2 * mc::sqr(std::sin(m / 2)) + std::cos(m) * (1 - sinc));
  }
  double irradiance(const Vec3& ref) const {
    constexpr double touching = 1e-60, outside = 1e-3; // keep the quotient finite and > 0
    const Vec3d way = ref.cast<double>() - position_;
    return double(luminance(intensity_)) * std::max(falloff(way), outside) / std::max(way.squaredNorm(), touching);
  }
  bool is_delta() const { return true; }
  bool is_infinite() const { return false; }
  bool is_sampled() const { return true; }

  /// Intensity along d over the intensity on the axis, in [0, 1]; d may have any length > 0.
  double falloff(const Vec3d& d) const {
    const Vec3d axis = directions_.frame.z.template cast<double>();
    // by the tangent, because acos loses half of the digits of a small angle
    const double angle = std::atan2(mc::cross<double>(axis, d).norm(), axis.dot(d));
    if (angle <= beam_) return 1;
    return angle < cutoff_ ? (cutoff_ - angle) / (cutoff_ - beam_) : 0;
  }

 private:
  using Directions = mc::Rotated<mc::UniformCone<Float>>;
  static constexpr double degree = std::numbers::pi / 180;

  static Directions checked_cone(const Vec3d& position, const Vec3d& axis, const Cone& cone) {
    mc::require(position.allFinite(), "spot light: position ({}, {}, {}) must be finite", position[0], position[1],
                position[2]);
    const double largest = axis.cwiseAbs().maxCoeff();
    mc::require(axis.allFinite() && largest > 0, "spot light: axis ({}, {}, {}) must be finite and not 0", axis[0],
                axis[1], axis[2]);
    mc::require(cone.cutoff > 0 && cone.cutoff <= 180, "spot light: cutoff angle {} must lie in (0, 180] degrees",
                cone.cutoff);
    mc::require(cone.beam >= 0 && cone.beam <= cone.cutoff,
                "spot light: beam width {} must lie in [0, {}] degrees, up to the cutoff angle", cone.beam,
                cone.cutoff);
    return {mc::UniformCone<Float>::from_one_minus_cos(Float(2 * mc::sqr(std::sin(cone.cutoff * degree / 2)))),
            (axis / largest).normalized().cast<Float>().normalized()};
  }

  Vec3d position_;
  Spectrum intensity_;
  double cutoff_, beam_;  ///< Angles to the axis [rad].
  Directions directions_; ///< Uniform within the cutoff angle.
};

} // namespace render

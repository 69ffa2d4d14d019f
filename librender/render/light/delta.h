#pragma once
/// Point lights and directional lights. Rays cannot hit them, and their shadows are hard.

#include <render/light/concept.h>

#include <mc/warp/sphere.h>

#include <algorithm>

namespace render {

/// A point that emits uniformly in all directions.
///   sample : the direction toward the point; the irradiance across it is intensity / distance^2.
///   throws : Error unless the position is finite and the intensity [W/sr] is finite and >= 0.
class PointLight {
 public:
  /// A light at a position [scene units], with an intensity [W/sr].
  PointLight(const Vec3d& position, const Spectrum& intensity)
      : position_(position), intensity_(checked_radiance("point light: intensity", intensity)) {
    mc::require(position.allFinite(), "point light: position ({}, {}, {}) must be finite", position[0], position[1],
                position[2]);
  }

  /// Position.
  const Vec3d& position() const { return position_; }
  /// Intensity [W/sr].
  const Spectrum& intensity() const { return intensity_; }

  Spectrum Le(const Vec3&, const SurfacePoint*) const { return Spectrum::Zero(); }
  std::optional<LightSample> sample(const Vec3& ref, const Vec2&) const {
    // In double: the squares of 1e-30 and of 1e30 are outside the range of float.
    const Vec3d way = position_ - ref.cast<double>();
    const double d2 = way.squaredNorm();
    if (!(d2 > 0)) return {};
    SurfacePoint end; // with the normals toward the reference point
    end.p = position_.cast<Float>();
    end.ng = end.ns = -(way / std::sqrt(d2)).cast<Float>();
    return LightSample{-end.ng, (intensity_.cast<double>() / d2).cast<Float>(), 1, end};
  }
  Float pdf(const Vec3&, const Vec3&, const SurfacePoint*) const { return 0; }
  std::optional<EmissionSample> sample_emission(const EmissionTargets& targets, const Vec2&, const Vec2& v) const {
    const Vec3 p = position_.cast<Float>();
    const auto s = targets.sample_direction(p, v, mc::UniformSphere<Float>{});
    if (!s) return {};
    return emission_from_point(p, *s, intensity_);
  }
  double emission_pdf(const EmissionTargets& targets, const Vec3& ref, const Vec3& wi, const SurfacePoint*) const {
    return double(targets.direction_pdf(position_.cast<Float>(), -wi, mc::UniformSphere<Float>{})) /
           (position_ - ref.cast<double>()).squaredNorm();
  }
  /// Luminous power [W].
  double power(double) const { return 4 * mc::pi<double> * double(luminance(intensity_)); }
  double irradiance(const Vec3& ref) const {
    constexpr double touching = 1e-60; // keeps the quotient finite
    return double(luminance(intensity_)) / std::max((position_ - ref.cast<double>()).squaredNorm(), touching);
  }
  bool is_delta() const { return true; }
  bool is_infinite() const { return false; }
  bool is_sampled() const { return true; }

 private:
  Vec3d position_;
  Spectrum intensity_;
};

/// Parallel light from infinitely far away: a sun without size.
///   sample : the direction toward the light, with the irradiance [W/m^2] across it.
///   throws : Error unless the direction is finite and not 0 and the irradiance is finite and >= 0.
class DirectionalLight {
 public:
  /// Light from infinitely far away.
  ///   direction  : direction of propagation, of any length.
  ///   irradiance : irradiance across the direction [W/m^2].
  DirectionalLight(const Vec3d& direction, const Spectrum& irradiance)
      : irradiance_(checked_radiance("directional light: irradiance", irradiance)) {
    const double largest = direction.cwiseAbs().maxCoeff();
    mc::require(direction.allFinite() && largest > 0,
                "directional light: direction ({}, {}, {}) must be finite and not 0", direction[0], direction[1],
                direction[2]);
    wi_ = -(direction / largest).normalized().cast<Float>();
  }

  Spectrum Le(const Vec3&, const SurfacePoint*) const { return Spectrum::Zero(); }
  std::optional<LightSample> sample(const Vec3&, const Vec2&) const { return LightSample{wi_, irradiance_, 1, {}}; }
  Float pdf(const Vec3&, const Vec3&, const SurfacePoint*) const { return 0; }
  std::optional<EmissionSample> sample_emission(const EmissionTargets& targets, const Vec2& u, const Vec2& v) const {
    return sample_infinite_emission(*this, targets, u, v);
  }
  double emission_pdf(const EmissionTargets& targets, const Vec3& ref, const Vec3& wi, const SurfacePoint*) const {
    return targets.parallel_pdf(ref, wi);
  }
  /// Luminous power [W] into a ball of this radius.
  double power(double radius) const { return mc::pi<double> * mc::sqr(radius) * double(luminance(irradiance_)); }
  double irradiance(const Vec3&) const { return double(luminance(irradiance_)); }
  bool is_delta() const { return true; }
  bool is_infinite() const { return false; } // it does not emit along camera rays
  bool is_sampled() const { return true; }

 private:
  Vec3 wi_;
  Spectrum irradiance_;
};

} // namespace render

#pragma once
/// Constant and gradient skies.

#include <render/light/concept.h>

#include <mc/warp/linear.h>
#include <mc/warp/sphere.h>

namespace render {

/// The same radiance from every direction.
///   sample : uniform on the sphere.
///   throws : Error unless the radiance is finite and >= 0.
class ConstantBackground {
 public:
  /// A sky of constant radiance.
  explicit ConstantBackground(const Spectrum& radiance)
      : radiance_(checked_radiance("constant background: radiance", radiance)) {}

  Spectrum Le(const Vec3&, const SurfacePoint* light_point) const {
    return light_point ? Spectrum(Spectrum::Zero()) : radiance_;
  }
  std::optional<LightSample> sample(const Vec3&, const Vec2& u) const {
    const Vec3 wi = mc::UniformSphere<Float>{}.sample(u);
    return LightSample{wi, radiance_, mc::UniformSphere<Float>{}.pdf(wi), {}};
  }
  Float pdf(const Vec3&, const Vec3& wi, const SurfacePoint* light_point) const {
    return light_point ? Float(0) : mc::UniformSphere<Float>{}.pdf(wi);
  }
  std::optional<EmissionSample> sample_emission(const EmissionTargets& targets, const Vec2& u, const Vec2& v) const {
    return sample_infinite_emission(*this, targets, u, v);
  }
  double emission_pdf(const EmissionTargets& targets, const Vec3& ref, const Vec3& wi,
                      const SurfacePoint* light_point) const {
    return double(pdf(ref, wi, light_point)) * targets.parallel_pdf(ref, wi);
  }
  /// Luminous power [W] into a ball of this radius.
  double power(double radius) const { return 4 * mc::sqr(mc::pi<double> * radius) * double(luminance(radiance_)); }
  double irradiance(const Vec3&) const { return mc::pi<double> * double(luminance(radiance_)); }
  bool is_delta() const { return false; }
  bool is_infinite() const { return true; }
  bool is_sampled() const { return false; }

 private:
  Spectrum radiance_;
};

/// Radiance that is linear in the height of the direction: `bottom` at -y, `top` at +y. The default is the sky of
/// [Shirley16], from white to (.5, .7, 1).
///   sample : linear in the height by luminance, uniform in azimuth.
///   throws : Error unless both colours are finite and >= 0.
class GradientBackground {
 public:
  /// A sky between two colours.
  explicit GradientBackground(const Spectrum& bottom = Spectrum::Ones(),
                              const Spectrum& top = Spectrum(Float(0.5), Float(0.7), 1))
      : bottom_(checked_radiance("gradient background: bottom", bottom)),
        top_(checked_radiance("gradient background: top", top)) {
    if (!is_black(bottom) || !is_black(top)) height_ = mc::Linear<Float>(luminance(bottom), luminance(top));
  }

  Spectrum Le(const Vec3& wi, const SurfacePoint* light_point) const {
    if (light_point) return Spectrum::Zero();
    const Float t = height(wi);
    return (1 - t) * bottom_ + t * top_;
  }
  std::optional<LightSample> sample(const Vec3& ref, const Vec2& u) const {
    // The sphere's chart maps [0, 1] uniformly in height from one pole to the other.
    const Vec3 w = mc::UniformSphere<Float>{}.sample({1 - height_.sample(u[0]), u[1]});
    const Vec3 wi(w.y(), w.z(), w.x());
    const Float density = pdf(ref, wi, nullptr);
    if (!(density > 0)) return {};
    return LightSample{wi, Le(wi, nullptr), density, {}};
  }
  Float pdf(const Vec3&, const Vec3& wi, const SurfacePoint* light_point) const {
    return light_point ? Float(0) : height_.pdf(height(wi)) * mc::UniformSphere<Float>{}.pdf(wi);
  }
  std::optional<EmissionSample> sample_emission(const EmissionTargets& targets, const Vec2& u, const Vec2& v) const {
    return sample_infinite_emission(*this, targets, u, v);
  }
  double emission_pdf(const EmissionTargets& targets, const Vec3& ref, const Vec3& wi,
                      const SurfacePoint* light_point) const {
    return double(pdf(ref, wi, light_point)) * targets.parallel_pdf(ref, wi);
  }
  /// Luminous power [W] into a ball of this radius.
  double power(double radius) const {
    return 2 * mc::sqr(mc::pi<double> * radius) * (double(luminance(bottom_)) + double(luminance(top_)));
  }
  double irradiance(const Vec3&) const {
    return mc::pi<double> * double(std::max(luminance(bottom_), luminance(top_)));
  }
  bool is_delta() const { return false; }
  bool is_infinite() const { return true; }
  bool is_sampled() const { return false; }

 private:
  static Float height(const Vec3& wi) { return (wi.y() + 1) / 2; }

  Spectrum bottom_, top_;
  mc::Linear<Float> height_;
};

} // namespace render

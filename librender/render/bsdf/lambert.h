#pragma once
/// Diffuse reflection.

#include <render/bsdf/concept.h>

#include <mc/warp/hemisphere.h>

#include <numbers>

namespace render {

/// Lambertian reflector, the same on both sides.
///   eval   : albedo / pi if wo and wi are on the same side, else 0.
///   sample : cosine-distributed on the side of wo; pdf |cos wi| / pi [1/sr].
///   throws : Error unless the albedo lies in [0, 1].
class Lambert {
 public:
  /// Reflector of an albedo.
  explicit Lambert(const Spectrum& albedo = Spectrum::Constant(Float(0.5)))
      : albedo_(checked_reflectance("diffuse: reflectance", albedo)) {}

  std::optional<BsdfSample> sample(const Vec3& wo, Float, const Vec2& u) const {
    Vec3 wi = mc::CosineHemisphere<Float>{}.sample(u);
    const Float density = wi.z() * inv_pi;
    if (!(density > 0)) return {};
    if (wo.z() < 0) wi.z() = -wi.z();
    return BsdfSample{wi, albedo_ * inv_pi, density};
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const {
    return wo.z() * wi.z() > 0 ? Spectrum(albedo_ * inv_pi) : Spectrum(Spectrum::Zero());
  }
  Float pdf(const Vec3& wo, const Vec3& wi) const { return wo.z() * wi.z() > 0 ? std::abs(wi.z()) * inv_pi : Float(0); }
  Float eta(const Vec3&, const Vec3&) const { return 1; }
  Float albedo(const Vec3&) const { return albedo_.maxCoeff(); }
  Lobes lobes() const { return Lobes::diffuse(); }
  /// Albedo of each channel.
  const Spectrum& albedo() const { return albedo_; }
  /// Replaces the albedo. The caller ensures that it lies in [0, 1].
  void set_diffuse_reflectance(const Spectrum& albedo) { albedo_ = albedo; }

 private:
  static constexpr Float inv_pi = std::numbers::inv_pi_v<Float>;
  Spectrum albedo_;
};

} // namespace render

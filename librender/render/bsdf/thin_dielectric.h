#pragma once
/// Thin smooth glass.

#include <render/bsdf/dielectric.h>

namespace render {

/// A pane of glass of relative index eta that is too thin to displace light. It has two delta lobes: the mirror
/// direction and straight on.
///   f      : reflectance 2 R / (1 + R) for the Fresnel reflectance R of one surface: the sum over all reflections
///            between the two surfaces, R + (1 - R)^2 R / (1 - R^2). The rest passes.
///   throws : Error unless eta is a checked_ior and the colours lie in [0, 1].
///   Source : [BornWolf99] section 1.5, added incoherently.
class ThinDielectric {
 public:
  /// Glass with the relative index eta and tints of reflection and transmission.
  explicit ThinDielectric(Float eta = Float(1.5), const Spectrum& reflectance = Spectrum::Ones(),
                          const Spectrum& transmittance = Spectrum::Ones())
      : eta_(checked_ior("thin dielectric", eta)),
        reflectance_(checked_reflectance("thin dielectric: reflectance", reflectance)),
        transmittance_(checked_reflectance("thin dielectric: transmittance", transmittance)) {}

  std::optional<BsdfSample> sample(const Vec3& wo, Float uc, const Vec2&) const {
    const Float cosine = std::abs(wo.z());
    if (!(cosine > 0)) return {};
    const Float r = fresnel_dielectric(std::min(cosine, Float(1)), eta_).reflectance;
    const auto lobe = mc::Bernoulli<Float>(2 * r / (1 + r)).sample_index(uc);
    if (lobe.index == 1)
      return BsdfSample{{-wo.x(), -wo.y(), wo.z()}, reflectance_ * (lobe.pmf / cosine), lobe.pmf, true};
    return BsdfSample{-wo, transmittance_ * (lobe.pmf / cosine), lobe.pmf, true};
  }
  Spectrum eval(const Vec3&, const Vec3&) const { return Spectrum::Zero(); }
  Float pdf(const Vec3&, const Vec3&) const { return 0; }
  Float eta(const Vec3&, const Vec3&) const { return 1; }
  Float albedo(const Vec3&) const { return reflectance_.max(transmittance_).maxCoeff(); }
  Lobes lobes() const { return Lobes::specular(); }
  /// Replaces the colour of reflected light. The caller ensures that it lies in [0, 1].
  void set_specular_reflectance(const Spectrum& color) { reflectance_ = color; }
  /// Replaces the colour of transmitted light. The caller ensures that it lies in [0, 1].
  void set_specular_transmittance(const Spectrum& color) { transmittance_ = color; }

 private:
  Float eta_;
  Spectrum reflectance_, transmittance_;
};

} // namespace render

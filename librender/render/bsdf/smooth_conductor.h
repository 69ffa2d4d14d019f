#pragma once
/// Polished metal.

#include <render/bsdf/rough_conductor.h>

namespace render {

/// Metal mirror, the same on both sides: the limit of RoughConductor for alpha -> 0.
///   eta, k : index of refraction and extinction coefficient over the index of the outside, per channel.
///   f      : a delta lobe of weight Ks F.
///   throws : Error unless eta and k lie in [0, 1e6] and are never both 0, and the colour lies in [0, 1].
class SmoothConductor {
 public:
  /// Mirror of a metal; `reflectance` scales the Fresnel term.
  SmoothConductor(const Spectrum& eta, const Spectrum& k, const Spectrum& reflectance = Spectrum::Ones())
      : eta_(checked_conductor("conductor", eta, k)), k_(k),
        reflectance_(checked_reflectance("conductor: specularReflectance", reflectance)) {}

  std::optional<BsdfSample> sample(const Vec3& wo, Float, const Vec2&) const {
    const Float cosine = std::abs(wo.z());
    if (!(cosine > 0)) return {};
    return BsdfSample{{-wo.x(), -wo.y(), wo.z()}, reflected(wo) / cosine, 1, true};
  }
  Spectrum eval(const Vec3&, const Vec3&) const { return Spectrum::Zero(); }
  Float pdf(const Vec3&, const Vec3&) const { return 0; }
  Float eta(const Vec3&, const Vec3&) const { return 1; }
  Float albedo(const Vec3& wo) const { return reflected(wo).maxCoeff(); }
  Lobes lobes() const { return Lobes::specular(); }
  /// Replaces the colour of reflected light. The caller ensures that it lies in [0, 1].
  void set_specular_reflectance(const Spectrum& color) { reflectance_ = color; }

 private:
  Spectrum reflected(const Vec3& wo) const {
    return reflectance_ * fresnel_conductor(std::min(std::abs(wo.z()), Float(1)), eta_, k_);
  }

  Spectrum eta_, k_, reflectance_;
};

} // namespace render

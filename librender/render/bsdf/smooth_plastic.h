#pragma once
/// Polished paint: a smooth dielectric layer over a diffuse base.

#include <render/bsdf/rough_plastic.h>

namespace render {

/// A smooth coat over a diffuse base, the same on both sides: what RoughPlastic tends to.
///   eta    : index of refraction of the layer over that of the outside
///   f      : of the coat a delta lobe of weight Ks F, F that of wo; Kd Base about it, as of RoughPlastic
///   sample : the mirror direction, or a cosine hemisphere, by what each reflects
///   throws : Error unless eta is a checked_index and the colours lie in [0, 1]
template <class Base = LayeredBase> class SmoothPlastic {
 public:
  SmoothPlastic(Float eta, const Spectrum& diffuse, const Spectrum& specular)
      : eta_(checked_index("plastic", eta)), base_(eta, 0),
        diffuse_(checked_reflectance("plastic: diffuseReflectance", diffuse)),
        specular_(checked_reflectance("plastic: specularReflectance", specular)) {}

  std::optional<BsdfSample> sample(const Vec3& wo_given, Float uc, const Vec2& u) const {
    const Vec3 wo = upward(wo_given, wo_given);
    if (!(wo.z() > 0)) return {};
    const mc::Bernoulli<Float> mirrors(specular_share(wo));
    const auto lobe = mirrors.sample_index(uc);
    if (lobe.index == 1) {
      const Float f = fresnel_dielectric(std::min(wo.z(), Float(1)), eta_).reflectance;
      return BsdfSample{{-wo_given.x(), -wo_given.y(), wo_given.z()}, specular_ * (f / wo.z()), lobe.pmf, true};
    }
    const Vec3 wi = mc::CosineHemisphere<Float>{}.sample(u);
    const Float density = lobe.pmf * wi.z() * inv_pi;
    if (!(density > 0)) return {};
    return BsdfSample{upward(wi, wo_given), value(Reflection(wo, wi)), density};
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const {
    const auto r = reflection(wo, wi);
    return r ? value(*r) : Spectrum(Spectrum::Zero());
  }
  Float pdf(const Vec3& wo, const Vec3& wi) const {
    const auto r = reflection(wo, wi);
    return r ? mc::Bernoulli<Float>(specular_share(r->wo)).pmf(0) * r->wi.z() * inv_pi : Float(0);
  }
  const Spectrum& diffuse() const { return diffuse_; }
  const Spectrum& specular() const { return specular_; }
  /// The same paint of these colours, which lie in [0, 1].
  SmoothPlastic in_colors(const Spectrum& diffuse, const Spectrum& specular) const {
    SmoothPlastic paint = *this;
    paint.diffuse_ = diffuse;
    paint.specular_ = specular;
    return paint;
  }
  Float eta(const Vec3&, const Vec3&) const { return 1; }
  Float albedo(const Vec3& wo) const {
    const auto [reflected, transmitted] = base_.shares({wo.x(), wo.y(), std::abs(wo.z())});
    return (specular_ * reflected + diffuse_ * transmitted).maxCoeff();
  }
  bool is_delta() const { return false; }
  bool is_narrow() const { return false; }
  bool has_delta() const { return true; }
  bool transmits() const { return false; }
  bool casts_caustics() const { return false; }

 private:
  static constexpr Float inv_pi = std::numbers::inv_pi_v<Float>;

  /// How often the coat is sampled: by what both reflect.
  Float specular_share(const Vec3& wo) const {
    const auto [reflected, transmitted] = base_.shares(wo);
    const Float specular = luminance(specular_) * reflected, diffuse = luminance(diffuse_) * transmitted;
    return specular + diffuse > 0 ? specular / (specular + diffuse) : Float(0.5);
  }
  Spectrum value(const Reflection& r) const {
    const Float f = fresnel_dielectric(std::min(std::abs(r.wo.dot(r.m)), Float(1)), eta_).reflectance;
    return diffuse_ * base_.value(r, f);
  }

  Float eta_;
  Base base_;
  Spectrum diffuse_, specular_;
};

} // namespace render

#pragma once
/// Polished paint: a smooth dielectric coat over a diffuse base.

#include <render/bsdf/rough_plastic.h>

namespace render {

/// Smooth coat over a diffuse base, the same on both sides: the limit of RoughPlastic for alpha -> 0.
///   eta    : index of refraction of the coat over the index of the outside.
///   f      : a delta lobe of weight Ks F, with F at wo, plus Kd Base as in RoughPlastic.
///   sample : the mirror direction or a cosine-distributed direction, in proportion to the light that coat and base
///            reflect.
///   throws : Error unless eta is a checked_ior and the colours lie in [0, 1].
template <class Base = LayeredBase> class SmoothPlastic : public CoatedDiffuse<Base> {
 public:
  /// Paint with a coat of relative index eta.
  SmoothPlastic(Float eta, const Spectrum& diffuse, const Spectrum& specular,
                InternalReflections internal = InternalReflections::linear)
      : CoatedDiffuse<Base>("plastic", eta, CoatFacets(), diffuse, specular, internal) {}

  std::optional<BsdfSample> sample(const Vec3& unflipped_wo, Float uc, const Vec2& u) const {
    const Vec3 wo = to_upper_side(unflipped_wo, unflipped_wo);
    if (!(wo.z() > 0)) return {};
    const mc::Bernoulli<Float> mirrors(specular_probability(wo));
    const auto lobe = mirrors.sample_index(uc);
    if (lobe.index == 1) {
      const Spectrum f = this->specular() * (this->fresnel(wo.z()) / wo.z());
      return BsdfSample{{-unflipped_wo.x(), -unflipped_wo.y(), unflipped_wo.z()}, f, lobe.pmf, true};
    }
    const Vec3 wi = mc::CosineHemisphere<Float>{}.sample(u);
    const Float density = lobe.pmf * wi.z() * inv_pi;
    if (!(density > 0)) return {};
    return BsdfSample{to_upper_side(wi, unflipped_wo), value(Reflection(wo, wi)), density};
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const {
    const auto r = reflection(wo, wi);
    return r ? value(*r) : Spectrum(Spectrum::Zero());
  }
  Float pdf(const Vec3& wo, const Vec3& wi) const {
    const auto r = reflection(wo, wi);
    return r ? mc::Bernoulli<Float>(specular_probability(r->wo)).pmf(0) * r->wi.z() * inv_pi : Float(0);
  }
  Lobes lobes() const { return {.roughness = 1, .has_delta = true}; }

 private:
  using CoatedDiffuse<Base>::inv_pi, CoatedDiffuse<Base>::specular_probability;

  Spectrum value(const Reflection& r) const { return this->base_value(r, this->fresnel(std::abs(r.wo.dot(r.m)))); }
};

} // namespace render

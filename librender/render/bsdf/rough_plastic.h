#pragma once
/// Glossy paint: a rough dielectric layer over a diffuse base.

#include <render/bsdf/microfacet.h>

#include <mc/table/discrete.h>
#include <mc/warp/hemisphere.h>

#include <numbers>

namespace render {

/// The plastic of lajolla, the same on both sides.
///   eta    : index of refraction of the layer over that of the outside
///   eval   : Ks F D G / (4 cos wo cos wi) + Kd (1 - F)^2 / pi, F that of wo about the half vector, D and G of GGX; 0
///            where wo and wi lie on different sides. What happens inside the layer is left out, so it loses light;
///            but at grazing wo the base gets what the coat has reflected, since F is that of the half vector: with
///            Kd = .5, Ks = 1 and alpha = 1e-4 the albedo is 1.27 at 88.3 degrees and 1.4 at 89.9
///   sample : mirrored about a visible normal, or a cosine hemisphere, by what each gives at mirror reflection; the pdf
///            is that of the mixture [1/sr]
///   throws : Error unless eta is finite and > 0, alpha in [1e-4, 1] and the colours in [0, 1]
class RoughPlastic {
 public:
  RoughPlastic(Float eta, Float alpha, const Spectrum& diffuse, const Spectrum& specular)
      : eta_(eta), facets_(checked_alpha("rough plastic: alpha", alpha)),
        diffuse_(checked_reflectance("rough plastic: diffuseReflectance", diffuse)),
        specular_(checked_reflectance("rough plastic: specularReflectance", specular)), diffuse_y_(luminance(diffuse)),
        specular_y_(luminance(specular)) {
    mc::require(eta > 0 && std::isfinite(eta), "rough plastic: relative index {} must be finite and > 0", eta);
  }

  std::optional<BsdfSample> sample(const Vec3& wo_given, Float uc, const Vec2& u) const {
    const Vec3 wo = upward(wo_given, wo_given);
    if (!(wo.z() > 0)) return {};
    const auto normals = facets_.seen_from(wo);
    const Float share = specular_share(wo);
    Vec3 wi;
    if (mc::Bernoulli<Float>(share).sample_index(uc).index == 1) {
      const Vec3 m = normals.sample(u);
      wi = (2 * wo.dot(m) * m - wo).normalized();
    } else {
      wi = mc::CosineHemisphere<Float>{}.sample(u);
    }
    if (!(wi.z() > 0)) return {};
    const Reflection r(wo, wi); // the rounded wi has a normal of its own
    const Float density = share * normals.pdf_reflected(r.m) + (1 - share) * wi.z() * inv_pi;
    if (!(density > 0)) return {};
    return BsdfSample{upward(wi, wo_given), value(r), density};
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const {
    const auto r = reflection(wo, wi);
    return r ? value(*r) : Spectrum(Spectrum::Zero());
  }
  Float pdf(const Vec3& wo, const Vec3& wi) const {
    const auto r = reflection(wo, wi);
    if (!r) return 0;
    const Float share = specular_share(r->wo);
    return share * facets_.seen_from(r->wo).pdf_reflected(r->m) + (1 - share) * r->wi.z() * inv_pi;
  }
  bool is_delta() const { return false; }
  bool is_narrow() const { return false; }
  bool has_delta() const { return false; }
  bool transmits() const { return false; }

 private:
  static constexpr Float inv_pi = std::numbers::inv_pi_v<Float>;

  /// How often the specular lobe is sampled: by what both lobes would give if the surface were smooth.
  Float specular_share(const Vec3& wo) const {
    const Float f = fresnel_dielectric(std::min(wo.z(), Float(1)), eta_).reflectance;
    const Float specular = specular_y_ * f, diffuse = diffuse_y_ * (1 - f);
    return specular + diffuse > 0 ? specular / (specular + diffuse) : Float(0.5);
  }
  Spectrum value(const Reflection& r) const {
    const Float f = fresnel_dielectric(std::min(std::abs(r.wo.dot(r.m)), Float(1)), eta_).reflectance;
    const Float lobe = f * facets_.shape(r.wo, r.wi, r.m) / 4;
    return specular_ * lobe + diffuse_ * (mc::sqr(1 - f) * inv_pi);
  }

  Float eta_;
  Microfacets facets_;
  Spectrum diffuse_, specular_;
  Float diffuse_y_, specular_y_;
};

} // namespace render

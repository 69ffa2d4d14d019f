#pragma once
/// Glossy paint: a rough dielectric coat over a diffuse base.

#include <render/bsdf/microfacet.h>
#include <render/bsdf/rough_fresnel.h>

#include <mc/table/discrete.h>
#include <mc/warp/hemisphere.h>

#include <numbers>
#include <optional>

namespace render {

/// Colour of the light that leaves the base after reflections between coat and base.
enum class InternalReflections {
  linear,   ///< The base keeps its colour.
  nonlinear ///< Every reflection multiplies the colour, so that colours are darker and more saturated.
};

/// White base under a coat, as in Mitsuba.
///   value  : T(wo) T(wi) / (pi mean T) [1/sr] with the transmittance T of the rough coat. Division by the mean
///            accounts for light that the coat reflects back to the base, so that the base returns all transmitted
///            light. Mitsuba 3 accounts for a single internal reflection instead, and its base becomes darker with the
///            coat's roughness.
///   colour : the factor of `value` for a base of albedo rho: rho, or rho (1 - F) / (1 - rho F) with nonlinear
///            reflections. F is the reflectance of the coat for diffuse light from inside, by reciprocity
///            1 - mean T / eta^2.
///   Source : Mitsuba 0.6, plastic and roughplastic.
class LayeredBase {
 public:
  /// A base under a coat of the relative index eta.
  ///   facets : facets of the coat; none: smooth.
  LayeredBase(Float eta, const CoatFacets& facets, InternalReflections internal = InternalReflections::linear)
      : coat_(eta, facets), nonlinear_(internal == InternalReflections::nonlinear) {
    set_coat(eta);
  }

  /// Computes tables of the coat for all roughnesses; facets_of maps a roughness to facets.
  template <class F> void prepare_alpha(Float eta, const F& facets_of) {
    coat_ = RoughFresnel::of_all_roughnesses(eta, facets_of);
  }
  /// Replaces the roughness of the coat, after prepare_alpha().
  void set_alpha(Float eta, Float alpha) {
    coat_.set_alpha(alpha);
    set_coat(eta);
  }

  /// Colour of the base of the given albedo, seen through the coat.
  Spectrum color(const Spectrum& albedo) const { return albedo * (1 - internal_) / (1 - albedo * internal_); }

  /// BSDF of the white base [1/sr].
  Float value(const Reflection& r, Float) const {
    return scale_ * coat_.eval(r.wo.z()).transmitted * coat_.eval(r.wi.z()).transmitted;
  }
  /// Shares of the light from wo that a white coat and a white base reflect.
  RoughFresnel::Albedos directional_albedo(const Vec3& wo) const { return coat_.eval(std::min(wo.z(), Float(1))); }

 private:
  // The factors that depend on the mean transmittance of the coat.
  void set_coat(Float eta) {
    const Float mean = coat_.mean_transmitted();
    if (!(mean > 0)) return;
    scale_ = std::numbers::inv_pi_v<Float> / mean;
    if (nonlinear_) internal_ = std::max(1 - mean / (eta * eta), Float(0));
  }

  RoughFresnel coat_;
  bool nonlinear_;
  Float scale_ = 0, internal_ = 0; ///< F for nonlinear reflections, else 0
};

/// White base of lajolla's plastic. It ignores the coat's transmittance at wo and wi.
///   value  : (1 - F)^2 / pi [1/sr] with F at the angle between wo and the half vector.
/// It is not physical: toward the horizon the base reflects light that the coat has already reflected. The albedo of
/// white paint exceeds 1 there.
class LajollaBase {
 public:
  /// A base under a coat of the relative index eta.
  LajollaBase(Float eta, const CoatFacets&, InternalReflections = InternalReflections::linear) : eta_(eta) {}

  /// Colour of the base: its albedo.
  Spectrum color(const Spectrum& albedo) const { return albedo; }

  /// BSDF of the white base [1/sr].
  Float value(const Reflection&, Float f) const { return mc::sqr(1 - f) * std::numbers::inv_pi_v<Float>; }
  /// Shares of the light from wo that a smooth white coat and a white base reflect.
  RoughFresnel::Albedos directional_albedo(const Vec3& wo) const {
    const Float f = fresnel_dielectric(std::min(wo.z(), Float(1)), eta_).reflectance;
    return {f, 1 - f};
  }

 private:
  Float eta_;
};

/// Common part of RoughPlastic and SmoothPlastic: index of refraction, base, and colours of coat and base.
template <class Base> class CoatedDiffuse {
 public:
  /// Colour of the base, seen through the coat.
  const Spectrum& diffuse() const { return diffuse_; }
  /// Colour of the coat.
  const Spectrum& specular() const { return specular_; }
  Float eta(const Vec3&, const Vec3&) const { return 1; }
  Float albedo(const Vec3& wo) const {
    const auto [reflected, transmitted] = base_.directional_albedo({wo.x(), wo.y(), std::abs(wo.z())});
    return (specular_ * reflected + diffuse_ * transmitted).maxCoeff();
  }
  /// Replaces the albedo of the base. The caller ensures that it lies in [0, 1].
  void set_diffuse_reflectance(const Spectrum& albedo) {
    albedo_ = albedo;
    diffuse_ = base_.color(albedo);
    diffuse_y_ = luminance(diffuse_);
  }
  /// Replaces the colour of the coat. The caller ensures that it lies in [0, 1].
  void set_specular_reflectance(const Spectrum& color) {
    specular_ = color;
    specular_y_ = luminance(color);
  }

 protected:
  /// 1 / pi.
  static constexpr Float inv_pi = std::numbers::inv_pi_v<Float>;

  /// name : material name for error messages.
  CoatedDiffuse(const std::string& name, Float eta, const CoatFacets& facets, const Spectrum& diffuse,
                const Spectrum& specular, InternalReflections internal)
      : eta_(checked_ior(name, eta)), base_(eta, facets, internal) {
    set_diffuse_reflectance(checked_reflectance(name + ": diffuseReflectance", diffuse));
    set_specular_reflectance(checked_reflectance(name + ": specularReflectance", specular));
  }

  /// Computes what the base needs for set_alpha_of_base(); facets_of maps a roughness to facets.
  template <class F> void prepare_base(const F& facets_of) {
    if constexpr (requires { base_.prepare_alpha(eta_, facets_of); }) base_.prepare_alpha(eta_, facets_of);
  }
  /// Replaces the roughness of the coat over the base.
  void set_alpha_of_base(Float alpha) {
    if constexpr (requires { base_.set_alpha(eta_, alpha); }) {
      base_.set_alpha(eta_, alpha);
      set_diffuse_reflectance(albedo_);
    }
  }
  /// Probability of sampling the coat: its share of the reflected light.
  Float specular_probability(const Vec3& wo) const {
    const auto [reflected, transmitted] = base_.directional_albedo(wo);
    const Float specular = specular_y_ * reflected, diffuse = diffuse_y_ * transmitted;
    return specular + diffuse > 0 ? specular / (specular + diffuse) : Float(0.5);
  }
  /// Fresnel reflectance of the coat at this cosine.
  Float fresnel(Float cosine) const { return fresnel_dielectric(std::min(cosine, Float(1)), eta_).reflectance; }
  /// BSDF of the coloured base [1/sr].
  Spectrum base_value(const Reflection& r, Float f) const { return diffuse_ * base_.value(r, f); }

 private:
  Float eta_;
  Base base_;
  Spectrum albedo_, diffuse_, specular_; ///< `diffuse_` is the colour of the base for `albedo_`
  Float diffuse_y_ = 0, specular_y_ = 0;
};

/// Coat of facets over a diffuse base, the same on both sides.
///   eta    : index of refraction of the coat over the index of the outside.
///   eval   : Ks F D G / (4 cos wo cos wi) + Kd Base with F at the angle between wo and the half vector; 0 if wo and wi
///            are on different sides. Light that would hit a second facet is lost. White paint over LayeredBase has an
///            albedo of at most 1; see notebooks-data/single-scattering/albedo.csv.
///   sample : mirrors wo about a visible normal, or samples a cosine-distributed direction, in proportion to the light
///            that coat and base reflect. The pdf is the density of the mixture [1/sr].
///   throws : Error unless eta is a checked_ior, alpha lies in [1e-4, 1] and the colours in [0, 1].
template <class Base = LayeredBase, class Facets = TrowbridgeReitzFacets>
class RoughPlastic : public CoatedDiffuse<Base> {
 public:
  /// Paint with a coat of relative index eta and roughness alpha.
  RoughPlastic(Float eta, Float alpha, const Spectrum& diffuse, const Spectrum& specular,
               InternalReflections internal = InternalReflections::linear)
      : CoatedDiffuse<Base>("rough plastic", eta, Facets(alpha), diffuse, specular, internal), facets_(alpha) {}

  std::optional<BsdfSample> sample(const Vec3& unflipped_wo, Float uc, const Vec2& u) const {
    const Vec3 wo = to_upper_side(unflipped_wo, unflipped_wo);
    if (!(wo.z() > 0)) return {};
    const auto normals = facets_.visible_normals(wo);
    const Float share = specular_probability(wo);
    Vec3 wi;
    if (mc::Bernoulli<Float>(share).sample_index(uc).index == 1) {
      const Vec3 m = normals.sample(u);
      wi = (2 * wo.dot(m) * m - wo).normalized();
    } else {
      wi = mc::CosineHemisphere<Float>{}.sample(u);
    }
    if (!(wi.z() > 0)) return {};
    const Reflection r(wo, wi); // half vector of the rounded wi, as in eval and pdf
    const Float density = share * normals.pdf_reflected(r.m) + (1 - share) * wi.z() * inv_pi;
    if (!(density > 0)) return {};
    return BsdfSample{to_upper_side(wi, unflipped_wo), value(r), density};
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const {
    const auto r = reflection(wo, wi);
    return r ? value(*r) : Spectrum(Spectrum::Zero());
  }
  Float pdf(const Vec3& wo, const Vec3& wi) const {
    const auto r = reflection(wo, wi);
    if (!r) return 0;
    const Float share = specular_probability(r->wo);
    return share * facets_.visible_normals(r->wo).pdf_reflected(r->m) + (1 - share) * r->wi.z() * inv_pi;
  }
  Lobes lobes() const { return Lobes::glossy(1); }
  /// Computes the tables that set_alpha() interpolates.
  void prepare_alpha() {
    this->prepare_base([](Float alpha) { return CoatFacets(Facets(alpha)); });
  }
  /// Replaces the roughness, after prepare_alpha().
  void set_alpha(Float alpha) {
    facets_ = Facets(alpha);
    this->set_alpha_of_base(alpha);
  }

 private:
  using CoatedDiffuse<Base>::inv_pi, CoatedDiffuse<Base>::specular_probability;

  Spectrum value(const Reflection& r) const {
    const Float f = this->fresnel(std::abs(r.wo.dot(r.m)));
    const Float lobe = f * facets_.dg_over_cosines(r.wo, r.wi, r.m) / 4;
    return this->specular() * lobe + this->base_value(r, f);
  }

  Facets facets_;
};

} // namespace render

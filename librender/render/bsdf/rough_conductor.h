#pragma once
/// Rough metal, and Fresnel reflectance of metals.

#include <render/bsdf/microfacet.h>

namespace render {

/// Fresnel reflectance of a metal for unpolarised light, per channel.
///   cos_i  : cosine of incidence in [0,1].
///   eta, k : index of refraction and extinction coefficient of the metal over the index of the outside.
///   error  : 1e-5.
///   Source : [BornWolf99] section 14.2.
inline Spectrum fresnel_conductor(Float cos_i, const Spectrum& eta, const Spectrum& k) {
  const Float cos2 = cos_i * cos_i, sin2 = 1 - cos2;
  // (a + ib)^2 = (eta + ik)^2 - sin^2. Its imaginary part is 2 eta k.
  const Spectrum real = eta * eta - k * k - sin2;
  const Spectrum modulus = (real * real + 4 * eta * eta * k * k).sqrt();
  // the larger of a^2 and b^2; the other follows from a b = eta k without a difference
  const Spectrum half = (modulus + real.abs()) / 2;
  const Spectrum twice_a_cos = 2 * cos_i * (real >= 0).select(half, (eta * k).square() / half).sqrt();
  const Spectrum perpendicular = (modulus + cos2 - twice_a_cos) / (modulus + cos2 + twice_a_cos);
  const Spectrum even = cos2 * modulus + sin2 * sin2, odd = twice_a_cos * sin2;
  return (perpendicular * (1 + (even - odd) / (even + odd)) / 2).min(Float(1));
}

/// Returns eta if eta and k are in the domain of fresnel_conductor().
///   throws : Error, with the name `what`, unless eta and k lie in [0, 1e6] and are never both 0.
inline const Spectrum& checked_conductor(std::string_view what, const Spectrum& eta, const Spectrum& k) {
  constexpr Float most = 1e6f; // its fourth power is in the range of float
  checked_radiance(fmt::format("{}: eta", what), eta);
  checked_radiance(fmt::format("{}: k", what), k);
  mc::require((eta <= most).all() && (k <= most).all(),
              "{}: eta ({}, {}, {}) and k ({}, {}, {}) must be at most {}; those of metals stay below 100", what,
              eta[0], eta[1], eta[2], k[0], k[1], k[2], most);
  mc::require((eta + k > 0).all(), "{}: eta ({}, {}, {}) and k must not both be 0", what, eta[0], eta[1], eta[2]);
  return eta;
}

/// Metal with microfacets, the same on both sides.
///   eta, k : index of refraction and extinction coefficient over the index of the outside, per channel.
///   eval   : Ks F D G / (4 cos wo cos wi) with F at the angle between wo and the half vector; 0 if wo and wi are on
///            different sides. Light that would hit a second facet is lost; notebooks-data/single-scattering/albedo.csv
///            lists the remaining albedo.
///   sample : mirrors wo about a sampled normal; nullopt if the result is below the surface. The pdf is the density of
///            mirrored directions [1/sr].
///   throws : Error unless eta and k lie in [0, 1e6] and are never both 0, and the colour lies in [0, 1].
///   Source : [WalterEtAl07] equation 20.
template <class Facets> class RoughConductor {
 public:
  /// Metal with the given facets; `reflectance` scales the Fresnel term.
  RoughConductor(const Spectrum& eta, const Spectrum& k, const Facets& facets,
                 const Spectrum& reflectance = Spectrum::Ones())
      : eta_(checked_conductor("rough conductor", eta, k)), k_(k), facets_(facets),
        reflectance_(checked_reflectance("rough conductor: specularReflectance", reflectance)) {}

  std::optional<BsdfSample> sample(const Vec3& unflipped_wo, Float, const Vec2& u) const {
    const Vec3 wo = to_upper_side(unflipped_wo, unflipped_wo);
    if (!(wo.z() > 0)) return {};
    const auto normals = facets_.visible_normals(wo);
    const Vec3 m = normals.sample(u);
    const Vec3 wi = (2 * wo.dot(m) * m - wo).normalized();
    if (!(wi.z() > 0)) return {};
    const Reflection r(wo, wi); // half vector of the rounded wi, as in eval and pdf
    const Float density = normals.pdf_reflected(r.m);
    if (!(density > 0)) return {};
    return BsdfSample{to_upper_side(wi, unflipped_wo), value(r), density};
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const {
    const auto r = reflection(wo, wi);
    return r ? value(*r) : Spectrum(Spectrum::Zero());
  }
  Float pdf(const Vec3& wo, const Vec3& wi) const {
    const auto r = reflection(wo, wi);
    return r ? facets_.visible_normals(r->wo).pdf_reflected(r->m) : Float(0);
  }
  Float eta(const Vec3&, const Vec3&) const { return 1; }
  Float albedo(const Vec3& wo) const {
    return (reflectance_ * fresnel_conductor(std::min(std::abs(wo.z()), Float(1)), eta_, k_)).maxCoeff();
  }
  Lobes lobes() const { return Lobes::glossy(facets_.alpha()); }
  /// Replaces the colour. The caller ensures that it lies in [0, 1].
  void set_specular_reflectance(const Spectrum& color) { reflectance_ = color; }
  /// Replaces the roughness.
  void set_alpha(Float alpha) { facets_ = Facets(alpha); }

 private:
  Spectrum value(const Reflection& r) const {
    const Float cosine = std::clamp(r.wo.dot(r.m), Float(0), Float(1));
    return reflectance_ * fresnel_conductor(cosine, eta_, k_) * (facets_.dg_over_cosines(r.wo, r.wi, r.m) / 4);
  }

  Spectrum eta_, k_;
  Facets facets_;
  Spectrum reflectance_;
};

} // namespace render

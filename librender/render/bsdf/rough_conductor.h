#pragma once
/// Metal.

#include <render/bsdf/microfacet.h>

namespace render {

/// Fresnel reflectance of a metal for unpolarised light, per channel.
///   cos_i  : cosine of incidence in [0,1]
///   eta, k : index of refraction and extinction coefficient of the metal over the index of the outside
///   error  : 1e-5
///   Source : [BornWolf99] section 14.2
inline Spectrum fresnel_conductor(Float cos_i, const Spectrum& eta, const Spectrum& k) {
  const Float cos2 = cos_i * cos_i, sin2 = 1 - cos2;
  // (a + ib)^2 = (eta + ik)^2 - sin^2, whose imaginary part is 2 eta k.
  const Spectrum real = eta * eta - k * k - sin2;
  const Spectrum modulus = (real * real + 4 * eta * eta * k * k).sqrt();
  const Spectrum half = (modulus + real.abs()) / 2; // the larger of a^2 and b^2, the other without a difference
  const Spectrum twice_a_cos = 2 * cos_i * (real >= 0).select(half, (eta * k).square() / half).sqrt();
  const Spectrum perpendicular = (modulus + cos2 - twice_a_cos) / (modulus + cos2 + twice_a_cos);
  const Spectrum even = cos2 * modulus + sin2 * sin2, odd = twice_a_cos * sin2;
  return (perpendicular * (1 + (even - odd) / (even + odd)) / 2).min(Float(1));
}

/// The index of refraction of a metal that fresnel_conductor is defined for.
///   throws : Error, naming `what`, unless eta and k are in [0, 1e6] and never both 0
inline const Spectrum& checked_conductor(std::string_view what, const Spectrum& eta, const Spectrum& k) {
  constexpr Float most = 1e6f; // its fourth power is a float
  checked_radiance(fmt::format("{}: eta", what), eta);
  checked_radiance(fmt::format("{}: k", what), k);
  mc::require((eta <= most).all() && (k <= most).all(),
              "{}: eta ({}, {}, {}) and k ({}, {}, {}) must be at most {}; those of metals stay below 100", what,
              eta[0], eta[1], eta[2], k[0], k[1], k[2], most);
  mc::require((eta + k > 0).all(), "{}: eta ({}, {}, {}) and k must not both be 0", what, eta[0], eta[1], eta[2]);
  return eta;
}

/// Metal with facets of a distribution, the same on both sides.
///   eta, k : its index of refraction and extinction coefficient over the index of the outside, per channel
///   eval   : Ks F D G / (4 cos wo cos wi), F that of wo about the half vector; 0 where wo and wi lie on different
///            sides. Light that would meet a second facet is lost: of F = 1 at a cosine of .9 and alpha .1, .3, .6, 1
///            GGX's keep .99, .87, .59, .32, Blinn-Phong's 1, .98, .74, .41
///   sample : mirrored about one of the normals that the distribution draws; nullopt where that ends below the surface.
///            The pdf is that of the mirrored directions [1/sr]
///   throws : Error unless eta and k are in [0, 1e6] and never both 0, and the colour lies in [0, 1]
///   Source : [WalterEtAl07] equation 20
template <class Facets> class RoughConductor {
 public:
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
    const Reflection r(wo, wi); // the rounded wi has a normal of its own
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
  bool is_delta() const { return false; }
  bool is_near_specular() const { return facets_.alpha() < near_specular_alpha; }
  bool has_delta() const { return false; }
  bool transmits() const { return false; }
  bool casts_caustics() const { return facets_.alpha() <= Float(0.2); } // beyond it costs more than it brings

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

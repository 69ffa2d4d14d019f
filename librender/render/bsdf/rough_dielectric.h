#pragma once
/// Rough glass.

#include <render/bsdf/microfacet.h>

#include <mc/table/discrete.h>

namespace render {

/// Rough boundary to a medium of relative index eta (inside over outside; the normal points outside). Its facets
/// reflect and refract like Dielectric.
///   reflection : Ks F D G / (4 |cos wo cos wi|).
///   refraction : Kt (1 - F) D G |wo.h wi.h| / (|cos wo cos wi| (wo.h + e wi.h)^2). e is the index on the side of wi
///                over the index on the side of wo. Refraction divides radiance by e^2.
///   eval   : 0 if wo or wi is behind the facet. Light that would hit a second facet is lost.
///   sample : a visible normal reflects wo with probability F and refracts it otherwise; nullopt if the result is on
///            the wrong side.
///   throws : Error unless eta is a checked_ior, |eta - 1| >= 1e-4, alpha lies in [1e-4, 1] and the colours in [0, 1].
///   Source : [WalterEtAl07] equations 19-21.
template <class Facets = TrowbridgeReitzFacets> class RoughDielectric {
 public:
  /// Glass of a relative index, a roughness, and tints of reflection and transmission.
  RoughDielectric(Float eta, Float alpha, const Spectrum& reflectance = Spectrum::Ones(),
                  const Spectrum& transmittance = Spectrum::Ones())
      : eta_(checked_ior("rough dielectric", eta)), facets_(alpha),
        reflectance_(checked_reflectance("rough dielectric: specularReflectance", reflectance)),
        transmittance_(checked_reflectance("rough dielectric: specularTransmittance", transmittance)) {
    mc::require(std::abs(eta - 1) >= Float(1e-4),
                "rough dielectric: relative index {} must not be 1, where nothing would be refracted", eta);
  }

  std::optional<BsdfSample> sample(const Vec3& wo, Float uc, const Vec2& u) const {
    const View view(wo, eta_);
    if (!(view.wo.z() > 0)) return {};
    const auto normals = facets_.visible_normals(view.wo);
    const Vec3 m = normals.sample(u);
    const Float cosine = std::min(view.wo.dot(m), Float(1));
    if (!(cosine > 0)) return {};
    const auto [f, cos_t] = fresnel_dielectric(cosine, view.ratio);
    const mc::Bernoulli<Float> mirrors(std::min(f, Float(1)));
    const bool reflects = mirrors.sample_index(uc).index == 1;
    const Vec3 wi =
        reflects ? Vec3(2 * cosine * m - view.wo) : Vec3((cosine / view.ratio - cos_t) * m - view.wo / view.ratio);
    if (!(reflects ? wi.z() > 0 : wi.z() < 0)) return {};
    const Vec3 unflipped_wi = view.flip(wi.normalized());
    const auto facet = facet_between(wo, unflipped_wi); // the facet of the rounded wi, as in eval and pdf
    if (!facet) return {};
    const Float density = density_of(*facet);
    if (!(density > 0) || !std::isfinite(density)) return {};
    return BsdfSample{unflipped_wi, value_of(*facet), density, false, reflects ? Float(1) : view.ratio};
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const {
    const auto facet = facet_between(wo, wi);
    return facet ? value_of(*facet) : Spectrum(Spectrum::Zero());
  }
  Float pdf(const Vec3& wo, const Vec3& wi) const {
    const auto facet = facet_between(wo, wi);
    return facet ? density_of(*facet) : Float(0);
  }
  Float eta(const Vec3& wo, const Vec3& wi) const { return transmitted_eta(wo, wi, eta_); }
  Float albedo(const Vec3&) const { return reflectance_.max(transmittance_).maxCoeff(); }
  Lobes lobes() const { return {.roughness = facets_.alpha(), .transmits = true}; }
  /// Replaces the colour of reflected light. The caller ensures that it lies in [0, 1].
  void set_specular_reflectance(const Spectrum& color) { reflectance_ = color; }
  /// Replaces the colour of refracted light. The caller ensures that it lies in [0, 1].
  void set_specular_transmittance(const Spectrum& color) { transmittance_ = color; }
  /// Replaces the roughness.
  void set_alpha(Float alpha) { facets_ = Facets(alpha); }

 private:
  // Frame in which wo is above the surface, with the index on the far side over the index on the side of wo.
  struct View {
    Vec3 wo;
    Float ratio;
    bool flipped;
    View(const Vec3& w, Float eta) : wo(w), ratio(w.z() < 0 ? 1 / eta : eta), flipped(w.z() < 0) { wo = flip(w); }
    Vec3 flip(const Vec3& w) const { return flipped ? Vec3(w.x(), w.y(), -w.z()) : w; }
  };

  // The facet that scatters light between two directions, with both cosines > 0. No value follows from Snell's law:
  // near the critical angle it amplifies the rounding error of a cosine.
  struct Facet {
    Vec3 wo, wi, m;
    Float cos_o, cos_i, ratio;
    bool reflects;

    // 1 - F as in [BornWolf99], but without the difference. It is the same from both sides.
    Float transmitted() const {
      const Float c = ratio * cos_i, s = cos_o + c, p = ratio * cos_o + cos_i;
      return 2 * cos_o * c * (1 / mc::sqr(s) + 1 / mc::sqr(p));
    }
    // Solid angle of normals over solid angle of refracted directions: e^2 cos_i / (cos_o - e cos_i)^2. The difference
    // equals (1 - e^2) / (cos_o + e cos_i).
    Float jacobian() const {
      return mc::sqr(ratio) * cos_i * mc::sqr((cos_o + ratio * cos_i) / ((ratio - 1) * (ratio + 1)));
    }
    Float reflected() const { return fresnel_dielectric(cos_o, ratio).reflectance; }
  };
  std::optional<Facet> facet_between(const Vec3& wo, const Vec3& unflipped_wi) const {
    const View view(wo, eta_);
    const Vec3 wi = view.flip(unflipped_wi);
    if (!(view.wo.z() > 0) || wi.z() == 0) return {};
    const bool reflects = wi.z() > 0;
    // In double: at grazing facets the cosines are small differences. Exchanging wo and wi gives the same cosines.
    const double far_index = wo.z() < 0 ? 1 / double(eta_) : double(eta_), ratio = reflects ? 1 : far_index;
    const bool cancel = view.wo.z() + wi.z() < Float(0.5) && reflects; // as in half_vector
    const Vec3d o = cancel ? unit_in_double(view.wo) : Vec3d(view.wo.template cast<double>());
    const Vec3d i = cancel ? unit_in_double(wi) : Vec3d(wi.cast<double>()), sum = o + ratio * i;
    const Vec3d m = (sum.z() < 0 ? Vec3d(-sum) : sum).normalized();
    const auto cos_o = Float(std::min(o.dot(m), 1.0)), cos_i = Float(reflects ? i.dot(m) : -i.dot(m));
    if (!(cos_o > 0 && cos_i > 0)) return {};
    return Facet{view.wo, wi, m.cast<Float>(), cos_o, cos_i, view.ratio, reflects};
  }

  Spectrum value_of(const Facet& facet) const {
    const Float shape = facets_.dg_over_cosines(facet.wo, facet.wi, facet.m);
    if (facet.reflects) return reflectance_ * (facet.reflected() * shape / 4);
    return transmittance_ * (facet.transmitted() * shape * facet.cos_o * facet.jacobian() / mc::sqr(facet.ratio));
  }
  Float density_of(const Facet& facet) const {
    const auto normals = facets_.visible_normals(facet.wo);
    if (facet.reflects) return facet.reflected() * normals.pdf_reflected(facet.m);
    return facet.transmitted() * normals.pdf(facet.m) * facet.jacobian();
  }

  Float eta_;
  Facets facets_;
  Spectrum reflectance_, transmittance_;
};

} // namespace render

#pragma once
/// Smooth glass.

#include <render/bsdf/concept.h>

#include <mc/table/discrete.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace render {

/// Fresnel reflectance and direction of refraction of a smooth dielectric boundary.
struct Fresnel {
  Float reflectance, ///< Share of reflected light.
      cos_t;         ///< Cosine of refraction; 0 at total internal reflection.
};
/// Fresnel equations of a smooth dielectric for unpolarised light: the reflectance is the mean of the squared parallel
/// and perpendicular amplitudes. At total internal reflection it is 1.
///   cos_i : cosine of incidence in [0,1].
///   eta   : index of the far side over the index of the near side.
inline Fresnel fresnel_dielectric(Float cos_i, Float eta) {
  const Float sin2_t = (1 - cos_i) * (1 + cos_i) / (eta * eta);
  if (!(sin2_t < 1)) return {1, 0};
  const Float cos_t = std::sqrt(1 - sin2_t);
  const Float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const Float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return {std::min((parallel * parallel + perpendicular * perpendicular) / 2, Float(1)), cos_t};
}

/// Returns the relative index of refraction `eta` if it is in the supported range. Its squares and quotients are then
/// far from overflow and underflow.
///   throws : Error, with the name `what`, unless eta lies in [0.001, 1000].
inline Float checked_ior(std::string_view what, Float eta) {
  mc::require(eta >= Float(1e-3) && eta <= Float(1e3), "{}: relative index {} must lie in [0.001, 1000]", what, eta);
  return eta;
}

/// Index on the side of wi over the index on the side of wo, at a boundary of relative index eta (inside over outside).
inline Float transmitted_eta(const Vec3& wo, const Vec3& wi, Float eta) {
  if (wo.z() * wi.z() >= 0) return 1;
  return wo.z() > 0 ? eta : 1 / eta;
}

/// Smooth boundary to a medium of relative index eta (inside over outside; the normal points outside). It has two delta
/// lobes, selected by the Fresnel reflectance.
///   f      : refraction divides radiance by the squared relative index, so that etendue is conserved.
///   throws : Error unless eta is a checked_ior and the colours lie in [0, 1].
///   Source : Fresnel's equations, [BornWolf99] section 1.5; exact, not Schlick's approximation.
class Dielectric {
 public:
  /// Glass with the relative index eta and tints of reflection and transmission.
  explicit Dielectric(Float eta = Float(1.5), const Spectrum& reflectance = Spectrum::Ones(),
                      const Spectrum& transmittance = Spectrum::Ones())
      : eta_(checked_ior("dielectric", eta)), reflectance_(checked_reflectance("dielectric: reflectance", reflectance)),
        transmittance_(checked_reflectance("dielectric: transmittance", transmittance)) {}

  std::optional<BsdfSample> sample(const Vec3& wo, Float uc, const Vec2&) const {
    const Float cos_i = std::abs(wo.z());
    if (!(cos_i > 0)) return {};
    const Float ratio = wo.z() > 0 ? eta_ : 1 / eta_;
    const auto [r, cos_t] = fresnel_dielectric(cos_i, ratio);
    const auto lobe = mc::Bernoulli<Float>(r).sample_index(uc);
    if (lobe.index == 1) return BsdfSample{{-wo.x(), -wo.y(), wo.z()}, reflectance_ * (r / cos_i), r, true};
    const Float t = lobe.pmf;
    const Vec3 wi(-wo.x() / ratio, -wo.y() / ratio, wo.z() > 0 ? -cos_t : cos_t);
    return BsdfSample{wi.normalized(), transmittance_ * (t / (ratio * ratio * cos_t)), t, true, ratio};
  }
  Spectrum eval(const Vec3&, const Vec3&) const { return Spectrum::Zero(); }
  Float pdf(const Vec3&, const Vec3&) const { return 0; }
  Float eta(const Vec3& wo, const Vec3& wi) const { return transmitted_eta(wo, wi, eta_); }
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

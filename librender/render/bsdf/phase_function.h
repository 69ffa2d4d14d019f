#pragma once
/// Phase functions of participating media.

#include <render/bsdf/concept.h>

#include <mc/core/frame.h>
#include <mc/warp/henyey_greenstein.h>

#include <algorithm>

namespace render {

/// The Henyey-Greenstein phase function p, as the BSDF of a path vertex within a medium.
///   eval   : p / |cos|, since integrators multiply a BSDF by the cosine to the frame's z axis.
///   pdf    : p [1/sr], so that a sampled direction has the weight 1.
///   throws : Error unless the mean cosine g lies in (-1, 1); see mc::HenyeyGreenstein.
///   Source : [PharrJakobHumphreys23] sections 11.2 and 11.3.
class PhaseFunction {
 public:
  /// The phase function with mean cosine g: > 0 scatters forward, 0 alike in all directions.
  explicit PhaseFunction(Float g = 0) : lobe_(g) {}

  std::optional<BsdfSample> sample(const Vec3& wo, Float, const Vec2& u) const {
    const Vec3 w = lobe_.sample(u), wi = forward(wo).to_world(w);
    const Float p = lobe_.pdf(w);
    return BsdfSample{wi, without_cosine(p, wi), p};
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const { return without_cosine(pdf(wo, wi), wi); }
  Float pdf(const Vec3& wo, const Vec3& wi) const { return lobe_.pdf(forward(wo).to_local(wi)); }
  Float eta(const Vec3&, const Vec3&) const { return 1; }
  Float albedo(const Vec3&) const { return 1; }
  Lobes lobes() const { return {.roughness = 1, .transmits = true}; }

 private:
  // Light that is not deflected goes along the z axis. Without the division, rounding of lengths would add up over the
  // many directions of a path.
  static mc::Frame<Float> forward(const Vec3& wo) { return mc::Frame<Float>::from_z(-wo.normalized()); }
  static Spectrum without_cosine(Float p, const Vec3& wi) {
    constexpr Float least = Float(1e-18); // no overflow
    return Spectrum::Constant(p / std::max(std::abs(wi.z()), least));
  }

  mc::HenyeyGreenstein<Float> lobe_;
};

} // namespace render

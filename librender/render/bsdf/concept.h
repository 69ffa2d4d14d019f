#pragma once
/// The BSDF as a warp: sample, eval and pdf say the same thing.

#include <render/core/types.h>

#include <optional>

namespace render {

/// Directions live in the local frame with the shading normal on +z; wo and wi both leave the surface.
struct BsdfSample {
  Vec3 wi;
  Spectrum f;    ///< the BSDF without the cosine; for a delta lobe such that f |cos| / pdf is the lobe's weight
  Float pdf = 0; ///< [1/sr]; for a delta lobe its probability
  bool delta = false;
  Float eta = 1; ///< refractive index on the side of wi over that on the side of wo
};

/// A BSDF models:
///   sample(wo, uc, u) : uc chooses a lobe, u in [0,1)^2 a direction in it; nullopt: absorbed
///   eval(wo, wi)      : f [1/sr], delta lobes excluded
///   pdf(wo, wi)       : density of wi [1/sr], delta lobes excluded
///   eta(wo, wi)       : refractive index on the side of wi over that on the side of wo, delta lobes excluded
///   albedo(wo)        : about the share of light from wo that it sends on, of the colour of which that is most; in
///                       [0, 1]
///   is_delta()        : it has delta lobes only
///   is_narrow()       : its lobes are deltas or narrower than lights: these are sampled only if no ray meets them
///   has_delta()       : it has a delta lobe, perhaps besides others
///   transmits()       : light goes through it, in other directions than a delta lobe's
///   casts_caustics()  : it bundles light so much that paths which start at the lights pay
template <class T>
concept BsdfLike = requires(const T b, Vec3 wo, Vec3 wi, Float uc, Vec2 u) {
  { b.sample(wo, uc, u) } -> std::same_as<std::optional<BsdfSample>>;
  { b.eval(wo, wi) } -> std::convertible_to<Spectrum>;
  { b.pdf(wo, wi) } -> std::convertible_to<Float>;
  { b.eta(wo, wi) } -> std::convertible_to<Float>;
  { b.albedo(wo) } -> std::convertible_to<Float>;
  { b.is_delta() } -> std::convertible_to<bool>;
  { b.is_near_specular() } -> std::convertible_to<bool>;
  { b.has_delta() } -> std::convertible_to<bool>;
  { b.transmits() } -> std::convertible_to<bool>;
  { b.casts_caustics() } -> std::convertible_to<bool>;
};

} // namespace render

#pragma once
/// Concept of a BSDF: sample, eval and pdf describe the same distribution.

#include <render/core/types.h>

#include <optional>

namespace render {

/// A sampled direction. Directions are in the local frame with the shading normal as +z; wo and wi point away from the
/// surface.
struct BsdfSample {
  Vec3 wi;            ///< Sampled direction.
  Spectrum f;         ///< BSDF without the cosine; for a delta lobe f |cos| / pdf is the weight of the lobe.
  Float pdf = 0;      ///< Density [1/sr]; for a delta lobe its probability.
  bool delta = false; ///< Whether a delta lobe was sampled.
  Float eta = 1;      ///< Index of refraction on the side of wi over the index on the side of wo.
};

/// A BSDF models:
///   sample(wo, uc, u)  : samples wi; uc selects a lobe, u in [0,1)^2 a direction of it. nullopt: absorbed.
///   eval(wo, wi)       : f [1/sr] without the cosine, delta lobes excluded.
///   pdf(wo, wi)        : density of wi [1/sr], delta lobes excluded.
///   eta(wo, wi)        : index of refraction on the side of wi over the index on the side of wo, delta lobes excluded.
///   albedo(wo)         : approximate share of light from wo that is scattered, in [0, 1]; the largest over the
///                        channels.
///   is_delta()         : it has delta lobes only.
///   is_near_specular() : all lobes are delta lobes or narrower than lights. Such lobes connect to delta lights only.
///   has_delta()        : it has a delta lobe, perhaps among others.
///   transmits()        : light passes through by a lobe that is not a delta lobe.
///   casts_caustics()   : it focuses light so strongly that light paths pay.
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

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

/// Kinds of lobes of a BSDF, which decide how integrators sample it.
struct Lobes {
  /// Roughness of the widest lobe that is not a delta lobe, as alpha of Trowbridge-Reitz facets. 0: all lobes are delta
  /// lobes. Infinity: the reflected radiance is the same in all directions of one side.
  Float roughness = 0;
  bool has_delta = false; ///< Whether it has a delta lobe, perhaps among others.
  bool transmits = false; ///< Whether light passes through by a lobe that is not a delta lobe.

  /// A single delta lobe, or several.
  static Lobes specular() { return {.has_delta = true}; }
  /// Reflection of a roughness.
  static Lobes glossy(Float roughness) { return {.roughness = roughness}; }
  /// The same radiance in all directions.
  static Lobes diffuse() { return {.roughness = mc::infinity<Float>}; }

  /// Whether all lobes are delta lobes.
  bool is_delta() const { return roughness == 0; }
  /// Lobes of a smaller roughness are narrower than lights: they fill less than about 1e-6 sr, the sun 7e-5 sr.
  static constexpr Float near_specular_roughness = Float(2e-4);
  /// Whether all lobes are delta lobes or narrower than lights. Such lobes connect to delta lights only.
  bool is_near_specular() const { return roughness < near_specular_roughness; }
  /// Whether reflected radiance is the same in all directions of one side.
  bool is_diffuse() const { return roughness == mc::infinity<Float>; }
  /// Whether light is focused so strongly that light paths pay.
  bool casts_caustics() const { return transmits || roughness <= Float(0.2); }
};

/// A BSDF models:
///   sample(wo, uc, u) : samples wi; uc selects a lobe, u in [0,1)^2 a direction of it. nullopt: absorbed.
///   eval(wo, wi)      : f [1/sr] without the cosine, delta lobes excluded.
///   pdf(wo, wi)       : density of wi [1/sr], delta lobes excluded.
///   eta(wo, wi)       : index of refraction on the side of wi over the index on the side of wo, delta lobes excluded.
///   albedo(wo)        : approximate share of light from wo that is scattered, in [0, 1]; the largest channel.
///   lobes()           : kinds of its lobes.
template <class T>
concept BsdfLike = requires(const T b, Vec3 wo, Vec3 wi, Float uc, Vec2 u) {
  { b.sample(wo, uc, u) } -> std::same_as<std::optional<BsdfSample>>;
  { b.eval(wo, wi) } -> std::convertible_to<Spectrum>;
  { b.pdf(wo, wi) } -> std::convertible_to<Float>;
  { b.eta(wo, wi) } -> std::convertible_to<Float>;
  { b.albedo(wo) } -> std::convertible_to<Float>;
  { b.lobes() } -> std::same_as<Lobes>;
};

} // namespace render

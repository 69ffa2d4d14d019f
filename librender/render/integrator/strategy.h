#pragma once
/// Strategies: how paths choose directions and find lights.

#include <render/core/types.h>

#include <array>
#include <span>
#include <string_view>

namespace render {

/// Shapes that a strategy aims directions at.
enum class GuidingTarget {
  /// No shapes: the BSDF alone.
  none,
  hemisphere,         ///< All directions on the side of wo; both sides if the BSDF transmits.
  lights,             ///< Shapes of the lights, and importance targets.
  importance_targets, ///< Shapes that the scene marks as importance targets.
  speculars,          ///< Spheres of smooth glass or mirror, which may focus light.
  enclosing_speculars ///< Specular spheres that an area light overlaps.
};

/// How direct lighting is estimated. It applies to sampled lights; see LightLike.
enum class DirectLighting {
  bsdf_only, ///< Hits alone.
  nee,       ///< Next-event estimation at every vertex; hits count only at the camera and after near-specular lobes.
  mis        ///< Both, with the power heuristic [Veach97].
};

/// One row of the table of strategies.
struct Strategy {
  /// Name for users.
  std::string_view name;
  /// Targets of directions.
  GuidingTarget guiding_target;
  Float guiding_fraction; ///< Share of directions toward targets; 1: none by the BSDF except delta lobes.
  /// How lights are found.
  DirectLighting direct_lighting;
  /// Number of light paths per camera path. Light paths start in scenes where they pay (LightTracer::create); camera
  /// paths then aim at `enclosing_speculars` only.
  Float light_path_rate = 0;
  std::string_view summary = {}; ///< How it finds light, in one sentence.
  std::string_view use = {};     ///< When to use it, in one sentence.
};

/// The table of strategies. Details are in docs/methods/path-tracing.md, direction-sampling.md and light-tracing.md.
/// All strategies except `light` are unbiased for the lights that they can find:
///   - Strategies without next-event estimation find no point lights and no directional lights.
///   - Point and directional lights by way of smooth glass or a mirror are found by `mis+lt` alone, and there only on
///     directly visible surfaces.
/// Strategies without any target in the scene sample the BSDF.
///   light  : rough surfaces look toward lights and importance targets alone. Light from other surfaces and from the
///            sky is missing; see misses_light().
///   light, mixture, guides : [Shirley16] chapters 7, 8 and 10. Rays rounded to float may miss a tiny lamp of triangles
///                            at its outline. A square lamp loses about 2e-9 times its distance over half its side.
///   mis+lt : path tracing plus light tracing. With s light vertices and t camera vertices it combines s = 0 and s = 1
///            with any t, and t = 1 with any s. It is not bidirectional path tracing: other pairs (s, t) are left out.
///            In scenes where light paths do not pay it equals `mis` bit for bit.
inline constexpr auto strategies = std::to_array<Strategy>({
    {"bsdf", GuidingTarget::none, 0, DirectLighting::bsdf_only, 0,
     "Follows the BSDF; light counts where a path hits it.",
     "For large lights or a sky, and as a reference. Finds no point or directional light."},
    {"hemisphere", GuidingTarget::hemisphere, 1, DirectLighting::bsdf_only, 0,
     "Takes uniform directions; light counts where a path hits it.",
     "To show the noise of directions that ignore the BSDF. Finds no point or directional light."},
    {"light", GuidingTarget::lights, 1, DirectLighting::bsdf_only, 0,
     "Takes directions toward lights and importance targets only.",
     "To show one light alone. Misses the light of other surfaces and of the sky."},
    {"mixture", GuidingTarget::lights, Float(0.5), DirectLighting::bsdf_only, 0,
     "Takes half of the directions toward the lights and half by the BSDF, weighted by the density of the mixture.",
     "To compare with Shirley's books. Finds no point or directional light."},
    {"guides", GuidingTarget::importance_targets, Float(0.5), DirectLighting::bsdf_only, 0,
     "As mixture, toward the shapes that the scene marks as importance targets.",
     "For a known source of indirect light, such as a glass ball. Finds no point or directional light."},
    {"nee", GuidingTarget::none, 0, DirectLighting::nee, 0,
     "Connects every vertex of a path with a point of a light (next-event estimation).",
     "For diffuse surfaces and small lights. Noisy where a glossy surface reflects a light."},
    {"mis", GuidingTarget::speculars, Float(0.25), DirectLighting::mis, 0,
     "Combines nee and bsdf by multiple importance sampling.",
     "For scenes without caustics, and to compare with other path tracers."},
    {"mis+lt", GuidingTarget::speculars, Float(0.25), DirectLighting::mis, Float(0.125),
     "Combines mis with paths traced from the lights to the camera (light tracing).",
     "For any scene: the default. Finds caustics of glass, mirrors and glossy metal; elsewhere it is mis, bit for "
     "bit."},
});

/// Names of all strategies, in the order of the table.
std::array<std::string_view, strategies.size()> strategy_names();

/// Returns the strategy with this name; "bidirectional" is a former name of mis+lt.
///   throws : Error, with the nearest name, for an unknown name.
const Strategy& strategy_from(std::string_view name);

} // namespace render

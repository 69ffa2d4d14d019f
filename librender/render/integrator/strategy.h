#pragma once
/// How a path chooses its directions and how the light that it finds counts.

#include <render/core/types.h>

#include <array>
#include <span>
#include <string_view>

namespace render {

/// What a strategy aims directions at.
enum class GuidingTarget {
  none,
  hemisphere,         ///< every direction on the side of the path; on both where light goes through the surface
  lights,             ///< the shapes of the lights, and the guides
  importance_targets, ///< the shapes that the scene marks as such
  speculars,          ///< spheres of smooth glass or mirror, which may cast caustics of the lights
  enclosing_speculars ///< those of `speculars` that a lamp lies in, or reaches into
};

/// How the light of sampled lights is found.
enum class DirectLighting {
  bsdf_only, ///< where a path meets it
  nee,       ///< by a point of a light at every vertex; what a path meets by chance does not count
  mis        ///< weighted by the power heuristic [Veach97]
};

/// A row of the table below; the integrator does what it says.
struct Strategy {
  std::string_view name;
  GuidingTarget guiding_target;
  Float
      guiding_fraction; ///< of the directions go to the target, the others follow the BSDF. 1: none but its delta lobes do
  DirectLighting direct_lighting;
  Float light_path_rate =
      0; ///< paths from the lights per path from the camera, in scenes where they pay, see LightTracer;
         ///< directions are aimed at `enclosing_speculars` alone there
  std::string_view summary = {}; ///< how it finds light, one sentence
  std::string_view use = {};     ///< when to use it, one sentence
};

/// All but `light` are unbiased, those that find by chance where no light is a point or a direction; of such lights
/// none but `mis+lt` finds what comes by way of smooth glass or a mirror, and that where it is seen directly.
/// Where nothing is to aim at, the BSDF is followed.
///   light : rough surfaces look towards lamps and guides alone, so that what else they would reflect is missed: the
///           light of other surfaces and of the sky. See misses_light
///   light, mixture, guides : as in [Shirley16], chapters 7, 8 and 10. Of a tiny lamp of triangles they lose what rays,
///           rounded to float, miss at its outline: of a square 2e-9 times its distance over half its side
///   mis+lt : path tracing plus light tracing: of the vertices s from the light and t from the camera, s = 0 and 1 with
///           any t, and t = 1 with any s. Other pairs of bidirectional path tracing are left out. Light paths start in
///           scenes where they pay, see LightTracer; elsewhere it is mis, bit for bit
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

/// The names of all, in their order.
std::array<std::string_view, strategies.size()> strategy_names();

/// The strategy of that name; "bidirectional", its former name, is mis+lt. Throws Error, naming the nearest strategy,
/// for an unknown name.
const Strategy& strategy_from(std::string_view name);

} // namespace render

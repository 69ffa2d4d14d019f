#pragma once
/// Light that a strategy cannot find.

#include <render/integrator/strategy.h>
#include <render/scene/scene.h>

#include <cstddef>
#include <optional>

namespace render {

/// Light of a point or directional light that reaches rough surfaces and media by way of smooth glass or a mirror. No
/// path that starts at the camera finds it: no direction hits the light, and a connection to it does not bend.
struct MissingLight {
  std::size_t light;   ///< Index of the light.
  std::size_t surface; ///< Index of a surface of smooth glass, or of a mirror.
  /// Light paths find it on directly visible surfaces. It is missing where these are seen in a mirror or through glass.
  bool is_partial;
};

/// The first light and surface of which a strategy misses light, or nothing if it misses none. It may be that the
/// surface is not lit.
///   max_depth : longest path in edges; -1: no limit.
std::optional<MissingLight> missing_light(const Scene& scene, const Strategy& strategy, int max_depth);

} // namespace render

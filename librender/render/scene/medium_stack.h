#pragma once
/// Participating media along a path.

#include <render/scene/scene.h>

namespace render {

/// The medium of a ray and the media around it. Deeper nesting is not stored.
struct MediumStack {
  const HomogeneousMedium *current = nullptr, ///< Medium of the ray; null for vacuum.
      *outer = nullptr,                       ///< Medium around it; null for vacuum.
          *ambient = nullptr;                 ///< Medium outside of all surfaces; null for vacuum.

  /// Media beyond a surface that a ray crosses.
  ///   interior : interior of the surface; null if it has none.
  ///   enters   : whether the ray crosses it from the side of its normal.
  MediumStack beyond(const HomogeneousMedium* interior, bool enters) const {
    if (!interior) return *this;
    return enters ? MediumStack{interior, current, ambient} : MediumStack{outer, ambient, ambient};
  }
};

/// Media at the origin of a ray: the interiors that the ray, continued through everything, leaves without having
/// entered them.
MediumStack initial_media(const Scene& scene, Ray ray);

} // namespace render

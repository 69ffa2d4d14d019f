#pragma once
/// Vertices of paths.

#include <render/integrator/direction_mixture.h>
#include <render/scene/medium_stack.h>

namespace render {

/// A path vertex on a surface or within a medium, with a BSDF of type B and the media on the path.
template <class B> struct Interaction : ShadingPoint<B> {
  /// Interior of the surface; null if it has none, and within a medium.
  const HomogeneousMedium* interior = nullptr;
  MediumStack media_before; ///< Media before the vertex, on the side of the path.

  /// Media of a ray that leaves the vertex in the direction d.
  MediumStack media(const Vec3& d) const {
    if (!interior) [[likely]]
      return media_before;
    const bool came_from_inside = this->frame.to_world(this->wo).dot(this->point.ng) < 0;
    const bool goes_inside = d.dot(this->point.ng) < 0;
    return came_from_inside == goes_inside ? media_before : media_before.beyond(interior, goes_inside);
  }
};

} // namespace render

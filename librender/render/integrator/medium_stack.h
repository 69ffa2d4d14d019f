#pragma once
/// Participating media along a path.

#include <render/integrator/direction_mixture.h>

namespace render {

/// The medium of a ray and the medium around that medium. Deeper nesting is not stored.
struct MediumStack {
  const HomogeneousMedium *current = nullptr, ///< Medium of the ray; null for vacuum.
      *outer = nullptr;                       ///< Medium around it; null for vacuum.
};

/// Media at the origin of a ray, from the surfaces that the ray would leave if nothing stopped it.
MediumStack initial_media(const Scene& scene, Ray ray);

/// Whether any surface of the scene has an interior medium.
bool has_media(const Scene& scene);

/// A path vertex on a surface, with a BSDF of type B and the media on the path.
template <class B> struct SurfaceInteraction : ShadingPoint<B> {
  /// The surface of the vertex.
  const Surface& surface;
  MediumStack media_before; ///< Media before the vertex, on the side of the path.

  /// Media beyond the vertex in the direction d.
  MediumStack media(const Vec3& d) const {
    if (!surface.interior) [[likely]]
      return media_before;
    const bool came_from_inside = this->frame.to_world(this->wo).dot(this->point.ng) < 0;
    const bool leaves_inside = d.dot(this->point.ng) < 0;
    if (came_from_inside == leaves_inside) return media_before;
    return leaves_inside ? MediumStack{&*surface.interior, media_before.current}
                         : MediumStack{media_before.outer, nullptr};
  }
};

} // namespace render

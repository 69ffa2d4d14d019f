#pragma once
/// What absorbs the light of a path under way.

#include <render/integrator/direction_mixture.h>

namespace render {

/// What absorbs a ray, and what lies around that: of bodies within bodies within bodies the outermost is forgotten.
struct MediumStack {
  const HomogeneousMedium *current = nullptr, *outer = nullptr; ///< null: nothing
};

/// Through what a ray starts, as the surfaces tell that it would leave if nothing stopped it.
MediumStack initial_media(const Scene& scene, Ray ray);

/// Whether anything in the scene absorbs.
bool has_media(const Scene& scene);

/// Where a path meets a surface whose BSDF is a B.
template <class B> struct SurfaceInteraction : ShadingPoint<B> {
  const Surface& surface;
  MediumStack media_before; ///< through what the path came

  /// Through what it leaves in the direction d.
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

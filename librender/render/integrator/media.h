#pragma once
/// What absorbs the light of a path under way.

#include <render/integrator/directions.h>

namespace render {

/// What absorbs a ray, and what lies around that: of bodies within bodies within bodies the outermost is forgotten.
struct Media {
  const HomogeneousMedium *here = nullptr, *around = nullptr; ///< null: nothing
};

/// Through what a ray starts, as the surfaces tell that it would leave if nothing stopped it.
Media media_at(const Scene& scene, Ray ray);

/// Whether anything in the scene absorbs.
bool absorbs(const Scene& scene);

/// Where a path meets a surface whose BSDF is a B.
template <class B> struct Meeting : Vertex<B> {
  const Surface& surface;
  Media before; ///< through what the path came

  /// Through what it leaves in the direction d.
  Media media(const Vec3& d) const {
    if (!surface.interior) [[likely]]
      return before;
    const bool came_from_inside = this->frame.to_world(this->wo).dot(this->point.ng) < 0;
    const bool leaves_inside = d.dot(this->point.ng) < 0;
    if (came_from_inside == leaves_inside) return before;
    return leaves_inside ? Media{&*surface.interior, before.here} : Media{before.around, nullptr};
  }
};

} // namespace render

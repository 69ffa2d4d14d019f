#pragma once
/// Rays.

#include <render/core/types.h>

namespace render {

/// Points o + t d for 0 < t < t_max. d is a unit vector for rays from a camera or surface.
struct Ray {
  Vec3 o,                            ///< Origin.
      d;                             ///< Direction.
  Float t_max = mc::infinity<Float>; ///< Upper limit of t.

  /// The point at parameter t.
  Vec3 at(Float t) const { return o + t * d; }
};

} // namespace render

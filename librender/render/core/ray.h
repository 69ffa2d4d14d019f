#pragma once
/// Rays.

#include <render/core/types.h>

namespace render {

/// Points o + t d for 0 < t < t_max. d is unit where the ray comes from camera or surface.
struct Ray {
  Vec3 o, d;
  Float t_max = mc::infinity<Float>;

  Vec3 at(Float t) const { return o + t * d; }
};

} // namespace render

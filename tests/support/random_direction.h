#pragma once
// Directions for tests of shapes.

#include <render/core/types.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

namespace support {

inline render::Vec3 random_direction(mc::Pcg& random) {
  return mc::UniformSphere<render::Float>{}.sample(random.point<render::Float, 2>());
}

} // namespace support

#pragma once
// Directions for tests of shapes and scenes.

#include <render/core/types.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

namespace support {

inline render::Vec3 random_direction(mc::Pcg& random) {
  return mc::UniformSphere<render::Float>{}.sample(random.point<render::Float, 2>());
}

inline render::Vec3d random_axis(mc::Pcg& random) {
  return mc::UniformSphere<double>{}.sample(random.point<double, 2>());
}

} // namespace support

#include "catalogue_warp.h"

#include <mc/warp/disk.h>
#include <mc/warp/triangle.h>

namespace carlo {

void add_planes(Catalogue& c) {
  add_warp(c, "UniformDisk", "", [](auto s) { return mc::UniformDisk<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "UniformTriangle", "", [](auto s) { return mc::UniformTriangle<decltype(s)>{}; }, {.invert_eps = 4});
}

} // namespace carlo

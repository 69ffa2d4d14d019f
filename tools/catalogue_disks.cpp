#include "catalogue_warp.h"

#include <mc/warp/disk.h>

namespace carlo {

void add_disks(Catalogue& c) {
  add_warp(c, "UniformDisk", "", [](auto s) { return mc::UniformDisk<decltype(s)>{}; }, {.invert_eps = 8});
}

} // namespace carlo

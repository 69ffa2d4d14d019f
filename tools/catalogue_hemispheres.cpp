#include "catalogue_warp.h"

#include <mc/warp/hemisphere.h>

namespace carlo {

void add_hemispheres(Catalogue& c) {
  add_warp(c, "UniformHemisphere", "", [](auto s) { return mc::UniformHemisphere<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "CosineHemisphere", "", [](auto s) { return mc::CosineHemisphere<decltype(s)>{}; }, {.invert_eps = 8});
}

} // namespace carlo

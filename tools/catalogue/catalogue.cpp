#include <catalogue/catalogue.h>

namespace carlo {

const Catalogue& catalogue() {
  static const Catalogue cases = [] {
    Catalogue c;
    add_intervals(c);
    add_planes(c);
    add_spheres(c);
    add_lobes(c);
    add_lights(c);
    add_tables(c);
    add_bsdfs(c);
    add_shapes(c);
    return c;
  }();
  return cases;
}

} // namespace carlo

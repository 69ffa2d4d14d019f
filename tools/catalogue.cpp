#include "catalogue.h"

namespace carlo {

const Catalogue& catalogue() {
  static const Catalogue cases = [] {
    Catalogue c;
    add_disks(c);
    add_hemispheres(c);
    add_bsdfs(c);
    return c;
  }();
  return cases;
}

} // namespace carlo

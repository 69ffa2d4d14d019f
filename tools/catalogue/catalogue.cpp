#include <catalogue/catalogue.h>

#include <catalogue/warp_case.h>

namespace carlo {

void add_case(Catalogue& c, std::string name, std::string parameters, std::string scalar,
              std::function<mc::AnyDistribution(std::string)> make, mc::LawOptions bounds) {
  Case one{std::move(name), std::move(parameters), std::move(scalar), {}};
  bounds.name = one.title();
  one.check = [make = std::move(make), bounds = std::move(bounds)](const CaseOptions& options) {
    mc::LawOptions o = bounds;
    o.statistics = options;
    return check_laws(mc::with_tolerances(make(o.name), o), o);
  };
  c.push_back(std::move(one));
}

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

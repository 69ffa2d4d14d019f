#pragma once
/// Cases of warps.

#include <catalogue/catalogue.h>

#include <mc/check/laws.h>

namespace carlo {

template <class S, class Make>
void add_case(Catalogue& c, const std::string& name, const std::string& parameters, Make make, mc::LawOptions bounds) {
  Case one{name, parameters, sizeof(S) == sizeof(float) ? "float" : "double", {}};
  bounds.name = one.title();
  one.check = [make, bounds](const CaseOptions& options) {
    return check_laws(make(S(0)), mc::with_statistics(bounds, options));
  };
  c.push_back(std::move(one));
}

/// The warp make(S{}) over float and double, with the bounds of its contract. It is made when it is checked.
template <class Make>
void add_warp(Catalogue& c, const std::string& name, const std::string& parameters, Make make,
              const mc::LawOptions& bounds = {}) {
  add_case<float>(c, name, parameters, make, bounds);
  add_case<double>(c, name, parameters, make, bounds);
}

} // namespace carlo

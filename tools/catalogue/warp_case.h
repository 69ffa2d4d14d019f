#pragma once
/// Cases of warps.

#include <catalogue/catalogue.h>

#include <mc/check/laws.h>

namespace carlo {

template <class W>
void add_case(Catalogue& c, std::string name, std::string parameters, std::string scalar, const W& warp,
              mc::LawOptions bounds) {
  Case one{std::move(name), std::move(parameters), std::move(scalar), {}};
  bounds.name = one.title();
  one.check = [warp, bounds](const CaseOptions& options) {
    return check_laws(warp, mc::with_statistics(bounds, options));
  };
  c.push_back(std::move(one));
}

/// The warp make(S{}) over float and double, with the bounds of its contract.
template <class Make>
void add_warp(Catalogue& c, const std::string& name, const std::string& parameters, Make make,
              const mc::LawOptions& bounds = {}) {
  add_case(c, name, parameters, "float", make(0.0f), bounds);
  add_case(c, name, parameters, "double", make(0.0), bounds);
}

} // namespace carlo

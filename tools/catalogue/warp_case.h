#pragma once
/// Cases of warps.

#include <catalogue/catalogue.h>

#include <mc/check/laws.h>

namespace carlo {

/// A sampler over one scalar with the bounds of its contract. make(its title) makes it when it is checked.
void add_case(Catalogue& c, std::string name, std::string parameters, std::string scalar,
              std::function<mc::AnyDistribution(std::string)> make, mc::LawOptions bounds);

/// The warp make(S{}) over float and double, with the bounds of its contract. It is made when it is checked.
template <class Make>
void add_warp(Catalogue& c, const std::string& name, const std::string& parameters, Make make,
              const mc::LawOptions& bounds = {}) {
  add_case(
      c, name, parameters, "float",
      [make](std::string title) { return mc::make_distribution(std::move(title), make(0.0f)); }, bounds);
  add_case(
      c, name, parameters, "double",
      [make](std::string title) { return mc::make_distribution(std::move(title), make(0.0)); }, bounds);
}

} // namespace carlo

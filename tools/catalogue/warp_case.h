#pragma once
/// Adds cases of warps.

#include <catalogue/catalogue.h>

#include <mc/check/laws.h>

namespace carlo {

/// Adds a distribution over one scalar with the error bounds of its contract. make(title) creates it when it is
/// checked.
void add_case(Catalogue& c, std::string name, std::string parameters, std::string scalar,
              std::function<mc::AnyDistribution(std::string)> make, mc::LawOptions bounds);

/// Adds the warp make(S{}) over float and double, with the error bounds of its contract. The warp is created when it is
/// checked.
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

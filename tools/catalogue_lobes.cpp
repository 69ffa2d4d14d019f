#include "catalogue_warp.h"

#include <mc/warp/beckmann.h>
#include <mc/warp/blinn_phong.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

namespace carlo {

// Where a bound depends on the parameter, it is the one of the warp's contract.
void add_lobes(Catalogue& c) {
  for (const double n : {0.0, 1.0, 100.0, 1e7})
    add_warp(c, "BlinnPhong", fmt::format("n={:g}", n), [n](auto s) { return mc::BlinnPhong<decltype(s)>(static_cast<decltype(s)>(n)); });
  for (const double g : {-0.5, 0.0, 0.9, 0.99, 0.9999})
    add_warp(c, "HenyeyGreenstein", fmt::format("g={:g}", g), [g](auto s) { return mc::HenyeyGreenstein<decltype(s)>(static_cast<decltype(s)>(g)); },
             {.invert_eps = 16 / (1 - std::abs(g))});
  for (const double kappa : {0.0, 1e-9, 1.0, 100.0, 1e6, 1e8})
    add_warp(c, "VonMisesFisher", fmt::format("kappa={:g}", kappa), [kappa](auto s) { return mc::VonMisesFisher<decltype(s)>(static_cast<decltype(s)>(kappa)); });
  for (const double alpha : {1e-4, 1e-3, 0.1, 1.0}) {
    add_warp(c, "BeckmannNormals", fmt::format("alpha={:g}", alpha), [alpha](auto s) { return mc::BeckmannNormals<decltype(s)>(static_cast<decltype(s)>(alpha)); });
    add_warp(c, "TrowbridgeReitzNormals", fmt::format("alpha={:g}", alpha),
             [alpha](auto s) { return mc::TrowbridgeReitzNormals<decltype(s)>(static_cast<decltype(s)>(alpha)); });
    for (const double degrees : {0.0, 60.0, 89.9})
      add_warp(c, "TrowbridgeReitzVisibleNormals", fmt::format("alpha={:g}, {:g} degrees", alpha, degrees), [alpha, degrees](auto s) {
        using S = decltype(s);
        const double theta = degrees * mc::pi<double> / 180;
        return mc::TrowbridgeReitzVisibleNormals<S>(mc::spherical_direction<S>(S(std::sin(theta)), S(std::cos(theta)), S(0.7)), S(alpha), S(0.3 * alpha));
      }, {.invert_eps = 512, .sample_eps = 64});
  }
}

} // namespace carlo

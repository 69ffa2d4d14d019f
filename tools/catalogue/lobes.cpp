#include <catalogue/warp_case.h>

#include <mc/warp/beckmann.h>
#include <mc/warp/blinn_phong.h>
#include <mc/warp/half_vector.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

namespace carlo {

namespace {

template <class S> mc::Vec3<S> direction(double degrees) {
  const double theta = degrees * mc::pi<double> / 180;
  return mc::spherical_direction<S>(S(std::sin(theta)), S(std::cos(theta)), S(0.7));
}

// The inverse is less precise for short half vectors: its error is 16 eps / (alpha |half vector|).
void add_half_vectors(Catalogue& c) {
  for (const auto& [alpha, degrees] : {std::pair{1e-4, 0.0}, {0.1, 60.0}, {1.0, 89.9}})
    add_warp(c, "Reflected", fmt::format("visible normals alpha={:g}, {:g} degrees", alpha, degrees),
             [alpha = alpha, degrees = degrees](auto s) {
               using S = decltype(s);
               return mc::Reflected(mc::TrowbridgeReitzVisibleNormals<S>(direction<S>(degrees), S(alpha)));
             },
             {.invert_eps = 1e6, .sample_eps = 64});
  for (const double degrees : {60.0, 120.0})
    add_warp(c, "Reflected", fmt::format("Beckmann alpha=0.1, {:g} degrees", degrees),
             [degrees](auto s) {
               using S = decltype(s);
               return mc::Reflected(direction<S>(degrees), mc::BeckmannNormals<S>(S(0.1)));
             },
             {.invert_eps = 1e5});
  for (const auto& [alpha, degrees] : {std::pair{0.1, 0.0}, {0.1, 60.0}, {1.0, 89.9}}) {
    add_warp(c, "RefractedIn", fmt::format("alpha={:g}, {:g} degrees, eta=1.5", alpha, degrees),
             [alpha = alpha, degrees = degrees](auto s) {
               using S = decltype(s);
               return mc::RefractedIn(mc::TrowbridgeReitzVisibleNormals<S>(direction<S>(degrees), S(alpha)), S(1.5));
             },
             {.invert_eps = 1e6, .sample_eps = 64, .pdf_eps = 1024});
    add_warp(c, "RefractedOut", fmt::format("alpha={:g}, {:g} degrees, eta=2/3", alpha, degrees),
             [alpha = alpha, degrees = degrees](auto s) {
               using S = decltype(s);
               return mc::RefractedOut(mc::TrowbridgeReitzVisibleNormals<S>(direction<S>(degrees), S(alpha)), S(2) / 3);
             },
             {.sample_eps = 1024, .pdf_eps = 1024});
  }
}

} // namespace

// Bounds that depend on a parameter come from the contract of the warp.
void add_lobes(Catalogue& c) {
  for (const double n : {0.0, 1.0, 100.0, 1e7})
    add_warp(c, "BlinnPhong", fmt::format("n={:g}", n),
             [n](auto s) { return mc::BlinnPhong<decltype(s)>(static_cast<decltype(s)>(n)); });
  for (const double g : {-0.5, 0.0, 0.9, 0.99, 0.9999})
    add_warp(c, "HenyeyGreenstein", fmt::format("g={:g}", g),
             [g](auto s) { return mc::HenyeyGreenstein<decltype(s)>(static_cast<decltype(s)>(g)); },
             {.invert_eps = 16 / (1 - std::abs(g))});
  for (const double kappa : {0.0, 1e-9, 1.0, 100.0, 1e6, 1e8})
    add_warp(c, "VonMisesFisher", fmt::format("kappa={:g}", kappa),
             [kappa](auto s) { return mc::VonMisesFisher<decltype(s)>(static_cast<decltype(s)>(kappa)); });
  for (const double alpha : {1e-4, 1e-3, 0.1, 1.0}) {
    add_warp(c, "BeckmannNormals", fmt::format("alpha={:g}", alpha),
             [alpha](auto s) { return mc::BeckmannNormals<decltype(s)>(static_cast<decltype(s)>(alpha)); });
    add_warp(c, "TrowbridgeReitzNormals", fmt::format("alpha={:g}", alpha),
             [alpha](auto s) { return mc::TrowbridgeReitzNormals<decltype(s)>(static_cast<decltype(s)>(alpha)); });
    for (const double degrees : {0.0, 60.0, 89.9})
      add_warp(c, "BeckmannVisibleNormals", fmt::format("alpha={:g}, {:g} degrees", alpha, degrees),
               [alpha, degrees](auto s) {
                 using S = decltype(s);
                 return mc::BeckmannVisibleNormals<S>(direction<S>(degrees), S(alpha), S(0.3 * alpha));
               },
               {.invert_eps = 8, .sample_eps = 64});
    for (const double degrees : {0.0, 60.0, 89.9})
      add_warp(c, "TrowbridgeReitzVisibleNormals", fmt::format("alpha={:g}, {:g} degrees", alpha, degrees),
               [alpha, degrees](auto s) {
                 using S = decltype(s);
                 return mc::TrowbridgeReitzVisibleNormals<S>(direction<S>(degrees), S(alpha), S(0.3 * alpha));
               },
               {.invert_eps = 512, .sample_eps = 64});
  }
  add_half_vectors(c);
}

} // namespace carlo

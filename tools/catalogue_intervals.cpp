#include "catalogue_warp.h"

#include <mc/warp/linear.h>
#include <mc/warp/normal.h>
#include <mc/warp/tent.h>

namespace carlo {

void add_intervals(Catalogue& c) {
  for (const auto& [a, b] : {std::pair{0.0, 1.0}, {1.0, 0.0}, {1.0, 1.0}, {1e-6, 1.0}, {3.0, 2.0}})
    add_warp(c, "Linear", fmt::format("a={:g}, b={:g}", a, b), [a = a, b = b](auto s) { return mc::Linear<decltype(s)>(static_cast<decltype(s)>(a), static_cast<decltype(s)>(b)); },
             {.invert_eps = 8});
  add_warp(c, "Tent", "center=0, radius=1", [](auto s) { return mc::Tent<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "Tent", "center=0, radius=1e-3", [](auto s) { return mc::Tent<decltype(s)>(0, static_cast<decltype(s)>(1e-3)); }, {.invert_eps = 8});
  for (const double sigma : {1.0, 1e-4, 1e4})
    add_warp(c, "Normal", fmt::format("mean=0, sigma={:g}", sigma), [sigma](auto s) { return mc::Normal<decltype(s)>(0, static_cast<decltype(s)>(sigma)); });
}

} // namespace carlo

#include <catalogue/warp_case.h>

#include <mc/warp/exponential.h>
#include <mc/warp/hyperexponential.h>
#include <mc/warp/linear.h>
#include <mc/warp/logistic.h>
#include <mc/warp/normal.h>
#include <mc/warp/power.h>
#include <mc/warp/smoothstep.h>
#include <mc/warp/tent.h>
#include <mc/warp/uniform.h>

namespace carlo {

void add_intervals(Catalogue& c) {
  add_warp(c, "UniformInterval", "lo=-3, hi=1", [](auto s) { return mc::UniformInterval<decltype(s)>(-3, 1); });
  for (const auto& [a, b] : {std::pair{0.0, 1.0}, {1.0, 0.0}, {1.0, 1.0}, {1e-6, 1.0}, {3.0, 2.0}})
    add_warp(c, "Linear", fmt::format("a={:g}, b={:g}", a, b),
             [a = a, b = b](auto s) {
               return mc::Linear<decltype(s)>(static_cast<decltype(s)>(a), static_cast<decltype(s)>(b));
             },
             {.invert_eps = 8});
  add_warp(c, "Tent", "center=0, radius=1", [](auto s) { return mc::Tent<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "Tent", "center=0, radius=1e-3",
           [](auto s) { return mc::Tent<decltype(s)>(0, static_cast<decltype(s)>(1e-3)); }, {.invert_eps = 8});
  for (const double sigma : {1.0, 1e-4, 1e4})
    add_warp(c, "Normal", fmt::format("mean=0, sigma={:g}", sigma),
             [sigma](auto s) { return mc::Normal<decltype(s)>(0, static_cast<decltype(s)>(sigma)); });
  add_warp(c, "Exponential", "rate=2", [](auto s) { return mc::Exponential<decltype(s)>(2); }, {.invert_eps = 8});
  for (const double rate : {1.0, 100.0})
    add_warp(c, "Hyperexponential", fmt::format("weights=(1, 2, 0.5), rates=(1, 0.3, {:g})", rate), [rate](auto s) {
      using S = decltype(s);
      return mc::Hyperexponential<S, 3>({1, 2, S(0.5)}, {1, S(0.3), S(rate)});
    });
  for (const double rate : {0.0, 1e-3, 10.0, -10.0})
    add_warp(c, "TrimmedExponential", fmt::format("rate={:g}, length=2", rate),
             [rate](auto s) { return mc::TrimmedExponential<decltype(s)>(static_cast<decltype(s)>(rate), 2); },
             {.invert_eps = 20});
  add_warp(c, "Logistic", "mean=0, scale=2", [](auto s) { return mc::Logistic<decltype(s)>(0, 2); }, {.invert_eps = 8});
  for (const auto& [lo, hi] : {std::pair{-1.0, 1.0}, {-3.0, 8.0}, {40.0, 41.0}})
    add_warp(c, "TrimmedLogistic", fmt::format("scale=1, lo={:g}, hi={:g}", lo, hi),
             [lo = lo, hi = hi](auto s) {
               return mc::TrimmedLogistic<decltype(s)>(1, static_cast<decltype(s)>(lo), static_cast<decltype(s)>(hi));
             },
             {.invert_eps = 8 * std::max(1.0, lo)});
  add_warp(c, "Smoothstep", "", [](auto s) { return mc::Smoothstep<decltype(s)>{}; }, {.invert_eps = 8});
  for (const double n : {0.0, 0.5, 10.0})
    add_warp(c, "Power", fmt::format("n={:g}", n),
             [n](auto s) { return mc::Power<decltype(s)>(static_cast<decltype(s)>(n)); }, {.invert_eps = 13});
}

} // namespace carlo

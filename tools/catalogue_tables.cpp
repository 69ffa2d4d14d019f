#include "catalogue_warp.h"

#include <mc/table/alias_table.h>
#include <mc/table/table_dist_1d.h>
#include <mc/table/table_dist_2d.h>

namespace carlo {
namespace {

// Weights that jump and vanish, as those of real tables do.
std::vector<double> jagged(std::size_t n) {
  std::vector<double> w(n);
  for (std::size_t i = 0; i < n; ++i) w[i] = i % 7 == 3 ? 0.0 : 1 + static_cast<double>((i * 37) % 11);
  return w;
}

// A sky of width x height with a sun of 3 x 3 pixels that holds half of the light.
std::vector<double> sky(std::size_t width, std::size_t height) {
  std::vector<double> w(width * height);
  double sum = 0;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) sum += w[y * width + x] = 1 + std::cos(3.0 * static_cast<double>(y) / static_cast<double>(height));
  for (std::size_t y = 0; y < 3; ++y)
    for (std::size_t x = 0; x < 3; ++x) w[(height / 5 + y) * width + width / 3 + x] += sum / 9;
  return w;
}

void add_discrete(Catalogue& c, const std::string& parameters, std::vector<double> weights) {
  Case one{"AliasTable", parameters, "double", {}};
  one.check = [title = one.title(), weights = std::move(weights)](const CaseOptions& o) {
    return mc::check_subject(mc::make_discrete_subject(title, mc::AliasTable(weights)), {.samples = o.samples, .seed = o.seed, .alpha = o.alpha});
  };
  c.push_back(std::move(one));
}

} // namespace

void add_tables(Catalogue& c) {
  for (const std::size_t n : {1, 64, 100, 1000})
    add_warp(c, "TableDist1D", fmt::format("n={}", n), [n](auto s) { return mc::TableDist1D<decltype(s)>(jagged(n)); });
  add_warp(c, "TableDist2D", "24x10", [](auto s) { return mc::TableDist2D<decltype(s)>(jagged(240), 24, 10); });
  add_warp(c, "TableDist2D", "128x64 with a sun", [](auto s) { return mc::TableDist2D<decltype(s)>(sky(128, 64), 128, 64); });
  for (const std::size_t n : {1, 10, 1000, 100'000}) add_discrete(c, fmt::format("n={}", n), jagged(n));
  add_discrete(c, "one outcome holds almost all, n=1000", [] {
    std::vector<double> w(1000, 1e-9);
    w[500] = 1;
    return w;
  }());
}

} // namespace carlo

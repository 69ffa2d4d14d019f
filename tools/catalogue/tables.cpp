#include <catalogue/warp_case.h>

#include <mc/table/alias_table.h>
#include <mc/table/discrete.h>
#include <mc/table/table_dist_1d.h>
#include <mc/table/table_dist_2d.h>
#include <mc/table/table_dist_tree.h>

namespace carlo {
namespace {

// Weights with jumps and zeros, as in real tables.
std::vector<double> jagged(std::size_t n) {
  std::vector<double> w(n);
  for (std::size_t i = 0; i < n; ++i) w[i] = i % 7 == 3 ? 0.0 : 1 + static_cast<double>((i * 37) % 11);
  return w;
}

constexpr auto square = [](auto x) { return x * x; };

// A sky of width x height pixels with a sun of 3 x 3 pixels that contains half of the light.
std::vector<double> sky(std::size_t width, std::size_t height) {
  std::vector<double> w(width * height);
  double sum = 0;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      sum += w[y * width + x] = 1 + std::cos(3.0 * static_cast<double>(y) / static_cast<double>(height));
  for (std::size_t y = 0; y < 3; ++y)
    for (std::size_t x = 0; x < 3; ++x) w[(height / 5 + y) * width + width / 3 + x] += sum / 9;
  return w;
}

// Weights from 1e-30 to 1e30, with zeros.
std::vector<double> extreme(std::size_t n) {
  std::vector<double> w(n);
  for (std::size_t i = 0; i < n; ++i) w[i] = i % 5 == 0 ? 0.0 : std::pow(10.0, static_cast<double>((i * 37) % 61) - 30);
  return w;
}

// A ridge that is parallel to no axis, with an empty region.
template <int N> double ridge(const mc::Vec<double, N>& x) {
  const double off = (x.array() - x.mean()).matrix().norm();
  return off < 0.45 ? std::exp(-8 * off) : 0.0;
}

template <int N> void add_tree(Catalogue& c, std::size_t leaves) {
  add_warp(c, "TableDistTree", fmt::format("{} dimensions, {} boxes", N, leaves),
           [leaves](auto s) { return mc::TableDistTree<decltype(s), N>::from_function(ridge<N>, leaves); });
}

// make() returns the table.
template <class Make>
void add_discrete(Catalogue& c, const std::string& name, const std::string& parameters, const std::string& scalar,
                  Make make) {
  Case one{name, parameters, scalar, {}};
  one.check = [title = one.title(), make](const CaseOptions& o) {
    return mc::check_laws(mc::make_discrete_distribution(title, make()), {.statistics = o});
  };
  c.push_back(std::move(one));
}

// Adds the table make(S{}) over float and double.
template <class Make>
void add_outcomes(Catalogue& c, const std::string& name, const std::string& parameters, Make make) {
  add_discrete(c, name, parameters, "float", [make] { return make(0.0f); });
  add_discrete(c, name, parameters, "double", [make] { return make(0.0); });
}

} // namespace

void add_tables(Catalogue& c) {
  for (const std::size_t n : {1, 64, 100, 1000})
    add_warp(c, "TableDist1D", fmt::format("n={}", n), [n](auto s) { return mc::TableDist1D<decltype(s)>(jagged(n)); });
  add_warp(c, "TableDist1D", "n=100 on [-3,7]", [](auto s) {
    return mc::TableDist1D<decltype(s)>(jagged(100), {-3, 7});
  });
  add_warp(c, "TableDist1D", "from x^2, n=64",
           [](auto s) { return mc::TableDist1D<decltype(s)>::from_function(square, 64); });
  for (const std::size_t n : {1, 1000, 100'000})
    add_outcomes(c, "TableDist1D", fmt::format("outcomes, n={}", n),
                 [n](auto s) { return mc::TableDist1D<decltype(s)>(jagged(n)); });
  add_discrete(c, "TableDist1D", "outcomes of weight 1e-30 to 1e30, n=1000", "double",
               [] { return mc::TableDist1D<double>(extreme(1000)); });
  for (const std::size_t n : {1, 3, 1000})
    add_outcomes(c, "UniformDiscrete", fmt::format("n={}", n),
                 [n](auto s) { return mc::UniformDiscrete<decltype(s)>(n); });
  add_outcomes(c, "Bernoulli", "p=0.3", [](auto s) { return mc::Bernoulli<decltype(s)>(decltype(s)(0.3)); });
  add_outcomes(c, "ShortDiscrete", "n=5", [](auto s) {
    using S = decltype(s);
    return mc::ShortDiscrete<S, 8>(std::array{S(0), S(3), S(1e-3), S(20), S(0)});
  });
  add_warp(c, "TableDist2D", "24x10", [](auto s) { return mc::TableDist2D<decltype(s)>(jagged(240), 24, 10); });
  add_warp(c, "TableDist2D", "128x64 with a sun",
           [](auto s) { return mc::TableDist2D<decltype(s)>(sky(128, 64), 128, 64); });
  add_warp(c, "TableDist2D", "64x32 by solid angle, with a sun",
           [](auto s) { return mc::TableDist2D<decltype(s)>::from_lat_long(sky(64, 32), 64, 32); });
  add_tree<2>(c, 1);
  add_tree<2>(c, 200);
  add_tree<3>(c, 300);
  for (const std::size_t n : {1, 10, 1000, 100'000})
    add_discrete(c, "AliasTable", fmt::format("n={}", n), "double", [n] { return mc::AliasTable(jagged(n)); });
  add_discrete(c, "AliasTable", "one outcome holds almost all, n=1000", "double", [] {
    std::vector<double> w(1000, 1e-9);
    w[500] = 1;
    return mc::AliasTable(w);
  });
  add_discrete(c, "AliasTable", "weights 1e-30 to 1e30, n=1000", "double",
               [] { return mc::AliasTable(extreme(1000)); });
}

} // namespace carlo

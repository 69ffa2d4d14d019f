#include <integrands/box_map.h>

#include <mc/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace carlo {

BoxMap::BoxMap(std::vector<VariableBounds> bounds) : bounds_(std::move(bounds)) {
  long double product = 1; // long double: sides may be large and small in any order
  for (const VariableBounds& s : bounds_)
    if (s.is_finite()) product *= s.hi - s.lo;
  volume_ = static_cast<double>(product);
  mc::require(std::isfinite(volume_), "domain: the volume of the {} variables overflows", dim());
  mc::require(volume_ >= std::numeric_limits<double>::min(),
              "domain: the volume of the {} variables is too small for a double", dim());
}

double BoxMap::slope(std::span<const double> u) const {
  double product = volume_;
  for (std::size_t i = 0; i < dim(); ++i)
    if (!bounds_[i].is_finite()) product *= map_to_bounds(bounds_[i], u[i]).slope;
  return product;
}

double BoxMap::map(std::span<const double> u, std::span<double> x) const {
  for (std::size_t i = 0; i < dim(); ++i) x[i] = map_to_bounds(bounds_[i], u[i]).x;
  return slope(u);
}

double BoxMap::unmap(std::span<const double> x, std::span<double> u) const {
  for (std::size_t i = 0; i < dim(); ++i) {
    u[i] = unmap_from_bounds(bounds_[i], x[i]);
    if (!(u[i] > 0 && u[i] < 1)) return 0;
  }
  return slope(u);
}

std::string BoxMap::describe(std::span<const double> u) const {
  return first_variables(dim(), [&](std::size_t i) {
    return fmt::format("{} = {:.9g}", bounds_[i].name, map_to_bounds(bounds_[i], u[i]).x);
  });
}

std::vector<VariableBounds> unit_cube_bounds(int dim) {
  std::vector<VariableBounds> bounds;
  bounds.reserve(static_cast<std::size_t>(dim));
  for (int i = 0; i < dim; ++i) bounds.push_back({fmt::format("u{}", i), 0, 1});
  return bounds;
}

} // namespace carlo

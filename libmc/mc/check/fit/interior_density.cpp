#include <mc/check/fit/interior_density.h>
#include <mc/check/fit/pilot.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mc {
namespace {

Subject::Coordinates moved_inside(Subject::Coordinates v, int dim, double step = 0x1p-500) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
    v[d] = std::clamp(v[d], step, 1 - std::max(step, 0x1p-53));
  return v;
}

// Whether a coordinate is in (0, 2^-500). Only densities like 1 / x put samples there.
bool is_deep(double v) { return v > 0 && v < 0x1p-500; }

// A pole at an end other than 0 is infinite at points of the chart that are rounded onto it. If the density is infinite
// next to such a point too, the search stops: the density may be slow.
void ask_beside_poles(const Subject& s, std::span<const Subject::Coordinates> v, std::span<double> densities) {
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (densities[i] != std::numeric_limits<double>::infinity()) continue;
    const std::optional<double> beside = adjacent_density(s, v[i]);
    if (!beside) return;
    densities[i] = *beside;
  }
}

} // namespace

double interior_density(const Subject& s, const Subject::Coordinates& v) {
  Subject::Coordinates inside = v;
  double density = 0;
  interior_densities(s, {&inside, 1}, {&density, 1});
  return density;
}

void interior_densities(const Subject& s, std::span<Subject::Coordinates> v, std::span<double> densities) {
  std::vector<std::pair<std::size_t, Subject::Coordinates>> deep;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Subject::Coordinates asked = v[i];
    v[i] = moved_inside(asked, s.dim);
    if (std::none_of(asked.begin(), asked.begin() + s.dim, is_deep)) continue;
    deep.emplace_back(i, v[i]);
    for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d)
      if (is_deep(asked[d])) deep.back().second[d] = asked[d];
  }
  if (s.densities) s.densities(v, densities);
  else
    for (std::size_t i = 0; i < v.size(); ++i) densities[i] = s.density(v[i]);
  for (const auto& [i, there] : deep)
    if (const double density = s.density(there); density > 0 && std::isfinite(density)) {
      v[i] = there;
      densities[i] = density;
    }
  ask_beside_poles(s, v, densities);
}

std::optional<double> adjacent_density(const Subject& s, const Subject::Coordinates& v) {
  const auto is_face = [](double x) { return x <= 0 || x >= 1; };
  const auto positive = [](double density) { return density > 0 && std::isfinite(density); };
  const double there = s.density(v);
  if (positive(there)) return {};
  if (std::any_of(v.begin(), v.begin() + s.dim, is_face))
    for (const double step : {0x1p-500, 0x1p-52, 0x1p-30}) {
      const double beside = s.density(moved_inside(v, s.dim, step));
      if (positive(beside)) return beside;
    }
  if (!(there >= 0)) return {};
  for (const double steps : {1.0, 8.0, min_resolved_steps})
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(s.dim); ++axis) {
      const double step = steps * rounding_step(s, v, axis);
      for (const double to : {v[axis] - step, v[axis] + step}) {
        Subject::Coordinates moved = v;
        moved[axis] = std::clamp(to, 0.0, 1.0);
        const double beside = s.density(moved);
        if (positive(beside)) return beside;
      }
    }
  return {};
}

} // namespace mc

#include <mc/check/fit/unresolved_ends.h>

#include <mc/check/fit/pilot.h>
#include <mc/core/types.h>
#include <mc/random/hash.h>
#include <mc/random/uniform.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mc {
namespace {

using Coordinates = Subject::Coordinates;

constexpr double widest_layer = 0x1p-10;

double from_end(double v) { return std::min(v, 1 - v); }

// Whether a coordinate is so near an end that it may lie in a layer; true for few points.
bool is_near_end(const Coordinates& v, std::size_t dim) {
  for (std::size_t d = 0; d < dim; ++d)
    if (!(from_end(v[d]) > widest_layer)) return true;
  return false;
}

Coordinates at_distance(Coordinates v, std::size_t axis, double distance) {
  v[axis] = v[axis] < 0.5 ? distance : 1 - distance;
  return v;
}

// Returns the width of the layer of an axis that contains v; no value outside of the layers. The width is a power of
// two between 16 and 32 rounding steps, so that a border of cells, which is min_resolved_steps away, lies outside.
std::optional<double> layer_around(const Subject& s, const Coordinates& v, std::size_t axis) {
  const double distance = from_end(v[axis]);
  const double step = rounding_step(s, at_distance(v, axis, widest_layer), axis);
  const double width = std::exp2(std::ceil(std::log2(16 * step)));
  if (!(distance < width && width < widest_layer)) return {};
  // Charts of infinite domains have no point on some faces. Where the steps shrink with the distance, there is no
  // layer.
  const Coordinates inside = v[axis] > 0.5 ? at_distance(v, axis, std::max(distance, 0x1p-53)) : v;
  if (!(rounding_step(s, inside, axis) > step / 4)) return {};
  const auto is_beside = [&](double at) { return std::abs(at - v[axis]) <= 64 * width; };
  if (std::any_of(s.breaks[axis].begin(), s.breaks[axis].end(), is_beside)) return {};
  return width;
}

// Returns the density averaged over the layers of axis `axis` and of all later axes; no value if none of them contains
// v, or if the density follows no power law there.
std::optional<double> average(const Subject& s, const Coordinates& v, std::size_t axis) {
  if (axis == static_cast<std::size_t>(s.dim)) return {};
  if (!(from_end(v[axis]) <= widest_layer)) return average(s, v, axis + 1);
  const std::optional<double> width = layer_around(s, v, axis);
  if (!width) return average(s, v, axis + 1);
  const auto density = [&](double distance) {
    const Coordinates at = at_distance(v, axis, distance);
    return average(s, at, axis + 1).value_or(s.density(at));
  };
  const auto is_positive = [](double d) { return d > 0 && std::isfinite(d); };
  constexpr double far = 64, near = 0.25;
  const double edge = density(*width), outside = density(far * *width), inside = density(near * *width);
  if (!is_positive(edge) || !is_positive(outside) || !is_positive(inside)) return {};
  // The density is proportional to distance^(exponent - 1), and rises within the layer by at least half of that: the
  // flank of a smooth lobe falls as steeply, but its top is flat.
  const double exponent = 1 + std::log(outside / edge) / std::log(far);
  const double continued = edge * std::pow(near, exponent - 1);
  const bool is_continued =
      inside < 1.5 * continued && inside > continued / 1.5 && sqr(inside / edge) > continued / edge;
  if (!(exponent > 0 && exponent < 0.95 && is_continued)) return {};
  return edge / exponent;
}

void average_all(const Subject& s, std::span<const Coordinates> v, std::span<double> densities) {
  for (std::size_t i = 0; i < v.size(); ++i)
    if (is_near_end(v[i], static_cast<std::size_t>(s.dim)))
      if (const auto averaged = average(s, v[i], 0)) densities[i] = *averaged;
}

// Where the radius is 0, at a pole or at a vertex of a triangle, the next coordinate of a point is arbitrary; the chart
// returns 0.
void turn_at_pole(const Subject& s, std::uint64_t seed, Subject::Draw& d) {
  if (d.kind != Subject::Draw::Kind::point) return;
  for (std::size_t axis = 1; axis < std::min(s.axes.size(), static_cast<std::size_t>(s.dim)); ++axis) {
    const Axis& first = s.axes[axis - 1];
    const double v = d.v[axis - 1];
    const bool polar = first.scale == Axis::Scale::polar, radius = first.scale == Axis::Scale::radius;
    const bool at_pole = (polar || radius) && (first.value(v) == 0 || (polar && v == 1));
    if (at_pole && d.v[axis] == 0) d.v[axis] = uniform<double>(seed);
  }
}

// Rounding of the point changes the density too much to compare a stated weight with it.
void average_draw(const Subject& s, Subject::Draw& d) {
  if (d.kind != Subject::Draw::Kind::point) return;
  // At a pole rounding leads to infinity, or to no number beyond the edge. A pdf of 0 is the fault of the distribution.
  const double stated = d.density < 0 ? s.density(d.v) : d.density;
  if (stated <= 0) return;
  const auto averaged = average(s, d.v, 0);
  if (!averaged) return;
  d.density = *averaged;
  d.weight = 1;
  d.at_pole = true;
}

} // namespace

Subject average_unresolved_ends(const Subject& given) {
  if (given.dim == 0) return given;
  const auto original = std::make_shared<const Subject>(given);
  Subject s = given;
  s.density = [original](const Coordinates& v) {
    double density = original->density(v);
    average_all(*original, {&v, 1}, {&density, 1});
    return density;
  };
  if (given.densities)
    s.densities = [original](std::span<const Coordinates> v, std::span<double> densities) {
      original->densities(v, densities);
      average_all(*original, v, densities);
    };
  s.draw = [original](std::uint64_t stream, std::size_t n, std::vector<Subject::Draw>& out) {
    const std::size_t first = out.size();
    original->draw(stream, n, out);
    for (std::size_t i = first; i < out.size(); ++i) {
      if (!is_near_end(out[i].v, static_cast<std::size_t>(original->dim))) continue;
      turn_at_pole(*original, hash(stream, i - first), out[i]);
      average_draw(*original, out[i]);
    }
  };
  return s;
}

} // namespace mc

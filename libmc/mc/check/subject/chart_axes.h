#pragma once
/// The axes of the charts of all domains.

#include <mc/check/subject/axis.h>
#include <mc/domain/annulus.h>
#include <mc/domain/ball.h>
#include <mc/domain/box.h>
#include <mc/domain/cap.h>
#include <mc/domain/disk.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/domain/product.h>
#include <mc/domain/rotated.h>
#include <mc/domain/sphere.h>
#include <mc/domain/triangle.h>
#include <mc/domain/unit_quaternions.h>

#include <fmt/format.h>

#include <vector>

namespace mc {

/// Axes of directions about a pole, with 1 - cos theta in [0, h].
inline std::vector<Axis> polar_axes(double h) {
  return {{"theta", Axis::Scale::polar, 0, h}, {"phi", Axis::Scale::azimuth, 0, 1}};
}

/// Returns the meaning of each chart coordinate of a domain. Domains without an overload, for example patches, have
/// axes v0, v1, ... without a meaning.
template <Domain D> std::vector<Axis> chart_axes(const D&) {
  std::vector<Axis> axes(std::size_t{D::dim});
  for (std::size_t i = 0; i < axes.size(); ++i) axes[i].name = D::dim == 1 ? std::string("v") : fmt::format("v{}", i);
  return axes;
}
/// @cond
template <Real S> std::vector<Axis> chart_axes(const Interval<S>& d) {
  return {{"x", Axis::Scale::linear, static_cast<double>(d.lo), static_cast<double>(d.hi)}};
}
template <Real S> std::vector<Axis> chart_axes(const HalfLine<S>& d) {
  return {{"x", Axis::Scale::half_line, static_cast<double>(d.origin), static_cast<double>(d.scale)}};
}
template <Real S> std::vector<Axis> chart_axes(const RealLine<S>& d) {
  return {{"x", Axis::Scale::real_line, static_cast<double>(d.center), static_cast<double>(d.scale)}};
}
template <Real S> std::vector<Axis> chart_axes(const Disk<S>&) {
  return {{"r", Axis::Scale::radius, 0, 1}, {"phi", Axis::Scale::azimuth, 0, 1}};
}
template <Real S> std::vector<Axis> chart_axes(const Annulus<S>& d) {
  return {{"r", Axis::Scale::radius, static_cast<double>(d.inner), static_cast<double>(d.outer)},
          {"phi", Axis::Scale::azimuth, 0, 1}};
}
template <Real S> std::vector<Axis> chart_axes(const Triangle<S>&) {
  return {{"1 - b0", Axis::Scale::radius, 1, 0}, {"b1 / (1 - b0)", Axis::Scale::linear, 0, 1}};
}
template <Real S> std::vector<Axis> chart_axes(const Sphere<S>&) { return polar_axes(2); }
template <Real S> std::vector<Axis> chart_axes(const Hemisphere<S>&) { return polar_axes(1); }
template <Real S> std::vector<Axis> chart_axes(const Ball<S>&) {
  std::vector<Axis> axes = polar_axes(2);
  axes.insert(axes.begin(), {"r", Axis::Scale::ball_radius, 0, 1});
  return axes;
}
template <Real S> std::vector<Axis> chart_axes(const Cap<S>& d) { return polar_axes(static_cast<double>(d.h)); }
template <Real S> std::vector<Axis> chart_axes(const UnitQuaternions<S>&) {
  return {{"z^2 + w^2", Axis::Scale::linear, 0, 1},
          {"azimuth of (w, z)", Axis::Scale::linear, 0, 180},
          {"azimuth of (y, x)", Axis::Scale::azimuth, 0, 1}};
}
template <Domain D> std::vector<Axis> chart_axes(const RotatedDomain<D>& d) { return chart_axes(d.inner); }
template <Real S, int N> std::vector<Axis> chart_axes(const Box<S, N>& d) {
  std::vector<Axis> axes;
  for (int i = 0; i < d.dimension(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const std::string name = k < 3 ? std::string(1, "xyz"[k]) : fmt::format("x{}", i);
    axes.push_back({name, Axis::Scale::linear, static_cast<double>(d.lo[i]), static_cast<double>(d.hi[i])});
  }
  return axes;
}
template <Domain A, Domain B> std::vector<Axis> chart_axes(const ProductDomain<A, B>& d) {
  std::vector<Axis> axes = chart_axes(d.first);
  for (Axis axis : chart_axes(d.second)) {
    for (const Axis& other : std::vector<Axis>(axes))
      if (other.name == axis.name) axis.name = axis.name == "x" ? "y" : axis.name + "'";
    axes.push_back(std::move(axis));
  }
  return axes;
}
/// @endcond

} // namespace mc

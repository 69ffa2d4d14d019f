#pragma once
/// Meaning of chart coordinates, for reports and maps.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace mc {

/// Largest dimension of a chart.
inline constexpr std::size_t max_chart_dim = 6;
/// One value for each chart coordinate; the entries beyond the dimension are unused.
template <class T> using PerAxis = std::array<T, max_chart_dim>;
/// The corner of the unit cube with the largest coordinates.
inline constexpr PerAxis<double> unit_corner = {1, 1, 1, 1, 1, 1};

/// A chart coordinate v in [0,1] and the quantity of the domain that it represents, a monotone function of v alone:
///   linear      : a (1 - v) + b v.
///   radius      : sqrt(a^2 + (b^2 - a^2) v).
///   ball_radius : b cbrt(v).
///   half_line   : a + b v / (1 - v).
///   real_line   : a + 2 b w / (1 - w^2), w = 2 v - 1.
///   polar       : the angle theta from the pole [deg], with 1 - cos theta = b v.
///   azimuth     : 360 v [deg], periodic.
struct Axis {
  /// The function from v to the quantity.
  enum class Scale { linear, radius, ball_radius, half_line, real_line, polar, azimuth };

  /// Name of the quantity.
  std::string name = "v";
  Scale scale = Scale::linear; ///< the function
  double a = 0,                ///< first parameter of the function
      b = 1;                   ///< second parameter of the function

  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& archive) { archive(name, scale, a, b); }

  /// Returns the quantity at v.
  double value(double v) const {
    switch (scale) {
    case Scale::linear: return a * (1 - v) + b * v;
    case Scale::radius: return std::sqrt(a * a + (b - a) * (b + a) * v);
    case Scale::ball_radius: return b * std::cbrt(v);
    case Scale::half_line: return a + b * (v / (1 - v));
    case Scale::real_line: return a + b * ((2 * v - 1) / (2 * v * (1 - v)));
    case Scale::polar: return 360 / std::numbers::pi * std::asin(std::sqrt(std::min(b * v / 2, 1.0)));
    case Scale::azimuth: return 360 * v;
    }
    return v;
  }
  /// Returns "deg" for angles, else an empty string.
  std::string_view unit() const { return scale == Scale::polar || scale == Scale::azimuth ? "deg" : ""; }
};

/// Returns the name of an axis; "v0", "v1", ... for axes without a name.
inline std::string axis_name(const std::vector<Axis>& axes, std::size_t axis) {
  return axis < axes.size() ? axes[axis].name : "v" + std::to_string(axis);
}

/// Returns the enumerator as text.
constexpr std::string_view name(Axis::Scale s) {
  switch (s) {
  case Axis::Scale::linear: return "linear";
  case Axis::Scale::radius: return "radius";
  case Axis::Scale::ball_radius: return "ball_radius";
  case Axis::Scale::half_line: return "half_line";
  case Axis::Scale::real_line: return "real_line";
  case Axis::Scale::polar: return "polar";
  case Axis::Scale::azimuth: return "azimuth";
  }
  return "";
}

} // namespace mc

#pragma once
/// Domain: a set with a chart from the unit cube and a measure.

#include <mc/core/types.h>

#include <string_view>

namespace mc {

/// Measure with respect to which densities on a domain are defined.
enum class Measure {
  length,      ///< Length on a line.
  area,        ///< Area in a plane or on a surface.
  solid_angle, ///< Solid angle on the unit sphere [sr].
  volume       ///< Volume in space or in a box of any dimension.
};

/// Name of a measure for messages, such as "solid angle".
constexpr std::string_view name(Measure m) {
  switch (m) {
  case Measure::length: return "length";
  case Measure::area: return "area";
  case Measure::solid_angle: return "solid angle";
  case Measure::volume: return "volume";
  }
  return "";
}

/// Whether a distribution about `center` may have the width (or area, or volume) `scale`.
///   range  : scale in [min / eps, max eps] of S, so that densities near 1 / scale neither overflow nor vanish,
///            including the tails.
///   center : scale >= 8 eps |center|, the resolution of S at the center.
template <Real S> bool is_valid_scale(const S& scale, const S& center = S(0)) {
  using Limits = std::numeric_limits<S>;
  using std::abs;
  return scale >= Limits::min() / Limits::epsilon() && scale <= Limits::max() * Limits::epsilon() &&
         scale >= 8 * Limits::epsilon() * S(abs(center));
}

/// A set X with a chart. The chart maps the open unit cube (0,1)^dim onto X, up to a set of measure zero.
///   jacobian(v) : |dx/dv| in the measure of X. The integral of f over X equals the integral of f(from_unit(v))
///                 jacobian(v) over the cube.
///   UnitPoint   : Point<Scalar, dim>, a scalar if dim = 1.
///   Point       : The type of samples: a scalar, Vec2, or a unit Vec3 for directions.
///   contains(x) : Membership to within a few eps, including unit length for directions. False for non-finite points.
template <class D>
concept Domain = requires(const D d, typename D::Point x, typename D::UnitPoint v) {
  typename D::Scalar;
  { D::dim } -> std::convertible_to<int>;
  { D::measure } -> std::convertible_to<Measure>;
  { d.from_unit(v) } -> std::convertible_to<typename D::Point>;
  { d.to_unit(x) } -> std::convertible_to<typename D::UnitPoint>;
  { d.jacobian(v) } -> std::convertible_to<typename D::Scalar>;
  { d.contains(x) } -> std::convertible_to<bool>;
};

} // namespace mc

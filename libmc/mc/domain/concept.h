#pragma once
/// What the checkers and integrators need to know about a set: a chart from the unit cube, and its measure.

#include <mc/core/types.h>

#include <string_view>

namespace mc {

/// What a density on the domain is measured against.
enum class Measure { length, area, solid_angle, volume };

constexpr std::string_view name(Measure m) {
  switch (m) {
  case Measure::length: return "length";
  case Measure::area: return "area";
  case Measure::solid_angle: return "solid angle";
  case Measure::volume: return "volume";
  }
  return "";
}

/// Whether a distribution may have the width (or area, or volume) `scale` about `center`: [min / eps, max eps] of the
/// scalar, so that no density about 1 / scale overflows or vanishes, tails included; and at least 8 eps |center|, the
/// distance between numbers there.
template <Real S> bool is_valid_scale(const S& scale, const S& center = S(0)) {
  using Limits = std::numeric_limits<S>;
  using std::abs;
  return scale >= Limits::min() / Limits::epsilon() && scale <= Limits::max() * Limits::epsilon() &&
         scale >= 8 * Limits::epsilon() * S(abs(center));
}

/// A set X with a chart: from_unit maps the open unit cube (0,1)^dim onto X up to a set of measure zero, and
///                       jacobian(v) is
/// |dx/dv| in the measure of X, so  integral over X of f dx = integral over the cube of f(from_unit(v)) jacobian(v) dv.
///   UnitPoint : Point<Scalar, dim> (a scalar when dim = 1)
///   Point     : what a warp onto X returns (a scalar, Vec2, or a unit Vec3 for directions)
///   contains  : membership to a few eps (unit length for directions); false for anything non-finite
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

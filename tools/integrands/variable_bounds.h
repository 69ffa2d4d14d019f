#pragma once
/// Bounds of variables, parsed from an option.

#include <cmath>
#include <string>
#include <vector>

namespace carlo {

/// A variable with its bounds, lo < hi; each may be infinite.
struct VariableBounds {
  std::string name;
  double lo, hi;

  bool is_finite() const { return std::isfinite(lo) && std::isfinite(hi); }
};

/// Parses "x=0:1,y=-1:2,z=0:inf". A bound may be a constant expression, as in "phi=-_pi:2*_pi"; see parse_function.
///   throws : Error that names --domain for anything else.
std::vector<VariableBounds> parse_bounds(const std::string& box);

/// The image of u in [0,1] within the bounds: x, which increases with u, and dx/du.
///   finite   : x = lo (1 - u) + hi u.
///   lo:inf   : x = lo + u / (1 - u) [PiessensEtAl83]; -inf:hi is mirrored.
///   -inf:inf : x = t / (1 - t^2), t = 2 u - 1.
struct MappedPoint {
  double x, slope;
};
inline MappedPoint map_to_bounds(const VariableBounds& s, double u) {
  if (s.is_finite()) return {s.lo * (1 - u) + s.hi * u, s.hi - s.lo};
  if (std::isfinite(s.lo)) return {s.lo + u / (1 - u), 1 / ((1 - u) * (1 - u))};
  if (std::isfinite(s.hi)) return {s.hi - (1 - u) / u, 1 / (u * u)};
  const double t = 2 * u - 1, rest = 4 * u * (1 - u); // 1 - t^2
  return {t / rest, 2 * (1 + t * t) / (rest * rest)};
}

} // namespace carlo

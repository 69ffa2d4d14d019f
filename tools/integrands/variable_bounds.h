#pragma once
/// Bounds of variables, parsed from an option.

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// A variable with its bounds, lo < hi; each may be infinite.
struct VariableBounds {
  std::string name;
  double lo, hi;

  bool is_finite() const { return std::isfinite(lo) && std::isfinite(hi); }
};

/// A variable as a domain describes it.
struct VariableText {
  enum class Kind {
    interval, ///< "x=0:1": a real number between two bounds
    normal,   ///< "z=normal" or "z=normal(0, 1)": a normal variable with a mean and a standard deviation
    integers  ///< "k=1..6": the whole numbers between two bounds
  };
  std::string text; ///< the whole
  std::string name;
  Kind kind;
  std::string first, second; ///< expressions of the bounds, or of mean and standard deviation
};

/// Splits "x=0:1,y=0:sqrt(x),k=1..6,z=normal" at the commas outside parentheses. Does not parse the expressions.
///   throws : Error that names --domain for text of another form, and for a name that is invalid or stands twice.
std::vector<VariableText> split_domain(std::string_view domain);

/// Whether the text has the form of a domain, as "y=0:1".
bool is_domain(std::string_view text);

/// Parses "x=0:1,y=-1:2,z=0:inf". A bound may be a constant expression, as in "phi=-_pi:2*_pi"; see parse_function.
///   throws : Error that names --domain for anything else.
std::vector<VariableBounds> parse_bounds(const std::string& box);

/// The value of a number, inf, -inf or an expression over these names and values.
///   throws : Error that quotes the text, with the whole that contains it.
double parse_bound(const std::string& text, std::string_view whole, const std::vector<std::string>& names = {},
                   const std::vector<double>& values = {});

/// lo (1 - u) + hi u for finite bounds. Rounding carries no u of (0,1) to a bound.
inline double between(double lo, double hi, double u) {
  const double x = lo * (1 - u) + hi * u;
  if (x <= lo && u > 0) return std::nextafter(lo, hi);
  if (x >= hi && u < 1) return std::nextafter(hi, lo);
  return x;
}

/// The image of u in [0,1] within the bounds: x, which increases with u, and dx/du. The image of (0,1) is strictly
/// inside.
///   finite   : x = lo (1 - u) + hi u.
///   lo:inf   : x = lo + u / (1 - u) [PiessensEtAl83]; -inf:hi is mirrored.
///   -inf:inf : x = t / (1 - t^2), t = 2 u - 1.
struct MappedPoint {
  double x, slope;
};
inline MappedPoint map_to_bounds(double lo, double hi, double u) {
  if (std::isfinite(lo) && std::isfinite(hi)) return {between(lo, hi, u), hi - lo};
  if (std::isfinite(lo)) {
    const double x = lo + u / (1 - u);
    return {x <= lo && u > 0 ? std::nextafter(lo, hi) : x, 1 / ((1 - u) * (1 - u))};
  }
  if (std::isfinite(hi)) {
    const double x = hi - (1 - u) / u;
    return {x >= hi && u < 1 ? std::nextafter(hi, lo) : x, 1 / (u * u)};
  }
  const double t = 2 * u - 1, rest = 4 * u * (1 - u); // 1 - t^2
  return {t / rest, 2 * (1 + t * t) / (rest * rest)};
}
inline MappedPoint map_to_bounds(const VariableBounds& s, double u) { return map_to_bounds(s.lo, s.hi, u); }

/// The image of u in [0,1) among the whole numbers between lo and hi, and the inverse of its probability.
///   finite   : equal probabilities.
///   lo..inf  : lo + j with probability 1 / ((j + 1) (j + 2)); -inf..hi is mirrored.
///   -inf..inf: j and -1 - j with half of that probability each.
MappedPoint map_to_integers(double lo, double hi, double u);

/// The u that map_to_bounds maps to x; outside of [0,1] for an x beyond finite bounds.
inline double unmap_from_bounds(const VariableBounds& s, double x) {
  if (s.is_finite()) return (x - s.lo) / (s.hi - s.lo);
  if (std::isfinite(s.lo)) return (x - s.lo) / (1 + (x - s.lo));
  if (std::isfinite(s.hi)) return 1 / (1 + (s.hi - x));
  const double h = std::hypot(1, 2 * x);
  return x < 0 ? (1 + 1 / (h - 2 * x)) / (2 * (1 + h)) : 0.5 + x / (1 + h);
}

/// The first eight of `count` variables as one(i) writes them, with commas, and how many there are if there are more.
template <class F> std::string first_variables(std::size_t count, F&& one) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(count, most); ++i) text += (i > 0 ? ", " : "") + one(i);
  return count > most ? text + ", ... (" + std::to_string(count) + " variables)" : text;
}

} // namespace carlo

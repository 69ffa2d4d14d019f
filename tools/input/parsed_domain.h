#pragma once
/// Domains from text, given by --domain or by a plugin.

#include <mc/check/subject/any_distribution.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// Precision of the coordinates of points, which determines the tolerance of `contains`.
enum class Rounding {
  printed, ///< to some decimal digits: unit vectors to 1e-5, edges to 1e-6
  doubles, ///< as in libmc's domains over double
  floats   ///< as in libmc's domains over float
};

/// A domain with the names of its columns.
struct ParsedDomain {
  mc::AnyDomain chart;              ///< dimension 0 for discrete outcomes
  std::vector<std::string> columns; ///< one for each number of a point
  std::string text;                 ///< "x in [0, 1], the unit sphere"
  int outcomes = 0;                 ///< 0 for a continuous domain

  bool contains(const double* x) const;
};

/// Returns the quartiles of a column of the samples. The charts of infinite intervals are centred on them.
using Quartiles = std::function<std::array<double, 3>(std::size_t column)>;
/// Quartiles for a column without data.
std::array<double, 3> unknown_quartiles(std::size_t column);
/// The quartiles of the finite values of a column; unknown_quartiles if there are none.
std::array<double, 3> quartiles_of(std::vector<double> column);

/// Converts the places where a density jumps, in units of each axis, to chart coordinates.
///   throws : Error for places outside of an axis.
using Breaks = std::array<std::vector<double>, 3>;
Breaks chart_breaks(const mc::AnyDomain& domain, const Breaks& places);

/// Parses places by the names of the axes, "x=0.25,0.5,theta=0:90:15", with lists and ranges as in parameters.h. Axes
/// are the columns of intervals, r and phi of disk and annulus, theta and phi of sphere and hemisphere. Angles are in
/// degrees.
///   throws : Error that names --breaks for anything else, or for an axis that the domain does not have.
Breaks parse_breaks(const std::string& text, const mc::AnyDomain& domain);

/// Parses parts separated by commas, in the order of the columns:
///   NAME=LO:HI        : an interval; either end may be -inf or inf.
///   disk, annulus=R   : x^2 + y^2 <= 1, and additionally >= R^2; columns x, y.
///   triangle          : x >= 0, y >= 0, x + y <= 1; columns x, y.
///   ball              : x^2 + y^2 + z^2 <= 1; columns x, y, z.
///   sphere, hemisphere: unit vectors, and additionally z >= 0; columns x, y, z.
///   discrete=N        : outcomes 0 to N - 1 in a column i; not combined with other parts.
///   throws : Error for anything else, more than three dimensions or four columns, or a repeated name.
ParsedDomain parse_domain(const std::string& text, const Quartiles& quartiles = unknown_quartiles,
                          Rounding rounding = Rounding::printed);

} // namespace carlo

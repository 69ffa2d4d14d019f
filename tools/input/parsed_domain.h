#pragma once
/// Domains that are chosen as text, by --domain or by a plugin.

#include <mc/check/subject/any_distribution.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// What the numbers of points are rounded to: it decides who is in a domain.
enum class Rounding {
  printed, ///< to some digits: unit vectors to 1e-5, edges to 1e-6
  doubles, ///< as the domains of libmc over double have it
  floats   ///< and over float
};

/// A domain with the names of its columns.
struct ParsedDomain {
  mc::AnyDomain chart;              ///< of dim 0 for discrete outcomes
  std::vector<std::string> columns; ///< as many as a point has numbers
  std::string text;                 ///< "x in [0, 1], the unit sphere"
  int outcomes = 0;                 ///< 0 for a continuous domain

  bool contains(const double* x) const;
};

/// The quartiles of a column of the samples, on which the charts of infinite intervals are centred.
using Quartiles = std::function<std::array<double, 3>(std::size_t column)>;
/// Those of nothing known.
std::array<double, 3> unknown_quartiles(std::size_t column);
/// Those of a column of rows, leaving out what is not finite; unknown_quartiles where nothing is left.
std::array<double, 3> quartiles_of(std::vector<double> column);

/// Where a density jumps along each axis of a domain, in the quantity of the axis, as chart coordinates.
///   throws : Error for places that the axis does not have
using Breaks = std::array<std::vector<double>, 3>;
Breaks chart_breaks(const mc::AnyDomain& domain, const Breaks& places);

/// Places by the names of the axes, "x=0.25,0.5,theta=0:90:15": lists and ranges as in parameters.h. Axes are the
/// columns of intervals; r and phi of disk and annulus; theta and phi of sphere and hemisphere; angles in degrees.
///   throws : Error that names --breaks for anything else, or an axis that the domain does not have
Breaks parse_breaks(const std::string& text, const mc::AnyDomain& domain);

/// Parts separated by commas, in the order of the columns:
///   NAME=LO:HI        : an interval; either end may be -inf or inf
///   disk, annulus=R   : x^2 + y^2 <= 1, and from R^2; columns x, y
///   triangle          : x >= 0, y >= 0, x + y <= 1; columns x, y
///   ball              : x^2 + y^2 + z^2 <= 1; columns x, y, z
///   sphere, hemisphere: unit vectors, and of z >= 0; columns x, y, z
///   discrete=N        : outcomes 0 to N - 1 in a column i; alone
///   throws : Error for anything else, more than three dimensions or four columns, or a name that stands twice
ParsedDomain parse_domain(const std::string& text, const Quartiles& quartiles = unknown_quartiles,
                          Rounding rounding = Rounding::printed);

} // namespace carlo

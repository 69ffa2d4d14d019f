#pragma once
/// Domains from text, given by --domain or by a plugin.

#include <mc/check/subject/any_distribution.h>
#include <mc/check/subject/outcomes.h>

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

/// A domain with the names of its columns. The first column of a row of a domain with points and outcomes is the
/// number of an outcome, which has no point, or negative for a point.
struct ParsedDomain {
  mc::AnyDomain chart;              ///< domain of the points; dimension 0 for outcomes alone
  std::vector<std::string> columns; ///< names of the numbers of a row
  std::string text;                 ///< "x in [0, 1], the unit sphere"
  mc::Outcomes outcomes = {};       ///< none for a continuous domain

  /// Whether rows have points and outcomes.
  bool is_mixed() const { return chart.dim > 0 && outcomes.any(); }
  /// Whether a row is a point, inside or outside of the domain.
  bool is_point(const double* row) const { return !outcomes.any() || (is_mixed() && row[0] < 0); }
  /// The index of the outcome of a row; -1 for a point, or for a number that is no outcome.
  int outcome_of(const double* row) const;
  /// The point of a row.
  mc::PointArray point_of(const double* row) const;
  /// The row of a point.
  std::vector<double> row_of(const mc::PointArray& x) const;
  /// The row of an outcome.
  std::vector<double> row_of(int outcome) const;
  /// Whether the row is a point of the domain or an outcome.
  bool contains(const double* row) const;
};

/// Returns the quartiles of a column of the samples. The charts of infinite intervals are centred on them.
using Quartiles = std::function<std::array<double, 3>(std::size_t column)>;
/// Quartiles for a column without data.
std::array<double, 3> unknown_quartiles(std::size_t column);
/// The quartiles of the finite values of a column; unknown_quartiles if there are none.
std::array<double, 3> quartiles_of(std::vector<double> column);

/// Converts the places where a density jumps, in units of each axis, to chart coordinates.
///   throws : Error for places outside of an axis.
using Breaks = mc::PerAxis<std::vector<double>>;
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
///   rotation          : unit quaternions, q and -q the same; columns x, y, z, w (scalar part).
///   sphere, hemisphere: unit vectors, and additionally z >= 0; columns x, y, z.
///   discrete=N        : outcomes 0 to N - 1 in a column i; not combined with other parts.
///   discrete=LO:HI    : outcomes LO to HI, whole numbers; either end may be -inf or inf.
///   outcome=N         : outcomes 0 to N - 1 in a first column `outcome`, which is negative for a point of the other
///                       parts.
///   throws : Error for anything else, more than six dimensions or columns, or a repeated name.
ParsedDomain parse_domain(const std::string& text, const Quartiles& quartiles = unknown_quartiles,
                          Rounding rounding = Rounding::printed);

} // namespace carlo

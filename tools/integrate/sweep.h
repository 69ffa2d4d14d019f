#pragma once
/// Integrals for several values of parameters.

#include <report/integrate_output.h>

#include <string>
#include <vector>

namespace carlo {

/// Values of --set for one integration.
struct SweepPoint {
  std::vector<std::string> settings; ///< "a=1.5", one for each --set
  SweptValues swept;                 ///< the parameters with a range
};

/// All combinations of the values of "a=2" and of ranges "a=LO:HI:STEP", whose numbers may be constant expressions. The
/// last range varies fastest. One point if there is no range.
///   throws : Error that names --set, for another form, a step that does not lead from LO to HI, or more than 500
///            points.
std::vector<SweepPoint> sweep_points(const std::vector<std::string>& settings);

/// A table for each integral and each derived value, with one row per point.
std::string sweep_table(const IntegrateResults& found);
/// One row per point and integral or derived value.
std::string sweep_csv(const IntegrateResults& found);
/// A gnuplot script that draws sweep.csv over the first swept parameter.
std::string sweep_script(const IntegrateResults& found);

} // namespace carlo

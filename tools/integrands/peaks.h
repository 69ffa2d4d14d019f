#pragma once
/// Named peaks: where points are dense.

#include <integrands/importance.h>
#include <integrands/variable_bounds.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace carlo {

/// A mixture: half of the points are uniform, as map_to_bounds maps them, and the other half is shared by the peaks.
/// Each variable of a peak has a Cauchy density between its bounds, pdf ~ 1 / (1 + ((x - centre) / width)^2). Its
/// tails also reach a feature that is ten times wider or narrower than stated. The other variables of a peak are
/// uniform. One more uniform number than variables chooses the part of the mixture.
///   weights : f / density <= 2 f, wherever the peaks are.
class PeakMixture {
 public:
  /// peaks  : "x=0.3,y=0.6 width 0.01"; "... width 0.01,0.002" has one width for each variable. Numbers may be constant
  ///          expressions, see parse_function.
  /// throws : Error that names --peak for anything else; for a variable without bounds, a centre beyond them, a width
  ///          that doubles do not resolve there, or peaks so narrow in so many variables that their density overflows.
  PeakMixture(const std::vector<std::string>& peaks, std::vector<VariableBounds> bounds);

  /// The density over the unit cube.
  ImportanceDensity density() const;

 private:
  struct Axis {
    std::size_t variable;
    double centre, width, lo, hi; ///< lo, hi: angles of the bounds, atan((bound - centre) / width)
    double sample(double u) const;
    double pdf(double x) const;
  };
  using Peak = std::vector<Axis>;

  Peak parse(const std::string& text) const;
  Axis axis(const std::string& name, double centre, double width) const;
  void draw(std::span<const double> u, std::span<double> v, double& density) const;

  std::vector<VariableBounds> bounds_;
  std::vector<Peak> peaks_;
};

} // namespace carlo

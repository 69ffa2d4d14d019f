#pragma once
/// What a checker found.

#include <mc/check/subject/axis.h>

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mc {

/// `inconclusive`: the test itself could not be trusted (say, its quadrature did not converge). Never counted as a
/// pass.
enum class Verdict { pass, fail, inconclusive };

std::string_view name(Verdict v);

/// What a failed check points to. `shape`: the samples follow another density than the one claimed; `rotation`: the
/// claimed one, turned about the pole.
enum class Fault {
  none,
  edge,
  zero_edge,
  impure,
  not_finite,
  negative,
  outside,
  failure,
  leak,
  mass,
  weight,
  support,
  inverse,
  jacobian,
  precision,
  atom,
  rotation,
  shape,
  local,
  physics,
  bias
};

std::string_view name(Fault f);

/// One law or test applied to one subject.
struct Check {
  std::string name; ///< e.g. "chi-square, 16 to 63 cells", "invert", "mass"
  Verdict verdict = Verdict::pass;
  std::optional<double> p;   ///< p-value of a statistical test; none for a deterministic law
  double share = 0;          ///< share of the family-wise alpha that a statistical test spends; the shares add up to 1
  double statistic = 0;      ///< the test statistic, or the largest error of a deterministic law
  double limit = 0;          ///< what `statistic` (deterministic) may reach
  Fault fault = Fault::none; ///< what it would point to if it failed
  std::string detail;        ///< where and by how much, one line; empty when there is nothing to say
};

/// A cell of the partition, or a discrete outcome, whose count is far from what the density claims.
struct WorstCell {
  std::array<double, 3> lo{}, hi{}; ///< chart coordinates; all 0 for an outcome
  double observed = 0, expected = 0, z = 0;
  std::string where; ///< its centre as a point of the domain; "outcome 3"
};

/// Samples counted in a cell, and how many the density claims.
struct CellCount {
  std::array<double, 3> lo{}, hi{}; ///< chart coordinates
  double observed = 0, expected = 0;
};

/// What the maps and curves of a page are drawn from. Some 300 kB where the samples are many.
struct Evidence {
  std::vector<CellCount> cells; ///< a complete kd-tree's, in its order: the two halves of each aligned run share a face
  std::vector<CellCount> outcomes; ///< discrete ones; lo and hi are 0
  struct After {
    std::uint64_t samples;
    double p;
  };
  std::vector<After> p_after; ///< Report::p() had the run stopped there: after 1024, 2048, 4096, ... and all samples
};

/// "theta in [1.5, 3] deg": a range of a chart coordinate as one of the domain.
std::string describe_range(const std::vector<Axis>& axes, std::size_t axis, double lo, double hi);

/// "theta 1.5 to 3 deg, phi 0 to 90 deg".
std::string describe_cell(const std::vector<Axis>& axes, const std::array<double, 3>& lo,
                          const std::array<double, 3>& hi);

/// A measured quantity that is reported and not judged by itself, say the white furnace value.
struct Figure {
  std::string name;
  double value = 0, std_error = 0;
  std::string where; ///< may be empty
};

/// All checks of one subject. Statistical checks share one family-wise alpha, see multiple_testing.h.
struct Report {
  std::string subject;
  double alpha = 0.01;
  std::uint64_t samples = 0;
  double mass = 1, mass_error = 0; ///< integral of the claimed density, atoms included, and its error bound
  /// Relative error of the density that is caught with probability .99: of random sign over patches of any place that
  /// each hold the share of four of the checker's cells or more, a thousandth of 1e6 samples, and are at most ten times
  /// as long as wide. Of longer ones larger errors are missed.
  double detectable = 0;
  double detectable_cell = 0; ///< the same in a single compact region of that share or more
  double seconds = 0;
  double ns_per_sample = 0;
  std::vector<Check> checks;
  std::vector<Axis> axes;           ///< what the chart coordinates of cells stand for; empty for discrete outcomes
  std::vector<WorstCell> worst;     ///< the five worst, worst first
  std::optional<Evidence> evidence; ///< only where the options asked for it
  std::vector<Figure> figures;

  Verdict verdict() const; ///< fail if any failed, else inconclusive if any is, else pass
  bool passed() const { return verdict() == Verdict::pass; }
  double p() const; ///< family-wise adjusted p-value (weighted Sidak over the statistical checks); 1 without any
  /// The likely fault: that of the first failed check, deterministic ones first, measure zero last; ends and branches
  /// of u, and physics, after counts that are beyond doubt wrong.
  Fault fault() const;
  /// Several lines: the verdict, then each check that did not pass with its detail, then the worst cells.
  std::string to_string() const;
};
std::ostream& operator<<(std::ostream& out, const Report& r);

} // namespace mc

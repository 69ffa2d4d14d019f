#pragma once
/// Results of a check: verdict, findings and reported values.

#include <mc/check/subject/axis.h>

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mc {

/// `inconclusive`: the test itself is not reliable, for example because its quadrature did not converge. Never counted
/// as a pass.
enum class Verdict { pass, fail, inconclusive };

std::string_view name(Verdict v);

/// The likely cause of a failed check.
///   shape    : the samples follow a density other than the claimed one
///   rotation : the samples follow the claimed density rotated about its pole
enum class Fault {
  none,
  boundary,
  measure_zero,
  nondeterministic,
  not_finite,
  negative,
  outside,
  failure,
  zero_pdf,
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

/// "weight: the stated weight differs from f / pdf": one word, and an explanation after a colon.
std::string_view name(Fault f);

/// One law or test applied to one subject.
struct Check {
  std::string name; ///< e.g. "chi-square, 16 to 63 cells", "invert", "mass"
  Verdict verdict = Verdict::pass;
  std::optional<double> p;   ///< p-value of a statistical test; none for a deterministic law
  double share = 0;          ///< share of the family-wise alpha that a statistical test spends; the shares add up to 1
  double statistic = 0;      ///< the test statistic, or the largest error of a deterministic law
  double limit = 0;          ///< largest error that a deterministic law allows
  Fault fault = Fault::none; ///< the likely cause if the check fails
  /// One line; empty for a pass. First the finding: observed value, expected value and place. Then remarks, each after
  /// "; ".
  std::string detail;
};

/// A cell of the partition, or a discrete outcome, with a count far from the expected one.
struct WorstCell {
  std::array<double, 3> lo{}, hi{}; ///< chart coordinates; all 0 for an outcome
  double observed = 0, expected = 0, z = 0;
  std::string where; ///< its centre as a point of the domain; "outcome 3"
};

/// Observed and expected number of samples in a cell.
struct CellCount {
  std::array<double, 3> lo{}, hi{}; ///< chart coordinates
  double observed = 0, expected = 0;
};

/// Data for maps and curves of a page; about 300 kB for many samples.
struct PlotData {
  std::vector<CellCount> cells; ///< a complete kd-tree's, in its order: the two halves of each aligned run share a face
  std::vector<CellCount> outcomes; ///< discrete ones; lo and hi are 0
  struct PValueAfter {
    std::uint64_t samples;
    double p;
  };
  std::vector<PValueAfter> p_after; ///< Report::p() after 1024, 2048, 4096, ... and after all samples
};

/// "theta in [1.5, 3] deg": a range of a chart coordinate in the coordinates of the domain.
std::string describe_range(const std::vector<Axis>& axes, std::size_t axis, double lo, double hi);

/// "theta 1.5 to 3 deg, phi 0 to 90 deg".
std::string describe_cell(const std::vector<Axis>& axes, const std::array<double, 3>& lo,
                          const std::array<double, 3>& hi);

/// A measured quantity that is reported without a verdict of its own, for example the white furnace albedo.
struct ReportedValue {
  std::string name;
  double value = 0, std_error = 0;
  std::string where; ///< may be empty
};

/// How much text Report::to_string returns.
///   brief : the finding, its likely cause, the check that found it, and the number of other checks that fail
///   full  : every check that does not pass, the worst cells and the reported values
enum class ReportText : std::uint8_t { brief, full };

/// All checks of one subject. Statistical checks share one family-wise alpha, see multiple_testing.h.
struct Report {
  std::string subject;
  double alpha = 0.01;
  std::uint64_t samples = 0;
  double mass = 1, mass_error = 0; ///< integral of the claimed density, atoms included, and its error bound
  /// Smallest relative error of the density that is detected with probability .99. The error has this size everywhere
  /// and a random sign in each patch. A patch contains the probability of four cells or more, which is a thousandth for
  /// 1e6 samples, and is at most ten times as long as wide. In longer patches only larger errors are detected.
  double detectable = 0;
  double detectable_cell = 0; ///< the same for an error in a single patch, with the correct density elsewhere
  double seconds = 0;
  double ns_per_sample = 0;
  std::vector<Check> checks;
  std::vector<Axis> axes;           ///< coordinates of the domain for each chart axis; empty for discrete outcomes
  std::vector<WorstCell> worst;     ///< the five worst, worst first
  std::optional<PlotData> evidence; ///< only if the options request it
  std::vector<ReportedValue> figures;

  Verdict verdict() const; ///< fail if any failed, else inconclusive if any is, else pass
  bool passed() const { return verdict() == Verdict::pass; }
  double p() const; ///< family-wise adjusted p-value (weighted Sidak over the statistical checks); 1 without any
  /// The check that explains the verdict; null for a pass. The first failed deterministic law, except measure zero; else
  /// the first failed statistical test; else measure zero; else the first inconclusive check. A statistical test with
  /// p < 1e-9 comes before the laws of boundaries of u and of physics, which a wrong density breaks, too.
  const Check* leading() const;
  Fault fault() const; ///< the likely cause of a failure: that of the leading check; none unless the verdict is fail
  /// Whether the verdict rests on p: a pass, or a failed statistical test. A broken law is certain, whatever p is.
  bool is_statistical() const;
  /// The observed value, the expected value and the place of the leading check; empty for a pass.
  std::string finding() const;
  /// One line:
  ///   "pass, p = 0.42 (1000000 samples, alpha 0.001); an error of the density of 3.8 % is detected (61 % in a single
  ///   patch)"
  ///   "fail: weight is 0.6, should be 0.5, at u = ..."
  ///   "fail, p = 1e-12 (20000 samples, alpha 0.001): region ... contains 120 samples, 64.0 expected"
  std::string verdict_text() const;
  /// The subject and verdict_text(); then, unless it passed, one indented line each for the likely cause, the check and
  /// the rest.
  ///   hint : how a user gets the full text, "; --verbose shows them"; printed with the number of other failures
  std::string to_string(ReportText text = ReportText::brief, std::string_view hint = {}) const;
};
std::ostream& operator<<(std::ostream& out, const Report& r);

} // namespace mc

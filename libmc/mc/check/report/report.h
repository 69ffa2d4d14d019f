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

/// Result of a check. `inconclusive`: the test itself is not reliable, for example because its quadrature did not
/// converge. It never counts as a pass. `warning`: a finding that is no wrong density, such as a pdf of 0 at single
/// points, or coarse rounding. A report with warnings alone is a pass.
enum class Verdict { pass, fail, inconclusive, warning };

/// "pass", "fail", "inconclusive" or "warning".
std::string_view name(Verdict v);

/// The likely cause of a failed check.
enum class Fault {
  none,             ///< no fault
  boundary,         ///< sample or pdf is wrong at the ends of [0,1) or next to a branch
  measure_zero,     ///< only single values of u or single points are wrong
  nondeterministic, ///< equal arguments give different results
  not_finite,       ///< a sample, pdf or f is infinite or NaN
  negative,         ///< the density is below zero
  outside,          ///< samples lie outside the domain
  failure,          ///< the rate of failures contradicts the mass of the density
  zero_pdf,         ///< samples lie where the density is zero
  mass,             ///< the density does not integrate to one
  weight,           ///< a stated weight, pdf or f differs from eval and pdf
  support,          ///< the integrand is positive where the density is zero
  inverse,          ///< invert does not undo sample
  jacobian,         ///< pdf is not the density of sample
  precision,        ///< the rounding error exceeds the stated bound
  atom,             ///< many samples share one value of a coordinate
  rotation,         ///< the samples follow the claimed density rotated about its pole
  shape,            ///< the samples follow a density other than the claimed one
  local,            ///< single cells contain too many or too few samples
  physics,          ///< f violates reciprocity, energy conservation or its sign
  rounding,         ///< the samples have too few distinct values for the density
  dependent,        ///< the samples depend on each other
  bias              ///< the mean of the estimates differs from the true value
};

/// One word and an explanation after a colon, for example "weight: a stated weight differs from f / pdf".
std::string_view name(Fault f);

/// One law or test applied to one subject.
struct Check {
  std::string name;                ///< for example "chi-square, 16 to 63 cells", "invert" or "mass"
  Verdict verdict = Verdict::pass; ///< result of the law or test
  std::optional<double> p;         ///< p-value of a statistical test; none for a deterministic law
  double share = 0;          ///< share of the family-wise alpha that a statistical test spends; the shares add up to 1
  double statistic = 0;      ///< the test statistic, or the largest error of a deterministic law
  double limit = 0;          ///< largest error that a deterministic law allows
  Fault fault = Fault::none; ///< the likely cause if the check fails
  /// One line; empty for a pass. The finding comes first: observed value, expected value and place. Remarks follow,
  /// each after "; ".
  std::string detail;
  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(name, verdict, p, share, statistic, limit, fault, detail); }
};

/// A cell of the partition, or a discrete outcome, with a count far from the expected count.
struct WorstCell {
  PerAxis<double> lo{}, ///< lower corner in chart coordinates; 0 for an outcome
      hi{};             ///< upper corner in chart coordinates; 0 for an outcome
  double observed = 0,  ///< observed number of samples
      expected = 0,     ///< expected number of samples
      z = 0;            ///< (observed - expected) / sqrt(expected)
  std::string where;    ///< the centre of the cell as a point of the domain, or "outcome 3"
  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(lo, hi, observed, expected, z, where); }
};

/// Observed and expected number of samples in a cell.
struct CellCount {
  PerAxis<double> lo{}, ///< lower corner in chart coordinates
      hi{};             ///< upper corner in chart coordinates
  double observed = 0,  ///< observed number of samples
      expected = 0;     ///< expected number of samples
  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(lo, hi, observed, expected); }
};

/// Data for the maps and curves of a page.
struct PlotData {
  /// Leaves of a complete kd-tree in order: the two halves of each aligned run share a face.
  std::vector<CellCount> cells;
  std::vector<CellCount> outcomes; ///< discrete outcomes; lo and hi are 0
  /// Report::p() after a number of samples.
  struct PValueAfter {
    std::uint64_t samples; ///< number of samples
    double p;              ///< family-wise adjusted p-value
    /// The fields, see mc/run/archive.h.
    template <class Archive> void archive(Archive& a) { a(samples, p); }
  };
  std::vector<PValueAfter> p_after; ///< after 1024, 2048, 4096, ... and after all samples
  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(cells, outcomes, p_after); }
};

/// Returns a range of a chart coordinate in coordinates of the domain, for example "theta in [1.5, 3] deg".
std::string describe_range(const std::vector<Axis>& axes, std::size_t axis, double lo, double hi);

/// Returns a cell in coordinates of the domain, for example "theta 1.5 to 3 deg, phi 0 to 90 deg".
std::string describe_cell(const std::vector<Axis>& axes, const PerAxis<double>& lo, const PerAxis<double>& hi);

/// A measured quantity that is reported without a verdict of its own, for example the white furnace albedo.
struct ReportedValue {
  std::string name;  ///< name of the quantity
  double value = 0,  ///< the estimate
      std_error = 0; ///< its standard error
  std::string where; ///< place or direction; may be empty
  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(name, value, std_error, where); }
};

/// Results of one law or of one statistical test.
struct Findings {
  std::vector<Check> checks = {};          ///< one for each claim
  std::vector<ReportedValue> figures = {}; ///< quantities without a verdict
  double detectable = 0,                   ///< as in Report; 0 if the test states no such error
      detectable_cell = 0;                 ///< as in Report; 0 if the test states no such error
};

/// A law that was not tried, because the subject lacks what it needs.
struct UntriedLaw {
  std::string name;   ///< name of the law
  std::string reason; ///< what is missing, for example "no invert"
  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(name, reason); }
};

/// Amount of text that Report::to_string returns.
///   brief : the finding, its likely cause, the check that found it, and the number of other checks that fail.
///   full  : every check that does not pass, the worst cells, the reported values and the laws that were not tried.
enum class ReportText : std::uint8_t { brief, full };

/// All checks of one subject. Statistical checks share one family-wise alpha; see multiple_testing.h.
struct Report {
  std::string subject;       ///< name of the subject
  double alpha = 0.01;       ///< family-wise level of the statistical checks
  std::uint64_t samples = 0; ///< number of counted samples
  double mass = 1,           ///< integral of the claimed density and the atoms
      mass_error = 0;        ///< error bound of mass
  /// Smallest relative error of the density that is detected with probability .99. The error has this size everywhere
  /// and a random sign in each patch. A patch has at least the probability of four cells (a thousandth for 1e6 samples)
  /// and is at most ten times as long as wide. For longer patches the smallest detected error is larger.
  double detectable = 0;
  double detectable_cell = 0;         ///< the same for an error in a single patch, with the correct density elsewhere
  double seconds = 0;                 ///< duration of the check [s]
  double ns_per_sample = 0;           ///< time of one sample [ns]; 0 if not measured
  std::vector<Check> checks;          ///< all laws and tests, in the order of their execution
  std::vector<Axis> axes;             ///< coordinates of the domain for each chart axis; empty for discrete outcomes
  std::vector<WorstCell> worst;       ///< the five worst cells or outcomes, worst first
  std::optional<PlotData> evidence;   ///< present only if the options request it
  std::vector<ReportedValue> figures; ///< quantities without a verdict
  std::vector<UntriedLaw> untried;    ///< laws that were not tried

  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) {
    a(subject, alpha, samples, mass, mass_error, detectable, detectable_cell, seconds, ns_per_sample, checks, axes,
      worst, evidence, figures, untried);
  }

  const Check* warning() const; ///< the first warning; null if there is none
  Verdict verdict() const;      ///< fail if any check fails, else inconclusive if any is inconclusive, else pass
  bool passed() const { return verdict() == Verdict::pass; } ///< whether the verdict is pass
  /// Returns the family-wise adjusted p-value, weighted Sidak over the statistical checks; 1 without such checks.
  double p() const;
  /// Returns the check that explains the verdict; null for a pass. In order: the first failed deterministic law, except
  /// measure zero; the first failed statistical test; a measure zero failure; the first inconclusive check. A
  /// statistical test with p < 1e-9 precedes the laws of boundaries of u and of physics, because a wrong density breaks
  /// these laws too.
  const Check* leading() const;
  Fault fault() const; ///< the fault of the leading check; none unless the verdict is fail
  /// Returns whether the verdict rests on p: a pass, or a failed statistical test. A broken law is certain for any p.
  bool is_statistical() const;
  /// Returns the observed value, the expected value and the place of the leading check; empty for a pass.
  std::string finding() const;
  /// Returns "not tried: invert(sample(u)) = u (no invert), ..."; empty if all laws were tried.
  std::string untried_text() const;
  /// Returns one line:
  ///   "pass, p = 0.42 (1000000 samples, alpha 0.001); an error of the density of 3.8 % is detected (61 % in a
  ///   single patch)"
  ///   "fail: weight is 0.6, should be 0.5, at u = ..."
  ///   "fail, p = 1e-12 (20000 samples, alpha 0.001): region ... contains 120 samples, 64.0 expected"
  std::string verdict_text() const;
  /// Returns the subject and verdict_text(). If the verdict is not pass, one indented line each follows for the likely
  /// cause, the check and the other checks.
  ///   hint : how a user gets the full text, "; --verbose shows them"; printed after the number of other
  ///          failures.
  std::string to_string(ReportText text = ReportText::brief, std::string_view hint = {}) const;
};
/// Writes r.to_string().
std::ostream& operator<<(std::ostream& out, const Report& r);

} // namespace mc

#pragma once
/// Error against samples and seconds, for one integral and several ways to sample it.

#include <converge/integral_target.h>
#include <sampling/theory.h>

#include <mc/stats/power_law.h>

#include <optional>
#include <string>
#include <vector>

namespace carlo {

struct MeasureOptions {
  std::uint64_t max_n = 1 << 18;
  int replicates = 0;    ///< behind each RMS error; 0: as many as make it known to 10 %, 64 to 512
  double error_goal = 0; ///< no larger N where the RMS error is this small; 0: until max_n
  double cpu_goal = 0;   ///< nor where one estimate takes so many CPU seconds
  double seconds = 0;    ///< wall-clock, shared by the ways; 0: until max_n
  std::uint64_t seed = 1;
  int threads = 0;
  const std::atomic<bool>* cancel = nullptr;
  /// Called after each N with the share of the work that is done, and where it is.
  std::function<void(double done, const std::string& where)> progress = {};
};

/// How the error of one way falls.
struct ConvergenceCurve {
  const SamplingMethod* method = nullptr;
  std::vector<mc::RmsError> errors;      ///< N is the evaluations really made
  std::vector<Replicates> replicates;    ///< behind each
  bool exact = false;                    ///< no error beyond rounding, so no slope
  bool interrupted = false;              ///< an interrupt came before its largest N
  bool out_of_time = false;              ///< its share of MeasureOptions::seconds ended before
  std::optional<mc::PowerLaw> power_law; ///< of N in the asymptotic range, where there are three or more
  std::optional<ConvergenceRate> theory;
  double fit_center = 0; ///< geometric mean of the N of the law

  /// Whether there is an error to draw: above 0, and not a bound.
  bool has_measurable_error() const;
  /// Whether the interval of the slope allows what theory says about these N.
  bool agrees_with_theory() const;
};

/// What an estimate costs, in words.
struct CostUnit {
  std::string_view column, axis;    ///< of tables, of plots
  std::string_view unit, qualifier; ///< behind a figure
};
inline constexpr CostUnit cpu_cost{"cpu_seconds", "CPU seconds", " s", " of CPU"};
inline constexpr CostUnit ray_cost{"million_rays", "millions of rays", " Mray", ""};

struct Measurement {
  std::vector<ConvergenceCurve> curves; ///< of the ways that were begun; when interrupted the last may be cut
  double truth = 0;                     ///< what errors are measured from
  double truth_error = 0;               ///< standard error of a reference; 0: the truth is known
  double magnitude = 0;                 ///< mean of |f|, or |truth| where that is more: what rounding is relative to
  std::string truth_warning;            ///< one line that says why the truth must or may be wrong; empty: no doubt
  bool interrupted = false;             ///< what was measured until then is kept, for each N that was finished
  std::optional<double> heavy_tail; ///< index of the tail, where the variance looks infinite by mc::TailIndexEstimator
  CostUnit cost = cpu_cost;         ///< what its seconds are
  std::string plain_mc = "random";  ///< the name of the way that is plain Monte Carlo
};

/// Every way on N = 16, 32, ... max_n, from the fewest that the way works with.
///   truth  : where the integral has none, the mean of 128 more replicates of the way with the smallest error at its
///            largest N: its standard error is under a tenth of the smallest error shown, and widens every interval;
///            when interrupted, the mean of those it has; an error that is not told from its own is a bound, and in no
///            slope
///   doubt  : unbiased ways whose means agree with each other and not with the stated truth, by six standard errors;
///            where none is stated, a quarter of all sets of replicates, at the larger N, in which one replicate holds
///            over half of the variance
///   throws : Error for an integrand that is not finite somewhere, or of unknown truth and 0 at every point, and
///            where refuse_underflow does
Measurement measure_convergence(const IntegralTarget& target, const std::vector<SamplingMethod>& methods,
                                const MeasureOptions& options);

} // namespace carlo

#pragma once
/// Measures the error of several methods against evaluations and seconds, for one integral.

#include <converge/replicate_log.h>
#include <sampling/theory.h>

#include <mc/stats/power_law.h>

#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// Who computes which piece of a measurement where several parts share it.
struct PartExecutors {
  mc::Executor repeated;                                  ///< cheap pieces, which every part computes
  std::function<mc::Executor(std::uint64_t piece)> alone; ///< pieces that one part computes alone
  mc::Executor shared;                                    ///< pieces of which each part computes a share
};

struct MeasureOptions {
  std::uint64_t max_n = 1 << 18;
  int replicates = 0;    ///< replicates behind each RMS error; 0: 64 to 512, enough for a relative error of 10 %
  double error_goal = 0; ///< a curve ends where its RMS error is below this; 0: at max_n
  double cpu_goal = 0;   ///< a curve ends where one estimate takes more CPU seconds; 0: at max_n
  double seconds = 0;    ///< wall-clock, shared by the methods; 0: until max_n
  std::uint64_t seed = 1;
  int threads = 0;
  const std::atomic<bool>* cancel = nullptr;
  ReplicateLog* log = nullptr;          ///< replicates and clock of the run; null: a log of this measurement
  const PartExecutors* parts = nullptr; ///< null: the executor of the log computes everything
  std::uint64_t first_piece = 0;        ///< number of the first curve among those of all measurements
  /// Called after each N with the finished share of the work and the current method and N.
  std::function<void(double done, const std::string& where)> progress = {};
};

/// The error of one method as a function of N.
struct ConvergenceCurve {
  const SamplingMethod* method = nullptr;
  std::vector<mc::RmsError> errors;      ///< N is the number of evaluations actually made
  std::vector<Replicates> replicates;    ///< the replicates behind each error
  bool exact = false;                    ///< the error is rounding only, so there is no slope
  bool interrupted = false;              ///< the run was interrupted before the largest N
  bool out_of_time = false;              ///< the time share of this curve ended before the largest N
  std::optional<mc::PowerLaw> power_law; ///< the fit in the asymptotic range, if it has three or more errors
  std::optional<ConvergenceRate> theory;
  double fit_center = 0; ///< geometric mean of the fitted N

  /// Whether at least one error can be drawn: it exceeds 0 and is not a bound.
  bool has_measurable_error() const;
  /// Whether the interval of the slope is consistent with the theoretical rate at the fitted N.
  bool agrees_with_theory() const;
};

/// The name of the unit in which costs are reported.
struct CostUnit {
  std::string_view column, axis;    ///< names of the table column and of the plot axis
  std::string_view unit, qualifier; ///< text behind a number
};
inline constexpr CostUnit cpu_cost{"cpu_seconds", "CPU seconds", " s", " of CPU"};
inline constexpr CostUnit ray_cost{"million_rays", "millions of rays", " Mray", ""};

/// A method without a curve, and the reason.
struct FailedMethod {
  const SamplingMethod* method;
  std::string reason; ///< one line
};

struct Measurement {
  std::vector<ConvergenceCurve> curves;    ///< one for each method started; after an interrupt the last curve may be
                                           ///< incomplete
  std::vector<FailedMethod> failures = {}; ///< methods that met an error, such as a point with an infinite value
  double truth = 0;                        ///< the value that errors are measured from
  double truth_error = 0;                  ///< standard error of an estimated truth; 0: the truth is exact
  double magnitude = 0;                    ///< mean of |f|, or |truth| if that is larger; rounding is relative to it
  std::string truth_warning;        ///< one line with the reason why the truth is or may be wrong; empty: no doubt
  bool interrupted = false;         ///< only the N finished before the interrupt are included
  std::optional<double> heavy_tail; ///< tail index, if it is below 2: an infinite variance
  CostUnit cost = cpu_cost;         ///< the unit of `seconds`
  std::string plain_mc = "random";  ///< name of the method that is plain Monte Carlo
};

/// Memory that the replicates of one integral need [bytes], at the largest N of every method.
double replicates_memory(const std::vector<SamplingMethod>& methods, const MeasureOptions& options);

/// Runs every method with N = 16, 32, ... max_n evaluations, starting at the method's smallest possible N.
///   truth  : if the integral states none, the mean of 128 additional replicates of the method with the smallest error
///            at its largest N. The standard error of this mean is under a tenth of the smallest reported error, and
///            widens every interval. After an interrupt the mean is over the existing replicates. An error that is not
///            significantly larger than the error of the truth is reported as a bound and enters no slope.
///   doubt  : a stated truth is doubted if the means of the unbiased methods agree with each other but differ from it
///            by six standard errors. An estimated truth is doubted if one replicate causes over half of the variance
///            in a quarter of all sets of replicates at the larger N.
///   failed : a method that meets an error has no curve, but an entry in `failures`.
///   throws : Error for an integrand that is not finite at one of the first independent points, if every method fails,
///            for one of unknown truth that is 0 at every point, and where refuse_underflow throws.
Measurement measure_convergence(const IntegralTarget& target, const std::vector<SamplingMethod>& methods,
                                const MeasureOptions& options);

} // namespace carlo

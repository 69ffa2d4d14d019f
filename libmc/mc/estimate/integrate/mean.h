#pragma once
/// Means with estimated errors, and their comparison.

#include <mc/estimate/diagnostics/integrand_diagnostics.h>
#include <mc/estimate/integrate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace mc::detail {

/// A mean with a standard error estimated from `dof` degrees of freedom.
struct Mean {
  double value = 0, error = 0, dof = 0, skew = 0; ///< `skew` is the third cumulant of the mean / error^3 / 6.
  ErrorBar error_bar = ErrorBar::known;           ///< Error bar by the sampled values.
  /// Possible contribution of values larger than all samples, with sign; infinite if large.
  double unsampled_tail_bound = 0;
  /// Whether all underlying values were equal. The error is then only a bound, and no run ends on it.
  bool zero_spread = false;

  /// Error bar that includes the unsampled tail.
  ErrorBar reported_error_bar() const {
    return error_bar == ErrorBar::known && std::isinf(unsampled_tail_bound) ? ErrorBar::undersampled : error_bar;
  }
};
using Means = std::vector<Mean>; ///< One mean per output.

/// Least error of a mean, the spacing of doubles.
double ulp(double mean);

/// Estimate with the error of the mean, infinite unless the error bar is known. Includes unsampled_tail_bound in the
/// error if it exceeds a 16th of the mean.
Estimate estimate(const Mean& m, std::uint64_t calls);

/// Two-sided confidence interval by Student's t, longer on the side of the skewness [Johnson78] and of
/// unsampled_tail_bound. Never shorter than t on the other side, where the correction would only offset the error of
/// the skewness itself.
Estimate::Interval interval(const Mean& m, double confidence);

/// Degrees of freedom of the sum of both variances [Welch47].
double welch_dof(const Mean& a, const Mean& b);

/// Mean share b + (1 - share) a of independent means. Takes the error bar of b, which must be based on the values of
/// both.
Mean combine_independent(const Mean& a, const Mean& b, double share);

/// Difference of two independent means in standard normal deviations. Returns nullopt if both are exact or an error bar
/// is not known.
std::optional<double> z_score(const Mean& a, const Mean& b);

/// Error bar by the sampled values, which must not all be 0.
ErrorBar error_bar_of(const IntegrandDiagnostics& diagnostics);

/// Possible contribution to the mean of values larger than all samples, for points from a learned density, by
/// OctaveHistogram. Has the sign of the largest value; infinite if it exceeds half of the mean magnitude. It detects a
/// density that follows only a part of the integrand: the density is low elsewhere, and the few points there have large
/// values. Returns 0 if the replicates agree better than single values of the largest size would allow. Also returns 0
/// for a power law tail, which the error already includes.
double unsampled_tail_bound(const IntegrandDiagnostics& diagnostics, double error);

/// Skewness: third central moment over the cubed standard deviation. 0 if all numbers are equal.
double skewness(std::span<const double> numbers);

/// Skew (see Mean) of the mean of `count` independent numbers with this skewness.
double skew_of_mean(double skewness, double count);

/// History of an output at shorter lengths of the same replicates.
struct ReplicateHistory {
  /// Jump that separates the replicates into two clusters.
  struct Jump {
    double height = 0;     ///< 0 if there is no jump.
    bool narrow = false;   ///< Whether both clusters are narrow.
    bool balanced = false; ///< Whether both clusters have at least three replicates.
  };
  /// At the last length: number of points, and standard deviation of the replicates.
  double last_points = 0, last_deviation = 0;
  double last_nonzero_deviation = 0;          ///< Last standard deviation above rounding.
  std::vector<Jump> jumps = {};               ///< Jump at each length.
  std::vector<double> scaled_deviations = {}; ///< Standard deviation times number of points, at each length.
  double axis_jump = 0; ///< Smaller of the largest jumps across an axis, by AxisProfile, at the last two lengths.
  double last_axis_jump = std::numeric_limits<double>::infinity(); ///< The same jump at the last length only.

  /// Records the largest jump across an axis at a new length.
  void add_axis_jump(double jump) {
    axis_jump = std::min(jump, last_axis_jump);
    last_axis_jump = jump;
  }
};

/// Mean of independent replicates of `points` points each. The error comes from their spread and from three effects
/// that the spread does not show.
///   jumps : A jump of height h moves a replicate by h / points or not at all. Equal replicates only show that none was
///           moved. The error includes .75 h / points over the number of replicates, in quadrature. The factor gives
///           nominal coverage for 24 trials of a random probability, also for runs that stop at a tolerance. h is the
///           largest jump that separated replicates, at one of the last lengths or clearly at any length. Jumps that
///           disappeared suddenly and jumps across an axis at the first points also count. If all replicates are equal,
///           h is the range of all values, or their size if all values are equal. The rule of three then holds for
///           unsampled regions. Replicates that differed before and then agree keep their last error.
///   heavy tails : For a tail of index a > 2, the share R^-(1 - 2/a) of the variance lies beyond the largest of R
///                 values.
///   noisy variance : The variance is inaccurate for a tail with a < 8 or for replicates with skewness above 1. It is
///                    smallest if no large value was sampled, and such runs would stop too early. The error is
///                    therefore at least the error of the last length, reduced as for such a tail.
///   error_bar : all_zero if all values are 0, otherwise by error_bar_of().
///   diagnostics : All values behind the mean, and the tail of the integrand.
Mean mean_of_replicates(std::span<const double> means, double points, const IntegrandDiagnostics& diagnostics,
                        ReplicateHistory& history);

} // namespace mc::detail

#pragma once
/// Means whose error was estimated, and what two of them say of each other.

#include <mc/estimate/diagnostics/integrand_diagnostics.h>
#include <mc/estimate/integrate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace mc::detail {

/// A mean whose standard error was estimated with `dof` degrees of freedom. `skew` is the third cumulant of the mean
/// over error^3, divided by 6. `unsampled_tail_bound` is what values larger than all that were met may add to it, with their sign;
/// infinite where that is much. `zero_spread` says that what it is the mean of never differed: its error only bounds what
/// could not be seen, and no run ends on it.
struct Mean {
  double value = 0, error = 0, dof = 0, skew = 0;
  ErrorBar error_bar = ErrorBar::known; ///< of what was met
  double unsampled_tail_bound = 0;
  bool zero_spread = false;

  /// What is said of the error bar.
  ErrorBar reported_error_bar() const {
    return error_bar == ErrorBar::known && std::isinf(unsampled_tail_bound) ? ErrorBar::undersampled : error_bar;
  }
};
using Means = std::vector<Mean>; ///< one per output

/// The least error that a mean may have: doubles are no closer to each other.
double ulp(double mean);

/// The mean with its error, which is infinite unless the bar is known. What was not met is a part of it where that may
/// be more than a 16th of the mean: less is an error that few runs have.
Estimate estimate(const Mean& m, std::uint64_t calls);

/// The two-sided interval: Student's t, longer on the side of the skewness [Johnson78], and of what was not met. Never
/// shorter than t on the other side: there the correction would only make up for what the skewness is itself off by.
Estimate::Interval interval(const Mean& m, double confidence);

/// Degrees of freedom behind the sum of the variances [Welch47].
double welch_dof(const Mean& a, const Mean& b);

/// share b + (1 - share) a, for independent means; the bar is that of b, which was judged by the values of both.
Mean combine_independent(const Mean& a, const Mean& b, double share);

/// By how many standard deviations of a normal two independent means differ; nothing where both are exact or a bar is
/// unknown.
std::optional<double> z_score(const Mean& a, const Mean& b);

/// What values say of the error bar, if they are not all 0.
ErrorBar error_bar_of(const IntegrandDiagnostics& diagnostics);

/// What values larger than all that were met may add to a mean whose points were drawn from a learned density, see
/// OctaveHistogram, with the sign of the largest; infinity where that is more than half of it. So a density shows itself
/// that follows a part of the integrand only: beside that part it is low, and few points there have values the larger
/// the farther out they are. 0 where replicates agree better than single values of the largest size would let them, and
/// where the integrand has the tail of a power law, whose errors allow for it.
double unsampled_tail_bound(const IntegrandDiagnostics& diagnostics, double error);

/// The third central moment of numbers over the third power of their standard deviation; 0 where they are equal.
double skewness(std::span<const double> numbers);

/// The skew of the mean of so many independent numbers of that skewness.
double skew_of_mean(double skewness, double count);

/// What an integrand showed of itself at shorter lengths of the same replicates.
struct ReplicateHistory {
  struct Jump {
    double height = 0;     ///< 0: none seen
    bool narrow = false;   ///< the two clusters of replicates that it sets apart are
    bool balanced = false; ///< both are of three or more
  };
  double last_points = 0, last_deviation = 0; ///< of the last length, and of the replicates at it
  double last_nonzero_deviation = 0;          ///< the last deviation that was more than rounding
  std::vector<Jump> jumps = {};               ///< at each length, that set replicates apart
  std::vector<double> scaled_deviations = {}; ///< at each length, their deviation times the points
  double axis_jump = 0; ///< the largest jump across an axis that the AxisProfile showed at both of its last two lengths
  double last_axis_jump = std::numeric_limits<double>::infinity(); ///< at the last

  void add_axis_jump(double jump) {
    axis_jump = std::min(jump, last_axis_jump);
    last_axis_jump = jump;
  }
};

/// The mean of independent replicates of `points` points each.
///   error : from their spread, and what it does not show:
///           - a jump of height h moves a replicate by h / points or not at all, and replicates that agree say only
///             that they could not differ: .75 h / points over their number is added in squares, about what makes 24
///             trials of a random probability cover 94 to 97 %, where they stop at a tolerance too; h is what set them
///             apart at one of the last lengths, or beyond doubt at any, or what they came to agree on all at once, or
///             the first points showed across an axis; where they are equal, the range of all values; where those are
///             equal too, their size, so that the rule of three holds for what was not seen. Replicates that differed
///             before and came to agree are as good as when they last differed
///           - of a tail of index a > 2 the share R^-(1 - 2/a) of the variance lies beyond the largest of R values
///           - of a tail with a < 8 the variance is known badly, as is that of replicates whose skewness is above 1. It
///             seems least where nothing large was met, and that is where runs stop: so it is no less than what the
///             last length showed, scaled as the variance of such a tail falls
///   error_bar : all_zero where every value was zero, else as error_bar_of says
///   diagnostics : the values behind it, and the tail of the integrand
Mean mean_of_replicates(std::span<const double> means, double points, const IntegrandDiagnostics& diagnostics,
                        ReplicateHistory& history);

} // namespace mc::detail

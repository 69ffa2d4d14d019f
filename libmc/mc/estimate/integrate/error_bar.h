#pragma once
/// The error bar of a mean of replicates: Student's t with three corrections.

#include <mc/estimate/diagnostics/sampled_values.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/integrate/corrections/tuning.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace mc::detail {

/// A mean with everything that its interval needs.
struct Mean {
  double value = 0;                    ///< The mean.
  double error = 0;                    ///< Its standard error.
  double dof = 0;                      ///< Degrees of freedom of the standard error.
  double skew = 0;                     ///< Third cumulant of the mean over error^3, divided by 6.
  std::array<double, 2> tail = {0, 0}; ///< Contribution of unsampled values below and above, see tail_contribution().
  ErrorBar bar = ErrorBar::known;      ///< Reliability of the error.
  bool constant = false;               ///< All values were equal.
  double tail_index = 0;               ///< 1 / shape of the heavier tail; infinite if it is not heavy.
};
using Means = std::vector<Mean>; ///< One mean for each output.

/// Whether all values are equal to within a few roundings.
bool is_constant(const Extremes& extremes);

/// What earlier lengths of the same replicates showed of one output.
struct SpreadHistory {
  std::vector<double> points;                       ///< Points of each replicate at each length.
  std::vector<double> spreads;                      ///< Standard deviation between the replicates.
  std::vector<std::array<double, 2>> shapes;        ///< Tail shapes of the smallest and of the largest values.
  std::array<std::vector<double>, 2> contributions; ///< Of unsampled values below and above, see tail_contribution().
};

/// Mean of independent replicates with `points` points each. Adds the present length to the history.
Mean mean_of_replicates(std::span<const double> means, double points, const SampledValues& values, int dim,
                        SpreadHistory& history, const Tuning& t = default_tuning);

/// The two-sided interval with this coverage. All numbers unless the error is known.
Estimate::Interval interval(const Mean& m, double confidence);
/// The estimate. Its standard error is the half width of the one-sigma interval; infinite unless it is known.
Estimate estimate(const Mean& m, std::uint64_t calls);

/// Half width of the one-sigma interval, whether the error is known or not.
double half_width(const Mean& m);

/// share b + (1 - share) a for independent means; the bar is that of b.
Mean combine_independent(const Mean& a, const Mean& b, double share);

/// The difference of two independent means as a normal deviate; none where an error is 0 or not known.
std::optional<double> normal_deviate(const Mean& a, const Mean& b);

/// Findings about the smallest values, and about the largest.
struct TailFindings {
  std::array<double, 2> contribution; ///< Expected contribution of unsampled values, see tail_contribution().
  /// Shape of the tail. The variance is infinite only if that of the integrand is, since a learned density is bounded
  /// from below: the lesser of both shapes.
  std::array<double, 2> shape;
};
/// Findings about the tails. `cap` is an upper bound of the largest excess over the number of values.
TailFindings tails_of(const SampledValues& values, double cap, const Tuning& t = default_tuning);

/// Shape of the heavier tail that most of the last lengths show; -infinity before there are enough of them.
double tail_shape(std::span<const std::array<double, 2>> shapes, const Tuning& t = default_tuning);

/// Finding about the error bar from the values, from the contribution of unsampled ones, and from the shapes of the
/// tails at the last lengths.
ErrorBar judge(const Extremes& extremes, const std::array<double, 2>& unsampled,
               std::span<const std::array<double, 2>> shapes, int dim, const Tuning& t = default_tuning);

} // namespace mc::detail

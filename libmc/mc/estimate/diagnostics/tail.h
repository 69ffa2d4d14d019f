#pragma once
/// The tail of values, and what its largest values say of its moments.

#include <mc/estimate/diagnostics/extremes.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace mc {

/// A generalised Pareto distribution of the excesses of the largest values over a threshold.
struct TailFit {
  /// Shape xi: moments of order 1 / xi and above are infinite. Not positive for a bounded or exponential tail.
  double shape = 0;
  double largest_excess = 0; ///< Largest value minus threshold.
  std::size_t values = 0;    ///< Number of values above the threshold.
};

/// Fits the tail of values in descending order: the last of them is the threshold. By probability-weighted moments
/// [HoskingWallis87]; shapes above 0 by a quasi-Bayesian estimate [ZhangStephens09]. The fit does not change if a
/// constant is added to all values.
TailFit fit_tail(std::span<const double> descending);

/// Which values form a tail.
enum class TailSide { smallest, largest };

/// Numbers of values to which a tail is fitted, and the limits of its shape.
struct TailOptions {
  double share = 0.025;         ///< Share of all values to which the tail is fitted, between ...
  std::size_t least = 16,       ///< ... this number
      most = 250;               ///< ... and this one.
  double shape_deviation = 1.5; ///< Standard deviation of a shape of 1/2, times the root of the number of values.
  double max_shape = 0.9;       ///< Largest shape in excess_beyond(): the mean diverges at 1.
};

/// A tail at three thresholds. A power law has the same shape at all of them; the flank of a peak has not.
struct Tail {
  TailFit fit,      ///< Fit to many values.
      deep;         ///< Fit to a quarter of them; empty if these are too few.
  double shape = 0; ///< Shape of `fit`, within the intervals of the shapes at the other thresholds.
};

/// Upper end of the one-sigma interval of a shape.
double upper_shape(const TailFit& fit, const TailOptions& o = {});

/// Fits the tail of `count` values, the largest of which are given in descending order.
Tail find_tail(std::span<const double> descending, std::size_t count, const TailOptions& o = {});
/// Fits one tail of the values.
Tail find_tail(const Extremes& e, TailSide side, const TailOptions& o = {});

/// Expected sum of the excesses over the largest value, of values beyond it, if one of them is expected among as many
/// values as were sampled.
///   assumes : The excesses of the largest values over a threshold follow a generalised Pareto distribution of shape
///             xi [Pickands75].
///   formula : Y xi / (1 - xi) with the largest excess Y, and for xi the upper end of its one-sigma interval, at most
///             `max_shape`. Bounded tails get 0. The larger result of `fit` and `deep` counts: only the largest values
///             of a smooth function plus a singularity belong to its tail.
///   cap     : Upper bound of Y, if one is known.
double excess_beyond(const Tail& tail, double cap = std::numeric_limits<double>::infinity(), const TailOptions& o = {});

/// Length by which a bound with error probability alpha is extended, in units of excess_beyond(): all N values are
/// below Y with probability alpha if Y is exceeded with probability -log(alpha) / N.
inline double tail_extension(double alpha) { return -std::log(alpha); }

} // namespace mc

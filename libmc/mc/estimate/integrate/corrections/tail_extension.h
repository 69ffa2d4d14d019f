#pragma once
/// Third correction of the error bar: values larger than all sampled values may add to the mean.

#include <mc/estimate/diagnostics/tail.h>
#include <mc/estimate/integrate/corrections/tuning.h>

#include <span>

namespace mc::detail {

/// Expected contribution to the mean of `count` values by unsampled ones beyond the largest: excess_beyond() / count.
///   cap : Upper bound of Y / N, for the largest excess Y of N values. Where replicates of n points differ by less than
///         Y / n, their points resolve the tail.
double tail_contribution(const Tail& tail, double count, double cap, const Tuning& t = default_tuning);

/// Contribution at the last of several lengths, averaged over the last `pooled_lengths`.
///   assumes : With a tail of shape xi contributions fall with the number of points n like n^-(1 - xi).
///   why     : A contribution halves at each length at which no value exceeds the largest, and runs would stop there.
///   contributions : at the lengths `points`, which double; both have the same size.
double pooled_contribution(std::span<const double> points, std::span<const double> contributions, double shape,
                           const Tuning& t = default_tuning);

} // namespace mc::detail

#pragma once
/// First correction of the error bar: the variance is pooled over the last lengths of the replicates.

#include <mc/estimate/integrate/corrections/tuning.h>

#include <optional>
#include <span>

namespace mc::detail {

/// Standard deviation between replicates at the last of several lengths.
///   assumes : The spread falls with the number of points n like n^-a.
///   formula : a is fitted by least squares to the logarithms of the last `rate_lengths` spreads, and clipped to
///             [0, max_rate]. The spreads s_j of the last `pooled_lengths` lengths are carried to the present one:
///             s^2 = mean of s_j^2 (n_j / n)^2a, but at least the present s_j^2: where points and integrand fit each
///             other, as Sobol' points and a diagonal edge, the spread falls in steps.
///   why     : The spread of few replicates is itself uncertain, and runs stop where it is too small by chance. At a
///             jump, replicates differ by a whole multiple of height / n, and agree by chance at many lengths.
///   spreads : at the lengths `points`, which double; both have the same size.
double pooled_spread(std::span<const double> points, std::span<const double> spreads, const Tuning& t = default_tuning);

/// Rate of convergence a of the last spreads; none where fewer than three of them are positive.
std::optional<double> convergence_rate(std::span<const double> points, std::span<const double> spreads,
                                       const Tuning& t = default_tuning);
/// Rate where none is known: that of independent points.
inline constexpr double unknown_rate = 0.5;

} // namespace mc::detail

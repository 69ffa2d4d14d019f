#pragma once
/// Dependence along a sequence, such as a Markov chain.

#include <cstddef>
#include <span>

namespace mc {

/// Integrated autocorrelation time of a stationary sequence: 1 + 2 (r_1 + r_2 + ...), where r_k is the correlation of
/// values k steps apart. n dependent values determine a mean as well as n / time independent values. Never below 1; n
/// for n equal values.
///   window : the sum ends at the first k >= 5 time(k). A longer sequence is averaged in blocks until this k is below
///            64, so that the work is linear in n.
///   error  : too small if the sequence is shorter than 50 times the result.
///   Source : [Sokal97].
double autocorrelation_time(std::span<const double> sequence);

/// Distance of rows to keep of a sequence of n values, so that the correlation of successive kept values is far below
/// the noise 1 / sqrt(n) of its estimate. 1 for independent values.
///   time : the autocorrelation time. Correlations are taken to fall as r^k, with r = (time - 1) / (time + 1), and the
///          distance is doubled: chains also have slower modes.
std::size_t thinning_distance(double time, std::size_t n);

} // namespace mc

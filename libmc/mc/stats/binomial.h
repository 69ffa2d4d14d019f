#pragma once
/// Tails of the binomial distribution.

#include <cstdint>

namespace mc {

/// P(X <= k) and P(X >= k) doubled, the smaller of the two, at most 1: exact two-sided tail of X ~ Binomial(n, p).
double binomial_tail(std::uint64_t k, std::uint64_t n, double p);

} // namespace mc

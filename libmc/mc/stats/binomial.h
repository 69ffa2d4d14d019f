#pragma once
/// Tails of the binomial distribution.

namespace mc {

/// P(X <= k) and P(X >= k) doubled, the smaller of the two, at most 1: exact two-sided tail of X ~ Binomial(n, p). For
/// k and n that are not whole, by the incomplete beta function between them.
double binomial_tail(double k, double n, double p);

} // namespace mc

#pragma once
/// Tails of the binomial distribution.

namespace mc {

/// Two-sided tail of X ~ Binomial(n, p): min(1, 2 P(X <= k), 2 P(X >= k)), exact. For k and n that are not whole,
/// interpolates with the incomplete beta function.
double binomial_tail(double k, double n, double p);

} // namespace mc

#include <mc/stats/binomial.h>

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>

namespace mc {

double binomial_tail(std::uint64_t k, std::uint64_t n, double p) {
  if (!(p > 0)) return k == 0 ? 1.0 : 0.0;
  if (p >= 1) return k == n ? 1.0 : 0.0;
  const boost::math::binomial distribution(static_cast<double>(n), p);
  const double at_most = boost::math::cdf(distribution, static_cast<double>(k));
  const double at_least =
      k == 0 ? 1.0 : boost::math::cdf(boost::math::complement(distribution, static_cast<double>(k - 1)));
  return std::min(1.0, 2 * std::min(at_most, at_least));
}

} // namespace mc

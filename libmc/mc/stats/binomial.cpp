#include <mc/stats/binomial.h>

#include <boost/math/special_functions/beta.hpp>

#include <algorithm>

namespace mc {

double binomial_tail(double k, double n, double p) {
  if (!(p > 0)) return k > 0 ? 0.0 : 1.0;
  if (p >= 1) return k < n ? 0.0 : 1.0;
  const double at_most = k < n ? boost::math::ibetac(k + 1, n - k, p) : 1.0;
  const double at_least = k > 0 ? boost::math::ibeta(k, n - k + 1, p) : 1.0;
  return std::min(1.0, 2 * std::min(at_most, at_least));
}

} // namespace mc

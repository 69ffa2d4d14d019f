#include <mc/core/types.h>
#include <mc/estimate/integrate/axis_warp.h>
#include <mc/random/hash.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

AxisWarp::AxisWarp(std::uint64_t seed, std::size_t dim) : c_(dim) {
  constexpr std::uint64_t apart = 0x77617270; // from the numbers of the scrambling
  const double most = strength / std::sqrt(static_cast<double>(dim));
  for (std::size_t d = 0; d < dim; ++d)
    c_[d] = most * (2 * std::ldexp(static_cast<double>(hash(seed, apart, d) >> 11), -53) - 1);
}

void AxisWarp::apply(std::span<double> points, std::span<double> jacobians) const {
  constexpr std::size_t block = 128; // points whose coordinates stay in the cache
  const std::size_t dim = c_.size();
  std::ranges::fill(jacobians, 1.0);
  for (std::size_t begin = 0; begin < jacobians.size(); begin += block)
    for (std::size_t d = 0; d < dim; ++d) {
      const double c = c_[d];
      for (std::size_t i = begin; i < std::min(begin + block, jacobians.size()); ++i) {
        double& u = points[i * dim + d];
        jacobians[i] *= 1 + c * (1 - 2 * u);
        u = std::min(u + c * u * (1 - u), one_minus_epsilon<double>);
      }
    }
}

} // namespace mc::detail

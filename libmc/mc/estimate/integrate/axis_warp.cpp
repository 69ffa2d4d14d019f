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
  constexpr double below_one = 1 - 0x1p-53;
  const std::size_t dim = c_.size();
  std::ranges::fill(jacobians, 1.0);
  for (std::size_t d = 0; d < dim; ++d) {
    const double c = c_[d];
    for (std::size_t i = 0; i < jacobians.size(); ++i) {
      double& u = points[i * dim + d];
      jacobians[i] *= 1 + c * (1 - 2 * u);
      u = std::min(u + c * u * (1 - u), below_one);
    }
  }
}

} // namespace mc::detail

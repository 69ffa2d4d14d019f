#pragma once
/// One uniform number of many bits from two of fewer.

#include <mc/core/types.h>

#include <algorithm>
#include <concepts>
#include <limits>

namespace mc {

/// A number in [0,1): u[0], a multiple of eps / 2, refined by u[1] below this step. From two floats it has 48 random
/// bits, which resolve the tails of unbounded distributions.
template <std::floating_point S> double joined(const Vec2<S>& u) {
  constexpr double step = static_cast<double>(std::numeric_limits<S>::epsilon()) / 2;
  return std::min(static_cast<double>(u[0]) + static_cast<double>(u[1]) * step, one_minus_epsilon<double>);
}

} // namespace mc

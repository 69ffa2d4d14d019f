#pragma once
/// Scales of numbers of any size.

#include <mc/core/sum.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace mc {

/// Largest |x|; 0 without numbers.
inline double largest_size(std::span<const double> x) {
  const auto larger = [](double a, double b) { return std::max(a, b); };
  return interleaved(x.size(), larger, [&](std::size_t i) { return std::abs(x[i]); });
}

/// Binary exponent of the largest |x|, or 0 if all are 0. Squares of ldexp(x, -exponent) do not overflow, and no
/// relevant square underflows.
inline int largest_exponent(std::span<const double> x) {
  const double largest = largest_size(x);
  return largest > 0 ? std::ilogb(largest) : 0;
}

} // namespace mc

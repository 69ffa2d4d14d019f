#pragma once
/// Scales of numbers of any size.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace mc {

/// Largest |x|; 0 without numbers.
inline double largest_size(std::span<const double> x) {
  constexpr std::size_t parts = 8; // side by side
  std::array<double, parts> largest{};
  std::size_t i = 0;
  for (; i + parts <= x.size(); i += parts)
    for (std::size_t k = 0; k < parts; ++k) largest[k] = std::max(largest[k], std::abs(x[i + k]));
  for (; i < x.size(); ++i) largest[0] = std::max(largest[0], std::abs(x[i]));
  return *std::max_element(largest.begin(), largest.end());
}

/// Binary exponent of the largest |x|, or 0 if all are 0. Squares of ldexp(x, -exponent) do not overflow, and no
/// relevant square underflows.
inline int largest_exponent(std::span<const double> x) {
  const double largest = largest_size(x);
  return largest > 0 ? std::ilogb(largest) : 0;
}

} // namespace mc

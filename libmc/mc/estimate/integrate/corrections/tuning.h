#pragma once
/// Every constant of the error bar of integrate(), in one place. docs/methods/integrate.md derives them.

#include <mc/estimate/diagnostics/tail.h>

#include <cstddef>

namespace mc::detail {

/// Constants of the three corrections and of the diagnostics.
struct Tuning {
  // Pooled variance.
  std::size_t pooled_lengths = 4; ///< Lengths that are averaged, the present one included.
  std::size_t rate_lengths = 6;   ///< Lengths to which the rate of convergence is fitted.
  double max_rate = 3.5;          ///< Largest rate: interlaced points reach 2.5.
  /// Standard error by values that no point met, in units of range / number of points; of a constant, of its size.
  /// Times t this is the rule of three.
  double unseen_value = 1.5;
  // Skewness.
  double skewness = 1; ///< Share of Johnson's shift.
  // Tail.
  TailOptions tail = {};  ///< Fit of the tail.
  double tail_length = 1; ///< Share of the extension.
  // Diagnostics.
  /// Shape above which the variance is called infinite: 1/2 and the deviation of a shape fitted to 62 values.
  double infinite_variance = 0.7;
  double not_integrable = 0.97;  ///< Shape from which the integral may not converge absolutely.
  std::size_t persistent = 3;    ///< Last lengths, most of which must agree on a finding.
  std::size_t few_values = 8;    ///< These largest values ...
  double dominating_share = 0.5; ///< ... dominate with this share of the sum of all sizes.
};

inline constexpr Tuning default_tuning{}; ///< The constants in use.

} // namespace mc::detail

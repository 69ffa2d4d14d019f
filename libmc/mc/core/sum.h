#pragma once
/// Sums of many numbers: compensated, and fast.

#include <array>
#include <cstddef>

namespace mc {

/// Sum of doubles with Neumaier's compensation.
///   error  : |sum - exact| <= 2^-52 |exact| + O(n 2^-104) sum |x|.
///   Source : [Neumaier74].
class CompensatedSum {
 public:
  /// Adds x to the sum.
  void add(double x) {
    const double t = sum_ + x;
    compensation_ += (sum_ < 0 ? -sum_ : sum_) >= (x < 0 ? -x : x) ? (sum_ - t) + x : (x - t) + sum_;
    sum_ = t;
  }
  /// The sum of all numbers added so far.
  double value() const { return sum_ + compensation_; }

 private:
  double sum_ = 0, compensation_ = 0;
};

/// Returns the sum of term(0), ..., term(n - 1). Eight partial sums take the terms in turn, so that no addition waits
/// for the one before. Their order depends on n alone.
template <class Term> double interleaved_sum(std::size_t n, Term&& term) {
  constexpr std::size_t parts = 8;
  std::array<double, parts> sums{};
  std::size_t i = 0;
  for (; i + parts <= n; i += parts)
    for (std::size_t k = 0; k < parts; ++k) sums[k] += term(i + k);
  for (; i < n; ++i) sums[i % parts] += term(i);
  for (std::size_t half = parts / 2; half > 0; half /= 2)
    for (std::size_t k = 0; k < half; ++k) sums[k] += sums[k + half];
  return sums[0];
}

} // namespace mc

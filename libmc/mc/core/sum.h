#pragma once
/// Sums of many numbers: compensated, and fast.

#include <array>
#include <cstddef>
#include <functional>

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

/// Combines 0 and term(0), ..., term(n - 1) by an associative operation. Eight partial results take the terms in turn,
/// so that no operation waits for the one before. Their order depends on n alone.
template <class Operation, class Term> double interleaved(std::size_t n, Operation&& combine, Term&& term) {
  constexpr std::size_t parts = 8;
  std::array<double, parts> results{};
  std::size_t i = 0;
  for (; i + parts <= n; i += parts)
    for (std::size_t k = 0; k < parts; ++k) results[k] = combine(results[k], term(i + k));
  for (; i < n; ++i) results[i % parts] = combine(results[i % parts], term(i));
  for (std::size_t half = parts / 2; half > 0; half /= 2)
    for (std::size_t k = 0; k < half; ++k) results[k] = combine(results[k], results[k + half]);
  return results[0];
}

/// Returns the sum of term(0), ..., term(n - 1), interleaved.
template <class Term> double interleaved_sum(std::size_t n, Term&& term) { return interleaved(n, std::plus<>(), term); }

} // namespace mc

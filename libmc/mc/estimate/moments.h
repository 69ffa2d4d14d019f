#pragma once
/// Running mean and variance.

#include <mc/estimate/estimate.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace mc {

/// Count, mean and sum of squared deviations of a stream of doubles, mergeable; non-finite values are counted apart and
/// the first one's index is kept.
///   error  : relative error of mean and variance O(eps) per merge, no cancellation [Welford62, ChanGolubLeVeque83],
///            but for overflow of the variance where numbers lie more than 1e154 apart
///   throws : estimate() throws Error when any value was not finite, or there are fewer than two
class Moments {
 public:
  void add(double x, std::uint64_t index = 0) {
    if (!std::isfinite(x)) [[unlikely]] {
      if (non_finite_++ == 0) first_non_finite_ = index;
      return;
    }
    ++count_;
    const double delta = x - mean_;
    mean_ += delta / static_cast<double>(count_);
    m2_ += delta * (x - mean_);
  }

  /// Adds a block of values whose indices start at `first`: two passes over it instead of a division per value.
  void add(std::span<const double> values, std::uint64_t first) {
    Moments block;
    double sum = 0;
    for (const double x : values) sum += x;
    const double n = static_cast<double>(values.size()), mean = sum / n;
    if (!std::isfinite(sum)) { // or the sum overflowed: one by one
      for (std::size_t i = 0; i < values.size(); ++i) block.add(values[i], first + i);
    } else if (!values.empty()) {
      double squares = 0, rest = 0;
      for (const double x : values) {
        squares += (x - mean) * (x - mean);
        rest += x - mean;
      }
      block.count_ = values.size();
      block.mean_ = mean + rest / n;
      block.m2_ = std::max(0.0, squares - rest * rest / n);
    }
    merge(block);
  }

  void merge(const Moments& other) {
    if (other.non_finite_ > 0 && non_finite_ == 0) first_non_finite_ = other.first_non_finite_;
    non_finite_ += other.non_finite_;
    if (other.count_ == 0) return;
    if (count_ == 0) { // the products below overflow for large numbers
      count_ = other.count_;
      mean_ = other.mean_;
      m2_ = other.m2_;
      return;
    }
    const double a = static_cast<double>(count_), b = static_cast<double>(other.count_), n = a + b;
    const double delta = other.mean_ - mean_;
    mean_ += delta * (b / n);
    m2_ += other.m2_ + delta * delta * (a * b / n);
    count_ += other.count_;
  }

  /// What would be there had every value been multiplied by 2^power.
  Moments scaled(int power) const {
    Moments m = *this;
    m.mean_ = std::ldexp(mean_, power);
    m.m2_ = std::ldexp(m2_, 2 * power);
    return m;
  }

  std::uint64_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Unbiased sample variance; 0 for fewer than two values.
  double variance() const { return count_ > 1 ? m2_ / static_cast<double>(count_ - 1) : 0.0; }
  /// Of the mean, as computed; estimate() widens it for the uncertainty of a variance of few values.
  double std_error() const { return count_ > 1 ? std::sqrt(variance() / static_cast<double>(count_)) : 0.0; }
  std::uint64_t non_finite_count() const { return non_finite_; }
  std::uint64_t first_non_finite() const { return first_non_finite_; } ///< index of the first non-finite value

  /// The mean with its error bar, count - 1 degrees of freedom behind it.
  Estimate estimate() const;

 private:
  std::uint64_t count_ = 0, non_finite_ = 0, first_non_finite_ = 0;
  double mean_ = 0, m2_ = 0;
};

} // namespace mc

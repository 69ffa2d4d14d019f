#pragma once
/// Running mean and variance.

#include <mc/core/sum.h>
#include <mc/estimate/estimate.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace mc {

/// Count, mean and sum of squared deviations of a stream of doubles; mergeable. Counts non-finite values separately and
/// stores the index of the first.
///   error  : Relative error of mean and variance is O(eps) per merge, without cancellation [Welford62,
///            ChanGolubLeVeque83]. The variance overflows for values more than 1e154 apart.
///   throws : estimate() throws Error if a value was not finite, or if there are fewer than two.
class Moments {
 public:
  /// Adds one value; `index` identifies it in error messages.
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

  /// Adds a block of values with indices from `first` on, in three passes and without a division for each value.
  void add(std::span<const double> values, std::uint64_t first) {
    Moments block;
    const double sum = interleaved_sum(values.size(), [&](std::size_t i) { return values[i]; });
    const double n = static_cast<double>(values.size()), mean = sum / n;
    if (!std::isfinite(sum)) { // non-finite values or an overflow of the sum: add values singly
      for (std::size_t i = 0; i < values.size(); ++i) block.add(values[i], first + i);
    } else if (!values.empty()) {
      const auto offset = [&](std::size_t i) { return values[i] - mean; };
      const double rest = interleaved_sum(values.size(), offset);
      const double squares = interleaved_sum(values.size(), [&](std::size_t i) { return offset(i) * offset(i); });
      block.count_ = values.size();
      block.mean_ = mean + rest / n;
      block.m2_ = std::max(0.0, squares - rest * rest / n);
    }
    merge(block);
  }

  /// Adds the values of another stream.
  void merge(const Moments& other) {
    if (other.non_finite_ > 0 && non_finite_ == 0) first_non_finite_ = other.first_non_finite_;
    non_finite_ += other.non_finite_;
    if (other.count_ == 0) return;
    if (count_ == 0) { // the products below would overflow for large numbers
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

  /// The moments of all values multiplied by 2^power.
  Moments scaled(int power) const {
    Moments m = *this;
    m.mean_ = std::ldexp(mean_, power);
    m.m2_ = std::ldexp(m2_, 2 * power);
    return m;
  }

  /// Number of finite values.
  std::uint64_t count() const { return count_; }
  /// Mean of the finite values.
  double mean() const { return mean_; }
  /// Unbiased sample variance; 0 for fewer than two values.
  double variance() const { return count_ > 1 ? m2_ / static_cast<double>(count_ - 1) : 0.0; }
  /// Standard error of the mean. estimate() widens it for the uncertainty of the variance.
  double std_error() const { return count_ > 1 ? std::sqrt(variance() / static_cast<double>(count_)) : 0.0; }
  /// Number of non-finite values.
  std::uint64_t non_finite_count() const { return non_finite_; }
  std::uint64_t first_non_finite() const { return first_non_finite_; } ///< Index of the first non-finite value.

  /// The mean with its error bar, with count - 1 degrees of freedom.
  Estimate estimate() const;

  /// The moments, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(count_, non_finite_, first_non_finite_, mean_, m2_); }

 private:
  std::uint64_t count_ = 0, non_finite_ = 0, first_non_finite_ = 0;
  double mean_ = 0, m2_ = 0;
};

} // namespace mc

#pragma once
/// Compensated summation.

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

} // namespace mc

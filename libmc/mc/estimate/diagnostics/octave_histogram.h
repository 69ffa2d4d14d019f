#pragma once
/// How large the values of an integrand are, and how heavy their tail.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

namespace mc {

/// Counts of values by the binary exponent of their absolute value, with the least and the largest; mergeable in any
/// order with the same result.
class OctaveHistogram {
 public:
  static constexpr int octaves = 48; ///< below the largest value; smaller ones are counted in the last
  static constexpr int exponent_of_zero = -52;

  /// The biased exponent, of subnormal numbers too: at most 0 and least of 0; 0x7ff where x is not finite.
  static int biased_exponent(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x) & 0x7fff'ffff'ffff'ffff;
    const auto biased = static_cast<int>(bits >> 52);
    return biased > 0 ? biased : static_cast<int>(std::bit_width(bits)) + exponent_of_zero;
  }

  void add(std::span<const double> values); ///< those that are not finite are left out
  void merge(const OctaveHistogram& other);

  std::uint64_t count() const { return count_; }
  double lo() const { return lo_; } ///< least value; 0 without any
  double hi() const { return hi_; } ///< largest value; 0 without any
  /// The mean of |X|, or down to half of it: values count as the least of their octave.
  double mean_magnitude() const;
  /// Numbers of values by octaves, the first with the exponent top_exponent(): that of 0 before the first value.
  std::span<const std::uint64_t, octaves> counts() const { return below_; }
  int top_exponent() const { return top_; }

  /// The index a of a tail P(|X| > t) ~ t^-a, from at least the `least` largest values: the mean of X is finite for
  /// a > 1, its variance for a > 2. Infinity where the largest values lie within one octave, as those of a bounded X
  /// do once they are met often enough.
  ///   error  : relative standard error 1.1 / sqrt(least) for independent values of an exact power law
  ///   Source : [Hill75], with values known by their octave: the steps above the threshold are geometric
  double tail_index(std::uint64_t least) const;

  /// The index of the largest 512th of the values, at least 16 and at most 128 of them. Infinity where it is above 1.3
  /// times that of the count^(2/3) largest: the tail of a peak that few points met looks heavy too, but gets lighter
  /// the farther out.
  double tail_index() const;

  /// Whether few values hold most of the sum: there is but one beside a hundred zeros or more, or the sixteen largest,
  /// zeros left out, fall off with an index below 1/2, far from the 1 that a mean needs. So they do where fewer than
  /// about four points met what a peak is made of.
  bool undersampled() const;

  /// What values larger than all that were met may add to the mean of |X|, if they fall off as the sixteen largest do:
  /// of a power law with the index a > 1 it is a / (a - 1) of what the largest adds. At most eleven times that, since
  /// sixteen values know an index to a quarter.
  double extrapolated_tail_mean() const;

 private:
  /// The largest values, octave by octave, and the sum of the numbers of their octaves.
  struct Largest {
    std::uint64_t count = 0, octave_sum = 0;
    std::size_t octaves = 0;

    void add(std::uint64_t here) {
      count += here;
      octave_sum += octaves++ * here;
    }
    double index() const; ///< infinity where all lie in one octave
  };
  /// So many at least, unless only the last octave has more.
  Largest largest(std::uint64_t least) const;
  /// Sixteen that are not 0, or all.
  Largest sixteen_largest() const;
  void raise(int top);
  std::uint64_t few_largest() const { return std::clamp<std::uint64_t>(count_ / 512, 16, 128); }
  std::uint64_t many_largest() const {
    return static_cast<std::uint64_t>(std::pow(static_cast<double>(count_), 2.0 / 3));
  }

  std::uint64_t count_ = 0, zeros_ = 0;
  double lo_ = 0, hi_ = 0;
  int top_ = exponent_of_zero;                 // of the first octave
  std::array<std::uint64_t, octaves> below_{}; // below_[i]: values with the exponent top_ - i
};

} // namespace mc

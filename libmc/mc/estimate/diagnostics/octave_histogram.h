#pragma once
/// Magnitudes of the values of an integrand and their tail index.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

namespace mc {

/// Counts of values by the binary exponent of their absolute value, with the range of the values. Merging gives the
/// same result in any order.
class OctaveHistogram {
 public:
  /// Number of octaves below the largest value. The last one also counts all smaller values.
  static constexpr int octaves = 48;
  /// Exponent of the value 0, below all others.
  static constexpr int exponent_of_zero = -52;

  /// Biased exponent, extended to subnormal numbers by exponents down to exponent_of_zero. Returns 0x7ff if x is not
  /// finite.
  static int biased_exponent(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x) & 0x7fff'ffff'ffff'ffff;
    const auto biased = static_cast<int>(bits >> 52);
    return biased > 0 ? biased : static_cast<int>(std::bit_width(bits)) + exponent_of_zero;
  }

  void add(std::span<const double> values); ///< Adds values; ignores non-finite values.
  /// Adds the values of another histogram.
  void merge(const OctaveHistogram& other);

  /// Number of values.
  std::uint64_t count() const { return count_; }
  double lo() const { return lo_; } ///< Smallest value; 0 if there are none.
  double hi() const { return hi_; } ///< Largest value; 0 if there are none.
  /// Lower bound of the mean of |X|, at least half of it. Each value counts as the lower end of its octave.
  double mean_magnitude() const;
  /// Number of values in each octave; the first has exponent top_exponent().
  std::span<const std::uint64_t, octaves> counts() const { return below_; }
  /// Biased exponent of the largest |X|; exponent_of_zero if there are no values.
  int top_exponent() const { return top_; }

  /// Index a of a tail P(|X| > t) ~ t^-a, from at least the `least` largest values. The mean of X is finite for a > 1,
  /// its variance for a > 2. Returns infinity if these values lie within one octave, as for a bounded X with enough
  /// values.
  ///   error  : Relative standard error 1.1 / sqrt(least) for independent values of an exact power law.
  ///   Source : [Hill75] for values rounded to octaves: the steps above the threshold are geometric.
  double tail_index(std::uint64_t least) const;

  /// Index of the largest 512th of the values, at least 16 and at most 128 values. Returns infinity if it is above 1.3
  /// times the index of the count^(2/3) largest values. The tail of an undersampled peak also looks heavy, but becomes
  /// lighter farther out.
  double tail_index() const;

  /// Whether few values dominate the sum. This is so if only one of more than a hundred values is not 0. It is also so
  /// if the sixteen largest nonzero values fall off with an index below 1/2, far below the index 1 of a finite mean.
  /// Fewer than about four points in a peak give such an index.
  bool undersampled() const;

  /// Possible contribution of values larger than all samples to the mean of |X|, if they continue the tail of the
  /// sixteen largest. For a power law with index a > 1 it is a / (a - 1) times the contribution of the largest value.
  /// At most eleven times that, because sixteen values determine the index only to about a quarter.
  double extrapolated_tail_mean() const;

 private:
  /// The values of the upper octaves: their number, and the sum of the numbers of their octaves.
  struct Largest {
    std::uint64_t count = 0, octave_sum = 0;
    std::size_t octaves = 0;

    void add(std::uint64_t here) {
      count += here;
      octave_sum += octaves++ * here;
    }
    double index() const; ///< Infinity if all are in one octave.
  };
  /// At least the `least` largest values, unless only the last octave has more.
  Largest largest(std::uint64_t least) const;
  /// The sixteen largest nonzero values, or all if there are fewer.
  Largest sixteen_largest() const;
  void raise(int top);
  std::uint64_t few_largest() const { return std::clamp<std::uint64_t>(count_ / 512, 16, 128); }
  std::uint64_t many_largest() const {
    return static_cast<std::uint64_t>(std::pow(static_cast<double>(count_), 2.0 / 3));
  }

  std::uint64_t count_ = 0, zeros_ = 0;
  double lo_ = 0, hi_ = 0;
  int top_ = exponent_of_zero;                 // of the first octave
  std::array<std::uint64_t, octaves> below_{}; // below_[i]: number of values with exponent top_ - i
};

} // namespace mc

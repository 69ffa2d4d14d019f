#pragma once
/// The largest and the smallest of many values.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Counts values, and keeps the 256 largest and the 256 smallest. Mergeable; the result does not depend on the order.
class Extremes {
 public:
  /// Number of values that are kept on each side.
  static constexpr std::size_t capacity = 256;

  /// Adds values; non-finite values are skipped.
  void add(std::span<const double> values);
  /// Adds all values of another object.
  void merge(const Extremes& other);
  /// An empty object for values that will be merged into this one: it skips values that could not be kept.
  Extremes for_more_values() const;

  /// The values, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) {
    a(count_, zeros_, mean_size_, high_cut_, low_cut_, hi_, lo_, high_, low_);
  }

  /// Number of finite values.
  std::uint64_t count() const { return count_; }
  /// Number of zeros.
  std::uint64_t zeros() const { return zeros_; }
  /// Mean of the absolute values; 0 without values.
  double mean_size() const { return mean_size_; }
  /// Largest value; 0 without values.
  double hi() const { return count_ > 0 ? hi_ : 0.0; }
  /// Smallest value; 0 without values.
  double lo() const { return count_ > 0 ? lo_ : 0.0; }
  /// The k largest values in descending order, or all that are kept.
  std::vector<double> largest(std::size_t k) const;
  /// The k smallest values in ascending order, or all that are kept.
  std::vector<double> smallest(std::size_t k) const;

 private:
  void keep(std::span<const double> values);
  void compact();

  std::uint64_t count_ = 0, zeros_ = 0;
  double mean_size_ = 0;
  double high_cut_, low_cut_; // only values above or below can be kept
  double hi_, lo_;            // largest and smallest value, also of values that came before
  std::vector<double> high_, low_;

 public:
  Extremes();
};

} // namespace mc

#pragma once
/// Discrete outcomes that are whole numbers, perhaps infinitely many.

#include <vector>

namespace mc {

/// The whole numbers from lo to hi. Those from first to last are listed: each has an index of its own. All others
/// together are one more outcome, the rest.
struct Outcomes {
  double lo = 0,    ///< the least; may be -infinity
      hi = -1;      ///< the greatest, or infinity; below lo if there are none
  double first = 0, ///< the first that is listed
      last = -1;    ///< the last that is listed

  /// No outcomes.
  Outcomes() = default;
  /// The whole numbers from lo to hi, all listed if both are finite; else list() must follow.
  Outcomes(double lo, double hi);

  /// Whether there are outcomes.
  bool any() const { return hi >= lo; }
  /// Whether some are not listed.
  bool has_rest() const { return first > lo || last < hi; }
  /// Number of those that are listed.
  int listed() const { return static_cast<int>(last - first) + 1; }
  /// Number of indices: of those that are listed, and of the rest.
  int count() const { return listed() + int(has_rest()); }
  /// The index of k; -1 if it is no outcome.
  int index(double k) const;
  /// Lists at most 2^20: from a finite end if the samples are near it, else around their median, to their extremes.
  void list(std::vector<double> samples);
  /// Appends the probability of the rest, the rest of 1, to those of the listed outcomes.
  void add_rest(std::vector<double>& probabilities) const;
};

} // namespace mc

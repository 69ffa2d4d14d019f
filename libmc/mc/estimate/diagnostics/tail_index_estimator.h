#pragma once
/// Tail index of an integrand, independent of the density of its points.

#include <mc/core/types.h>
#include <mc/estimate/diagnostics/octave_histogram.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace mc {

/// Estimates the tail index of |f| from weighted samples: the volume of {|f| > t} by octaves of t, from points of any
/// density q. Estimators for the same density can be merged.
/// The weighted values f / q would hide the tail of f, because a learned q follows f as far as its samples reach.
/// Farther out q is bounded, so f / q has infinite variance if f has. The estimator therefore uses f
/// itself. Points of such a q reach deep into the tail, and each represents a known volume.
class TailIndexEstimator {
 public:
  /// Number of octaves below the largest value. The last one also counts all smaller values.
  static constexpr int octaves = OctaveHistogram::octaves;

  /// Estimator without values.
  TailIndexEstimator() = default;
  /// Estimator from values at uniform points.
  explicit TailIndexEstimator(const OctaveHistogram& values);

  /// Adds values of f with 1 / q at their points, or without volumes for uniform points. Ignores non-finite values.
  void add(std::span<const double> values, std::span<const double> volumes = {});
  /// Adds the values of another estimator.
  void merge(const TailIndexEstimator& other);
  /// Whether there are no values.
  bool empty() const { return octave_volumes_.empty(); }

  /// Index a of vol {|f| > t} ~ t^-a. The mean of f is finite for a > 1, its variance for a > 2. Uses enough of the
  /// largest values to give an index of 2 a standard error of .25. Returns infinity if there are fewer values, if f is
  /// bounded, or if the index grows with t, unlike the index of a power law.
  ///   error  : Standard deviation a / 8 for a power law.
  ///   Source : Maximum likelihood for the numbers of points in octaves; [Hill75] if all points have the same volume.
  double index() const;

  /// Whether the variance of f is infinite. Both the largest values and many values must agree with an index of 2 or
  /// less. Many means enough values to give an index of 2 a standard error of .06, or less beyond 10'000 values. An
  /// index just above 2 cannot be distinguished from 2. x^-.5 gives true, and so does occasionally a product of several
  /// x^-.4, because its tail becomes lighter only very near 0.
  bool infinite_variance() const;
  /// Biased exponent of the largest value, as in OctaveHistogram.
  int top_exponent() const { return top_; }

 private:
  struct Octave {
    double volume = 0, square = 0; // Sums over the points of the octave.
    double points() const {
      return square > 0 ? volume * volume / square : 0;
      // Number of points of equal volume with the same precision.
    }
    double rate() const { return square > 0 ? volume / square : 0; }
    void operator+=(const Octave& o) {
      volume += o.volume;
      square += o.square;
    }
  };
  class Fit;
  void raise(int top);
  Fit fit(double error) const;
  Fit fit_to_many() const;

  // octave_volumes_[i]: octave with exponent top_ - i; empty before the first value
  std::vector<Octave> octave_volumes_;
  int top_ = OctaveHistogram::exponent_of_zero; // of the first octave
  bool uniform_ = false;                        // whether the points are uniform
};

} // namespace mc

#pragma once
/// How heavy the tail of an integrand is, whatever its points were drawn from.

#include <mc/core/types.h>
#include <mc/estimate/diagnostics/octave_histogram.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace mc {

/// The volume of {|f| > t} by octaves of t, from points of any density q; mergeable with what others of the same
/// density saw. The values f / q that a run adds up hide the tail of f: a q that was learned follows f as far as its
/// points showed it. Farther out q is bounded, so that the variance of f / q is infinite where that of f is. Therefore
/// f itself is looked at. The points of such a q reach as deep into the tail as the integral does, and each says how
/// much volume it stands for.
class TailIndexEstimator {
 public:
  static constexpr int octaves = OctaveHistogram::octaves; ///< below the largest value; smaller ones are of the last

  TailIndexEstimator() = default;
  /// Of values at uniform points.
  explicit TailIndexEstimator(const OctaveHistogram& values);

  /// Values of f, and 1 / q of their points, none for uniform ones; values that are not finite are left out.
  void add(std::span<const double> values, std::span<const double> volumes = {});
  void merge(const TailIndexEstimator& other);
  bool empty() const { return octave_volumes_.empty(); }

  /// The index a of vol {|f| > t} ~ t^-a: the mean of f is finite for a > 1, its variance for a > 2. It is found from
  /// the largest values alone, from as many as it takes for an index of 2 to have a standard error of .25. Infinity
  /// where fewer were met, where f is seen to be bounded, and where the index grows with t, which that of a power does
  /// not.
  ///   error  : of a power law, a standard deviation of a / 8
  ///   Source : maximum likelihood for the numbers of points in octaves, [Hill75] where each stands for as much volume
  double index() const;

  /// Whether the variance of f is infinite. The largest values must agree with an index of 2 or less, and so must many
  /// values: as many as it takes for an index of 2 to have a standard error of .06, or less if there are more than
  /// 10'000 in all. An index just above 2 cannot be told from 2: x^-.5 is found to have infinite variance, and
  /// sometimes so is a product of several x^-.4, whose tail looks lighter only very near 0.
  bool infinite_variance() const;
  /// The exponent of the largest value, see OctaveHistogram.
  int top_exponent() const { return top_; }

 private:
  struct Octave {
    double volume = 0, square = 0;                                              // sums over its points
    double points() const { return square > 0 ? volume * volume / square : 0; } // of equal volumes, as good
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

  std::vector<Octave> octave_volumes_;          // octave_volumes_[i]: of exponent top_ - i; none before the first value
  int top_ = OctaveHistogram::exponent_of_zero; // of the first octave
  bool uniform_ = false;                        // the points
};

} // namespace mc

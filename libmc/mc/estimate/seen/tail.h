#pragma once
/// How heavy the tail of an integrand is, whatever its points were drawn from.

#include <mc/core/types.h>
#include <mc/estimate/seen/magnitudes.h>

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
class Tail {
 public:
  static constexpr int octaves = Magnitudes::octaves; ///< below the largest value; smaller ones are of the last

  Tail() = default;
  /// Of values at uniform points.
  explicit Tail(const Magnitudes& values);

  /// Values of f, and 1 / q of their points, none for uniform ones; values that are not finite are left out.
  void add(std::span<const double> values, std::span<const double> volumes = {});
  void merge(const Tail& other);
  bool empty() const { return seen_.empty(); }

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
  /// The exponent of the largest value, see Magnitudes.
  int top() const { return top_; }

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

  std::vector<Octave> seen_;               // seen_[i]: of exponent top_ - i; none before the first value
  int top_ = Magnitudes::exponent_of_zero; // of the first octave
  bool uniform_ = false;                   // the points
};

namespace detail {
/// What a run saw of an integrand: the values that it adds up, and the tail of f where those are not f itself.
struct Seen {
  Magnitudes values = {};
  Tail tail = {};
  std::array<Tail, 2> over = {}; ///< of f less the bounds of a constant, see Run::floors; empty where that is 0
  Magnitudes uniform = {};       ///< of f, where uniform points are but a part of a mixture
  double lo = infinity<double>, hi = -infinity<double>; ///< of f, where points are drawn from a density
  std::uint64_t infinite = 0;                           ///< values that were
  double infinite_volume = 0; ///< that their points stand for, where all of a run stand for their number

  void merge(const Seen& other) {
    infinite += other.infinite;
    infinite_volume += other.infinite_volume;
    lo = std::min(lo, other.lo);
    hi = std::max(hi, other.hi);
    values.merge(other.values);
    tail.merge(other.tail);
    for (std::size_t i = 0; i < over.size(); ++i) over[i].merge(other.over[i]);
    uniform.merge(other.uniform);
  }
  void add_to_range(std::span<const double> f) {
    for (const double x : f) {
      lo = std::min(lo, x);
      hi = std::max(hi, x);
    }
  }
  /// Whether f was the same at all points.
  bool constant() const { return tail.empty() ? values.lo() == values.hi() : lo == hi; }
  double tail_index() const { return tail.empty() ? Tail(values).index() : tail.index(); }
  /// The index that makes the variance infinite, or that of the tail.
  double telling_index() const {
    const double own = tail_index();
    if (!infinite_variance()) return own;
    if (over[0].infinite_variance()) return over[0].index();
    return std::isfinite(own) ? own : Tail(uniform).index();
  }
  /// Two points so near that doubles cannot tell them apart may hold much of a singular integral. Where a density was
  /// learned the uniform points alone may show it, too: a density that follows f down to neighbouring doubles makes the
  /// end of these look like the end of a tail. They count from a thousand on, since to fewer a steep exponential looks
  /// as heavy, only where their index is well below 2, since they do not show it well, and only where values went on
  /// growing under the density, by 16 at least: of a ridge that few uniform points meet they do not.
  bool infinite_variance() const {
    if (infinite > 0) return true;
    if (tail.empty() ? Tail(values).infinite_variance() : tail.infinite_variance()) return true;
    if (over[0].infinite_variance() && over[1].infinite_variance()) return true;
    if (uniform.count() < 1000 || tail.top() < uniform.top() + 4) return false;
    const Tail of_uniform(uniform);
    return of_uniform.infinite_variance() && of_uniform.index() < 1.5;
  }
};
} // namespace detail

} // namespace mc

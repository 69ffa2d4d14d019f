#include <mc/core/types.h>
#include <mc/estimate/diagnostics/tail_index_estimator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mc {

namespace {
constexpr double borderline = 2; // the variance is finite for an index above this
constexpr double few = 0.25;     // standard error of an index of 2 from the largest values
constexpr double many = 0.06;    // same from many values, for at most 10'000 of them; less for more
constexpr double enough = 12;    // points in an octave that determine the rate of points per volume
constexpr double most = 0.6;     // largest share of the volume that a tail may fill
// The index of the largest values may exceed the index of many values by the ratio of their volumes to this power. The
// index of x^-p y^-p grows logarithmically. Uniform points reach few large values, and the index of these is
// inaccurate.
constexpr double growth = 0.06, growth_of_uniform = 0.14;
} // namespace

// Power law fitted to the values from a lowest octave up. Octaves are numbered 0, 1, ... from that one. For index a,
// the volume of each octave is 2^-a times the volume of the octave below it, without end. The number of points per
// volume comes from the points in each octave. Above the highest octave with points, the rate of that octave applies.
// The maximum likelihood index gives the observed mean octave number of the points.
class TailIndexEstimator::Fit {
 public:
  bool known = false; // whether there are enough values to determine the index
  double points = 0;

  double volume() const { return all_.volume; }
  void add(const Octave& next) {
    const bool together = points < enough; // few points determine a rate only together
    sum_ += points;                        // each point moves one octave up
    points += next.points();
    all_ += next;
    if (together) {
      std::fill(rates_.begin(), rates_.begin() + size_ + 1, all_.rate());
    } else {
      rates_[size_] = rate_of(next);
    }
    last_ = next;
    ++size_;
  }
  // Standard error of the index if the index is 2.
  double error() const { return 1 / (std::log(2.0) * std::sqrt(points * moments(borderline).variance)); }
  // Excess of the mean octave number over its expectation for an index of 2, in standard deviations.
  double excess_z_score() const {
    const Moments m = moments(borderline);
    return (sum_ / points - m.mean) / std::sqrt(m.variance / points);
  }
  double index() const {
    double lo = 1.0 / 64, hi = 32;
    for (int i = 0; i < 40; ++i) {
      const double a = std::sqrt(lo * hi);
      (moments(a).mean > sum_ / points ? lo : hi) = a;
    }
    return lo;
  }

 private:
  struct Moments {
    double mean, variance;
  };
  // Points per volume of an octave. With few points, pools them with the octave above. Without any, uses the rate of
  // the octave above.
  double rate_of(const Octave& next) const {
    if (next.points() >= enough) return next.rate();
    if (!(next.volume > 0)) return rates_[size_ - 1];
    Octave both = last_;
    both += next;
    return both.rate();
  }
  // Moments of the octave number of a point, for an index a.
  Moments moments(double a) const {
    const double q = std::exp2(-a);
    double power = 1, s0 = 0, s1 = 0, s2 = 0;
    for (std::size_t k = 0; k < size_; ++k) {
      const double number = static_cast<double>(k), expected = rates_[size_ - 1 - k] * power;
      s0 += expected;
      s1 += number * expected;
      s2 += sqr(number) * expected;
      power *= q;
    }
    // All octaves above, by geometric series.
    const double k = static_cast<double>(size_), r = 1 / (1 - q), first = rates_[0] * power * r;
    s0 += first;
    s1 += first * (k + q * r);
    s2 += first * (k * k + 2 * k * q * r + q * (1 + q) * r * r);
    return {s1 / s0, s2 / s0 - sqr(s1 / s0)};
  }

  std::array<double, octaves> rates_{}; // points per volume, from the top octave down
  std::size_t size_ = 0;
  double sum_ = 0; // sum of the octave numbers of all points
  Octave all_, last_;
};

TailIndexEstimator::TailIndexEstimator(const OctaveHistogram& values) : top_(values.top_exponent()), uniform_(true) {
  for (const std::uint64_t n : values.counts())
    octave_volumes_.push_back({static_cast<double>(n), static_cast<double>(n)});
}

void TailIndexEstimator::raise(int top) {
  octave_volumes_.resize(octaves);
  if (top <= top_) return;
  std::vector<Octave> moved(octaves);
  for (int i = 0; i < octaves; ++i) {
    moved[static_cast<std::size_t>(std::min(i + (top - top_), octaves - 1))] +=
        octave_volumes_[static_cast<std::size_t>(i)];
  }
  octave_volumes_ = std::move(moved);
  top_ = top;
}

void TailIndexEstimator::add(std::span<const double> values, std::span<const double> volumes) {
  raise(top_);
  uniform_ = volumes.empty();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int exponent = OctaveHistogram::biased_exponent(values[i]);
    if (exponent == 0x7ff) continue;
    if (exponent > top_) [[unlikely]]
      raise(exponent);
    Octave& octave = octave_volumes_[static_cast<std::size_t>(std::min(top_ - exponent, octaves - 1))];
    const double volume = uniform_ ? 1 : volumes[i];
    octave.volume += volume;
    octave.square += volume * volume;
  }
}

void TailIndexEstimator::merge(const TailIndexEstimator& other) {
  if (other.empty()) return;
  uniform_ = other.uniform_ && (uniform_ || empty());
  raise(other.top_);
  for (int i = 0; i < octaves; ++i) {
    octave_volumes_[static_cast<std::size_t>(std::min(i + (top_ - other.top_), octaves - 1))] +=
        other.octave_volumes_[static_cast<std::size_t>(i)];
  }
}

// Fits to the largest values, enough for this standard error of an index of 2, or to all values that belong to the
// tail.
TailIndexEstimator::Fit TailIndexEstimator::fit(double error) const {
  double all = 0;
  for (const Octave& o : octave_volumes_) all += o.volume;
  Fit fit;
  for (std::size_t i = 0; i + 1 < octave_volumes_.size(); ++i) {
    if (fit.volume() + octave_volumes_[i].volume > most * all) break;
    fit.add(octave_volumes_[i]);
    if (fit.points > enough && fit.error() <= error) break;
  }
  fit.known = fit.points > enough && fit.error() <= few;
  return fit;
}

// Uses more values if there are more, because a wider range shows whether the index grows.
TailIndexEstimator::Fit TailIndexEstimator::fit_to_many() const {
  double points = 0;
  for (const Octave& o : octave_volumes_) points += o.points();
  return fit(many * std::min(1.0, std::pow(1e4 / points, 0.2)));
}

double TailIndexEstimator::index() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Fit largest = fit(few);
  if (!largest.known) return infinity;
  const double index = largest.index();
  const Fit all = fit_to_many();
  const double grown = std::pow(all.volume() / largest.volume(), uniform_ ? growth_of_uniform : growth);
  return index < 20 && index <= all.index() * grown ? index : infinity;
}

bool TailIndexEstimator::infinite_variance() const {
  const Fit largest = fit(few);
  if (!largest.known || largest.excess_z_score() < -1.5 || fit_to_many().excess_z_score() < -1)
    return false; // in standard deviations
  return std::isfinite(index());
}

} // namespace mc

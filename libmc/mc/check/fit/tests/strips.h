#pragma once
/// Strips across single axes: caps at a pole, rims, thin layers that every cell sees only a corner of.

#include <mc/check/fit/expected/slab_mass.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/fit/weighted_counts.h>
#include <mc/check/report/report.h>

#include <array>
#include <vector>

namespace mc {

/// Counts samples, and what is expected of them, in thin strips across each axis: between neighbouring quantiles of the
/// pilot, and at both ends in strips that halve.
class Strips {
 public:
  Strips(const Pilot& pilot, int dim);

  /// share : what a random point at v stands for
  void add_sample(const Subject::Coordinates& v, double weight, double share) {
    for (Layers& axis : axes_) axis.strips[axis.find(v[axis.index])].add_sample(weight, share);
  }
  /// A random point that stands for a share of the expected samples; weight : what a sample at v counts.
  void add_expected(const Subject::Coordinates& v, double share, double weight) {
    for (Layers& axis : axes_) axis.strips[axis.find(v[axis.index])].add_expected(share, weight);
  }

  /// One Check: the run of 1, 2, 4, ... neighbouring strips whose count is farthest off. The 64 runs that look worst
  /// against the random points, and those at the ends, are held against a quick integral of their own, and the worst
  /// four of those against a better one; against the points (weighted_counts.h) where not all their samples count 1,
  /// and where the points state a smaller error than the integral does. Left out are runs whose samples the scalar
  /// rounds to fewer than 64 steps, or whose count a step at each end would move by half a standard deviation.
  ///   subject, pilot : whose samples were counted
  ///   n, mass        : samples that were points; what the density integrates to
  Check test(const Subject& subject, const Pilot& pilot, double n, double mass, double share, double alpha) const;

 private:
  struct Layers {
    std::size_t index = 0;    ///< of the axis
    std::vector<double> ends; ///< ascending, from the second strip's lower end
    std::vector<WeightedCounts> strips;
    std::vector<std::uint32_t> points, first_points; ///< of the pilot, by strips, and where those of each begin
    static constexpr std::size_t buckets = 1 << 14;
    std::vector<std::uint32_t> guide; ///< the first strip that may hold v, by floor(buckets v), and the last
    std::size_t find(double v) const {
      const double place = v > 0 ? static_cast<double>(buckets) * v : 0.0;
      const std::size_t bucket = place < static_cast<double>(buckets - 1)
                                     ? static_cast<std::size_t>(static_cast<std::int64_t>(place))
                                     : buckets - 1;
      std::size_t i = guide[bucket], left = guide[bucket + 1] - i;
      // No branch depends on v: where the samples crowd, one bucket holds most strips.
      while (left > 1) {
        const std::size_t half = left / 2;
        i += static_cast<std::size_t>(ends[i + half - 1] <= v) * half;
        left -= half;
      }
      if (left == 1) i += static_cast<std::size_t>(ends[i] <= v);
      return i;
    }
  };
  static void sort_points(const Pilot& pilot, Layers& axis);
  /// Neighbouring strips whose count is off.
  struct Run {
    std::size_t axis, first, last; ///< strips, and the one after them
    double lo, hi;
    WeightedCounts counts;
    CountsCompared compared;
    double expected = 0, p = 1;
    void judge(const Subject& s, const Pilot& pilot, Layer layer, double n, double mass, Effort effort);
  };
  /// With the points of the pilot in a run, or in it and the strips beside it, at least 64.
  Layer layer(const Run& run) const;
  /// Whether rounding may explain the count of a run.
  bool is_rounded(const Subject& s, const Pilot& pilot, const Run& run) const;
  std::vector<Run> farthest_runs(double& family) const;

  std::vector<Layers> axes_;
};

} // namespace mc

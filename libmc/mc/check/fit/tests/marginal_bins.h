#pragma once
/// Strips across single axes: caps at a pole, rims, thin layers that every cell sees only a corner of.

#include <mc/check/fit/expected/interval_mass.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/fit/weighted_counts.h>
#include <mc/check/report/report.h>

#include <array>
#include <vector>

namespace mc {

/// Counts samples, and what is expected of them, in thin bins across each axis: between neighbouring quantiles of the
/// pilot, and at both ends in bins that halve.
class MarginalBins {
 public:
  MarginalBins(const Pilot& pilot, int dim);

  /// share : what a random point at v stands for
  void add_sample(const Subject::Coordinates& v, double weight, double share) {
    for (AxisBins& axis : axes_) axis.bins[axis.find(v[axis.index])].add_sample(weight, share);
  }
  /// A random point that stands for a share of the expected samples; weight : what a sample at v counts.
  void add_expected(const Subject::Coordinates& v, double share, double weight) {
    for (AxisBins& axis : axes_) axis.bins[axis.find(v[axis.index])].add_expected(share, weight);
  }

  /// One Check: the run of 1, 2, 4, ... neighbouring bins whose count is farthest off. The 64 runs that look worst
  /// against the random points, and those at the ends, are held against a quick integral of their own, and the worst
  /// four of those against a better one; against the points (weighted_counts.h) where not all their samples count 1,
  /// and where the points state a smaller error than the integral does. Left out are runs whose samples the scalar
  /// rounds to fewer than 64 steps, or whose count a step at each end would move by half a standard deviation.
  ///   subject, pilot : whose samples were counted
  ///   n, mass        : samples that were points; what the density integrates to
  Check test(const Subject& subject, const Pilot& pilot, double n, double mass, double share, double alpha) const;

 private:
  struct AxisBins {
    std::size_t index = 0;    ///< of the axis
    std::vector<double> ends; ///< ascending, from the second bin's lower end
    std::vector<WeightedCounts> bins;
    std::vector<std::uint32_t> points, first_points; ///< of the pilot, by bins, and where those of each begin
    static constexpr std::size_t buckets = 1 << 14;
    std::vector<std::uint32_t> guide; ///< the first bin that may hold v, by floor(buckets v), and the last
    std::size_t find(double v) const {
      const double place = v > 0 ? static_cast<double>(buckets) * v : 0.0;
      const std::size_t bucket = place < static_cast<double>(buckets - 1)
                                     ? static_cast<std::size_t>(static_cast<std::int64_t>(place))
                                     : buckets - 1;
      std::size_t i = guide[bucket], left = guide[bucket + 1] - i;
      // No branch depends on v: where the samples crowd, one bucket holds most bins.
      while (left > 1) {
        const std::size_t half = left / 2;
        i += static_cast<std::size_t>(ends[i + half - 1] <= v) * half;
        left -= half;
      }
      if (left == 1) i += static_cast<std::size_t>(ends[i] <= v);
      return i;
    }
  };
  static void sort_points(const Pilot& pilot, AxisBins& axis);
  /// Neighbouring bins whose count is off.
  struct BinRange {
    std::size_t axis, first, last; ///< bins, and the one after them
    double lo, hi;
    WeightedCounts counts;
    CountComparison compared;
    double expected = 0, p = 1;
    void compute_p(const Subject& s, const Pilot& pilot, IntervalQuery query, double n, double mass, Effort effort);
  };
  /// With the points of the pilot in a run, or in it and the bins beside it, at least 64.
  IntervalQuery interval_query(const BinRange& range) const;
  /// Whether rounding may explain the count of a run.
  bool is_rounded(const Subject& s, const Pilot& pilot, const BinRange& range) const;
  std::vector<BinRange> farthest_ranges(double& family) const;

  std::vector<AxisBins> axes_;
};

} // namespace mc

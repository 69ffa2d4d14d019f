#pragma once
/// Tests of thin bins across single axes: caps at a pole, rims, and thin layers that fill only a corner of each cell.

#include <mc/check/fit/expected/interval_mass.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/fit/weighted_counts.h>
#include <mc/check/report/report.h>

#include <array>
#include <vector>

namespace mc {

/// Counts observed and expected samples in thin bins across each axis. The bins lie between neighbouring quantiles of
/// the pilot; the first and the last are halved repeatedly towards the ends.
class MarginalBins {
 public:
  MarginalBins(const Pilot& pilot, int dim);

  /// Adds a sample.
  ///   share : the share that a random point at v represents.
  void add_sample(const Subject::Coordinates& v, double weight, double share) {
    for (AxisBins& axis : axes_) axis.bins[axis.find(v[axis.index])].add_sample(weight, share);
  }
  /// Adds a random point that represents a share of the expected samples.
  ///   weight : the weight of a sample at v.
  void add_expected(const Subject::Coordinates& v, double share, double weight) {
    for (AxisBins& axis : axes_) axis.bins[axis.find(v[axis.index])].add_expected(share, weight);
  }

  /// Returns one Check for the run of 1, 2, 4, ... neighbouring bins with the smallest p-value. First, all runs are
  /// compared with the random points. The 64 worst runs and the runs at the ends are then compared with a quick
  /// integral of their own, and the worst four of these with a more accurate integral. The random points
  /// (weighted_counts.h) replace the integral if samples have weights other than 1, or if the integral is less
  /// accurate. Runs are skipped if rounding leaves fewer than 64 steps in them, or if a step at both ends changes their
  /// count by half a standard deviation.
  ///   subject, pilot : the source of the counted samples, and its pilot.
  ///   n, mass        : number of samples that are points, and the integral of the density.
  Check test(const Subject& subject, const Pilot& pilot, double n, double mass, double share, double alpha) const;

 private:
  struct AxisBins {
    std::size_t index = 0;    ///< number of the axis
    std::vector<double> ends; ///< ascending, from the second bin's lower end
    std::vector<WeightedCounts> bins;
    /// Points of the pilot sorted by bin, and the first point of each bin.
    std::vector<std::uint32_t> points, first_points;
    static constexpr std::size_t buckets = 1 << 14;
    std::vector<std::uint32_t> guide; ///< the first bin that may contain v, by floor(buckets * v), and the last
    std::size_t find(double v) const {
      const double place = v > 0 ? static_cast<double>(buckets) * v : 0.0;
      const std::size_t bucket = place < static_cast<double>(buckets - 1)
                                     ? static_cast<std::size_t>(static_cast<std::int64_t>(place))
                                     : buckets - 1;
      std::size_t i = guide[bucket], left = guide[bucket + 1] - i;
      // No branch depends on v. If the samples crowd, one bucket contains most bins.
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
  /// A run of neighbouring bins.
  struct BinRange {
    std::size_t axis, first, last; ///< axis, first bin, and one past the last bin
    double lo, hi;
    WeightedCounts counts;
    CountComparison compared;
    double expected = 0, p = 1;
    void compute_p(const Subject& s, const Pilot& pilot, IntervalQuery query, double n, double mass, Effort effort);
  };
  /// Returns the query of a run with the pilot points inside. If these are fewer than 64, points of the bins next to
  /// the run are added.
  IntervalQuery interval_query(const BinRange& range) const;
  /// Whether rounding may explain the count of a run.
  bool is_rounded(const Subject& s, const Pilot& pilot, const BinRange& range) const;
  std::vector<BinRange> farthest_ranges(double& family) const;

  std::vector<AxisBins> axes_;
};

} // namespace mc

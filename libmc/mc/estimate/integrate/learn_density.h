#pragma once
/// Learns from weighted samples of an integrand where its points should be. Pure functions.

#include <mc/estimate/adapt/adapted_density.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace mc::detail {

/// The density of the points. Without a learned density p points are uniform, and f is averaged. With p, the density is
/// the defensive mixture q = 7/8 p + 1/8. The average of (f - c p) / q + c has the same expectation. No value exceeds
/// 8 |f| + 8/7 |c|, and the variance vanishes if f = c p [OwenZhou00]. An additional first coordinate of the points
/// selects the part of the mixture, so that both parts are as evenly spread as the points.
struct Proposal {
  static constexpr double uniform_share = 0.125; ///< Probability of the uniform part.

  std::shared_ptr<const AdaptedDensity> density = {}; ///< p; null for uniform points.
  std::vector<double> control_coefficients = {};      ///< c of each output; empty for 0.

  /// Density q at x. `scratch` must have room for the coordinates of x.
  double density_at(std::span<const double> x, std::span<double> scratch) const {
    return density ? (1 - uniform_share) * std::min(density->density(x, scratch), 1e300) + uniform_share : 1.0;
  }
};

/// Recorded points of several sets, one set after the other.
struct Record {
  std::vector<double> points;  ///< Coordinates.
  std::vector<double> values;  ///< Values of the primary outputs, output by output for each point.
  std::vector<double> weights; ///< 1 / q of each point.
};

/// Recorded samples: points, values of the `primary` outputs, and weights 1 / q. A fixed half of them can be left out,
/// for a check by points that were not learned from.
struct Samples {
  enum class Half { both, first, second };

  const Record& record;   ///< Points, values and weights.
  int dim;                ///< Dimension.
  std::size_t primary;    ///< Number of outputs that count.
  Half half = Half::both; ///< Samples in use.

  /// Number of all samples.
  std::size_t size() const { return record.weights.size(); }
  /// Calls f(i) for every sample in use. The halves are alternate blocks of 64, each as evenly spread as its sequence.
  template <class F> void each(F&& f) const {
    constexpr std::size_t block = 64;
    const std::size_t step = half == Half::both ? 1 : 2;
    for (std::size_t b = half == Half::second ? 1 : 0; b * block < size(); b += step)
      for (std::size_t i = b * block; i < std::min((b + 1) * block, size()); ++i) f(i);
  }
  /// Largest size of a value of an output.
  double largest(std::size_t output) const {
    double most = 0;
    each([&](std::size_t i) { most = std::max(most, std::abs(value(i, output))); });
    return most;
  }
  /// Value of an output at sample i.
  double value(std::size_t i, std::size_t output) const { return record.values[i * primary + output]; }
  /// Coordinates of sample i.
  std::span<const double> point(std::size_t i) const {
    return {record.points.data() + i * static_cast<std::size_t>(dim), static_cast<std::size_t>(dim)};
  }
};

/// Recorded points of several proposals, as one sample of their mixture: the weight of a point is 1 / density of the
/// mixture, in which each proposal counts by its number of points (the balance heuristic, [Veach97]).
class MixtureRecord {
 public:
  static constexpr std::size_t most = std::size_t{1} << 16; ///< Points; more of them start an empty record.

  /// Adds points of `dim` coordinates that were drawn through a proposal.
  void add(const Record& record, const Proposal& proposal, int dim);
  /// All points that are kept.
  const Record& record() const { return all_; }

 private:
  struct Source {
    Proposal proposal;
    double count; // of its points
  };

  std::vector<Source> sources_;
  Record all_;
  std::vector<double> densities_; // sum of count * density over the sources, at each point
};

/// Adapts a density: moves the edges of its grid so that the density follows the root of the mean of f^2 along each
/// axis, and grows a tree within the grid if asked for. Several outputs count equally.
AdaptedDensity adapted(const AdaptedDensity& from, const Samples& samples, bool tree);

/// Variance of a single value of each primary output through a proposal, estimated from the samples.
std::vector<double> variances(const Proposal& proposal, const Samples& samples);

} // namespace mc::detail

#pragma once
/// Learning of a density from the rounds of a run.

#include <mc/estimate/adapt/adapted_density.h>
#include <mc/estimate/integrate/integration_run.h>

#include <span>
#include <vector>

namespace mc::detail {

/// All points of a run so far and the density that follows from them. Each point has the weight of the mixture of all
/// densities that could have drawn it. No point is forgotten, and no rare point has too much weight.
///   Source : The balance heuristic [Veach97].
class DensityLearner {
 public:
  /// Learner for the integrand and settings of `run`; starts with the uniform density.
  explicit DensityLearner(const IntegrationRun& run);

  /// Adds a round of recorded points, drawn from density(). Then adapts the grid and, from the second round on, the
  /// tree within it.
  void learn(const std::vector<Sums>& round);

  /// Density to draw the next round from.
  const AdaptedDensity& density() const { return density_; }
  /// Replaces the density. The next round must be drawn from it, and learning continues from it.
  void set_density(AdaptedDensity density) { density_ = std::move(density); }
  /// Whether a density given by the caller can be used unchanged. Requires a round of uniform points and a round drawn
  /// from that density. The density does not fit in two cases:
  ///   - Its variance is not tiny, and fewer than eight points of the shortest run that can converge dominate it. A
  ///     density that is far too low somewhere behaves like this, and replicates that all missed that place would
  ///     agree.
  ///   - Its variance is large, and density(), which continued learning from it, has less than half of its variance. If
  ///     the given density has no tree, density() counts without its tree.
  bool fits(const AdaptedDensity& density) const;
  /// Logarithm of mean square over squared mean of the values under the density before the last round, for the output
  /// where it is largest. For log-normal values this is the variance of their logarithm.
  double log_second_moment() const { return log_second_moment_; }

 private:
  struct DensityRound {
    double points;
    AdaptedDensity density;
  };

  std::size_t size() const { return mixture_.size(); }
  std::span<const double> point(std::size_t i) const { return {points_.data() + i * dim_, dim_}; }
  template <class F> void for_each_point(F&& f) const;
  void add_densities_of_round();
  void measure();
  std::vector<double> variance_contributions(std::size_t output, const AdaptedDensity& p) const;
  WeightedSamples samples_in_grid_coordinates() const;
  void adapt_grid();
  void adapt_tree();

  const IntegrationRun& run_;
  std::size_t dim_;
  AdaptedDensity density_;
  std::vector<DensityRound> rounds_;
  std::vector<double> points_, values_;
  std::vector<double> mixture_; // for each point, sum over rounds of (density x number of points)
  std::vector<double> scale_;   // for each output
  double log_second_moment_ = 0;
};

} // namespace mc::detail

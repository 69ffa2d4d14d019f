#pragma once
/// What the rounds of a run teach of where the integrand is.

#include <mc/estimate/adapt/adapted_density.h>
#include <mc/estimate/integrate/integration_run.h>

#include <span>
#include <vector>

namespace mc::detail {

/// Everything that was seen so far, each point weighed by all the densities that might have drawn it, so that nothing
/// is forgotten and no rare point counts too much; and the density that follows from it.
///   Source : the balance heuristic [Veach97]
class DensityLearner {
 public:
  explicit DensityLearner(const IntegrationRun& run);

  /// Takes in a round that was recorded, its points drawn from density(), and adapts that: the grid, and from the
  /// second round on the tree within it.
  void learn(const std::vector<Sums>& round);

  const AdaptedDensity& density() const { return density_; }
  /// Goes on from this density: the next round is drawn from it.
  void set_density(AdaptedDensity density) { density_ = std::move(density); }
  /// Whether a density that the caller gave may be used as it is. Asked after a round of uniform points and one drawn
  /// from that density. It does not fit
  ///   - where its variance is not tiny and comes from few points: from fewer than eight in the shortest run that may
  ///     converge. That is how a density looks that is far too low somewhere; replicates that all missed the place
  ///     agree
  ///   - where its variance is large, and density(), which went on learning from it, has less than half of that. If the
  ///     given one has no tree, density() is judged without its own
  bool fits(const AdaptedDensity& density) const;
  /// The logarithm of the mean square over the squared mean of the values under the density before the last round: the
  /// variance of their logarithm, were they log-normal. Of the widest output.
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
  std::vector<double> mixture_; // of each point, the density of all rounds times their points
  std::vector<double> scale_;   // of each output
  double log_second_moment_ = 0;
};

} // namespace mc::detail

#pragma once
/// Importance sampling by a tree of boxes, learned from an integrand that is no product over the axes.

#include <mc/table/box_tree.h>

#include <cstddef>
#include <span>
#include <vector>

namespace mc {

/// Samples of an integrand: points of [0,1)^dim, values and weights. The weight is the volume that a point represents:
/// 1 / (number of points x density of the point).
struct WeightedSamples {
  int dim = 0;                ///< Number of dimensions.
  std::vector<double> points; ///< Coordinates, point after point.
  std::vector<double> values, ///< One value for each point.
      weights;                ///< One weight for each point.

  /// Number of samples.
  std::size_t size() const { return values.size(); }
  /// Coordinates of point i.
  std::span<const double> point(std::size_t i) const {
    return {points.data() + i * static_cast<std::size_t>(dim), static_cast<std::size_t>(dim)};
  }
};

/// Learns boxes for stratified importance sampling of an integrand.
///   weights : The probability of a box is proportional to its volume times the root of (variance + 1/4 squared mean)
///             in it. This is optimal for points that are evenly spread over the probabilities.
///   uniform : A tenth of the probability is uniform over the cube. A fiftieth is uniform over each box that is cut,
///             because the neighbourhood of a peak may belong to it.
///   cuts    : Half of the points proposes the cut of largest gain, and the other half must confirm it. Each box
///             contains at least 16 points of each half.
///   Source  : Recursive stratification as in miser [PressFarrar90], with densities.
BoxTree importance_tree(const WeightedSamples& samples);

} // namespace mc

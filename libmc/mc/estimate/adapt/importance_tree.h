#pragma once
/// Importance sampling learned from the integrand that is no product of axes: a tree of boxes.

#include <mc/table/box_tree.h>

#include <cstddef>
#include <span>
#include <vector>

namespace mc {

/// What was seen of an integrand: points of [0,1)^dim, its value at each, and how much of the volume the point stands
/// for: 1 / (number of points x density that they were drawn from).
struct WeightedSamples {
  int dim = 0;
  std::vector<double> points; ///< one after the other
  std::vector<double> values, weights;

  std::size_t size() const { return values.size(); }
  std::span<const double> point(std::size_t i) const {
    return {points.data() + i * static_cast<std::size_t>(dim), static_cast<std::size_t>(dim)};
  }
};

/// Boxes for stratified importance sampling of an integrand: the probability of each is proportional to its volume
/// times the root of the variance in it and a quarter of the squared mean, which is best for points that are spread
/// evenly over the probabilities; a tenth stays uniform, and a fiftieth in every box that is cut, since what lies
/// beside a peak may belong to it. A box is cut where one half of its points promises most, if the other half confirms
/// it; no box has less than 16 points of each.
///   Source : recursive stratification as in miser [PressFarrar90], with densities
BoxTree importance_tree(const WeightedSamples& samples);

} // namespace mc

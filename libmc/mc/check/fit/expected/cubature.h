#pragma once
/// Adaptive cubature over boxes, with error bounds that the goodness-of-fit tests use.

#include <mc/check/fit/expected/partition.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace mc {

/// Result of integrate_boxes.
struct CubatureResult {
  struct Integral {
    double value = 0, error = 0;
  };
  std::vector<Integral> boxes; ///< one per box, in the order of the boxes
  Integral total;              ///< sum of the errors: a bound even if all errors have the same sign
  std::size_t evaluations = 0;
  bool converged = true; ///< every box and the total reached their goals within the budget
  /// The first point where f is negative or not finite; refinement stops there.
  std::optional<PerAxis<double>> invalid_point;
};

/// Required accuracy and budget.
struct CubatureGoal {
  double total_error = 1e-8;                     ///< absolute error of the sum over all boxes
  std::function<double(double value)> box_error; ///< absolute error of a box of this value; empty: total_error
  std::size_t max_evaluations = 4'000'000;
};

/// Largest dimension of a cubature: the points of a tensor rule grow exponentially with it.
inline constexpr int max_cubature_dim = 3;

/// Returns the integrals of a non-negative f over boxes of the unit cube, of dimension at most max_cubature_dim.
///   rule   : tensor Clenshaw-Curtis of 9 points per axis; 5 in three dimensions if f is not smooth. Boxes are halved
///            across the axis with the largest difference between nested rules. The rule samples the faces of the box,
///            so a discontinuity cannot hide between the outermost nodes and the face.
///   error  : the sum of the absolute hierarchical surpluses of the finest nodes, reduced only if two levels show
///            geometric convergence. No rule that only evaluates f can be rigorous: it ignores a lobe that lies between
///            all nodes. Cut the boxes where mass is expected; check_subject uses its pilot for this. Tests check the
///            bound for smooth, singular, discontinuous and piecewise constant f, and for random products.
///   Source : [ClenshawCurtis60]; global adaptivity as in [GenzMalik80].
CubatureResult integrate_boxes(const std::function<double(const PerAxis<double>&)>& f, int dim,
                               const std::vector<UnitBox>& boxes, const CubatureGoal& goal = {});
/// A function that is evaluated at many points at once. It may move the points.
using BatchFunction = std::function<void(std::span<PerAxis<double>> v, std::span<double> values)>;
CubatureResult integrate_boxes(const BatchFunction& f, int dim, const std::vector<UnitBox>& boxes,
                               const CubatureGoal& goal = {});

} // namespace mc

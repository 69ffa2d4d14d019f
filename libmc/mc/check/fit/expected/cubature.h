#pragma once
/// Adaptive cubature over boxes, with error bounds that the tests of goodness of fit take into account.

#include <mc/check/fit/expected/partition.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace mc {

struct CubatureResult {
  struct Integral {
    double value = 0, error = 0;
  };
  std::vector<Integral> boxes; ///< one per box asked for
  Integral total;              ///< errors added up, so a bound also when they all point the same way
  std::size_t evaluations = 0;
  bool converged = true; ///< every box and the total met their goals within the budget
  /// The first point where f was negative or not finite; nothing is refined after it.
  std::optional<std::array<double, 3>> invalid_point;
};

struct CubatureGoal {
  double total_error = 1e-8;                     ///< absolute, for the sum over all boxes
  std::function<double(double value)> box_error; ///< absolute, for one box of this value; empty: total_error
  std::size_t max_evaluations = 4'000'000;
};

/// Integrals of a non-negative f over each of the boxes of the unit cube of dimension 1, 2 or 3.
///   rule  : tensor Clenshaw-Curtis of 9 points per axis (5 in three dimensions where f is not smooth); boxes are
///           halved across the axis that disagrees most between nested rules. The rule samples the faces of the box, so
///           a discontinuity cannot hide between the outermost nodes and the face.
///   error : the hierarchical surpluses of the finest nodes in absolute value, reduced only where two levels of them
///           show geometric convergence. No rule that only evaluates f can be rigorous: a lobe that all nodes miss is
///           not seen, so cut the boxes where mass is known to be (check_subject does, by its pilot). In the tests the
///           true error is within the bound for smooth, singular, discontinuous and piecewise constant f, and for 300
///           products of random factors.
///   Source : [ClenshawCurtis60]; global adaptivity as in [GenzMalik80]
CubatureResult integrate_boxes(const std::function<double(const std::array<double, 3>&)>& f, int dim,
                               const std::vector<UnitBox>& boxes, const CubatureGoal& goal = {});
/// The same of an f that is evaluated at many points at once. It may move them.
using BatchFunction = std::function<void(std::span<std::array<double, 3>> v, std::span<double> values)>;
CubatureResult integrate_boxes(const BatchFunction& f, int dim, const std::vector<UnitBox>& boxes,
                               const CubatureGoal& goal = {});

} // namespace mc

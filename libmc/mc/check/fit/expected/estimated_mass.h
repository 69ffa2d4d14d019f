#pragma once
/// Integrals of a density over boxes, found by evaluating it at random points: an estimate with an error that is known
/// whatever the density does between them.

#include <mc/check/fit/expected/partition.h>
#include <mc/check/subject/subject.h>
#include <mc/random/pcg.h>

#include <span>
#include <vector>

namespace mc {

/// An integral estimated by two random pairs of points in each of many boxes.
struct EstimatedMass {
  double value = 0;
  double variance = 0;        ///< of value, as the two pairs of each box show it
  double variance_square = 0; ///< sum of the squares of the variances added up, for their degrees of freedom
  double largest = 0;         ///< of one box
  double jump = 0; ///< by which the points of one box are farthest from linear, in it and the cells beside it
  /// The variance with its own uncertainty: three standard deviations above the estimate.
  double conservative_variance() const;
  /// And the square of what one box may hide, whatever its points show.
  double worst_case_variance() const { return conservative_variance() + largest * largest; }
  /// And what the largest jump may hide from all points of a box: one that no pair here sees is seen beside it. The
  /// masses, of so many passes over the boxes, are means.
  double variance_with_jumps(std::size_t passes = 1) const;
  /// Adds a part of a box, by its volume and the density at its four points: a point, its mirror image, and so again.
  void add_part(double volume, std::span<const double, 4> density);
};

/// The variance of what a jump of height 1 hides from n points of a box of volume 1: where it cuts a random part f off,
/// E f^2 (1 - f)^n = 2 / ((n + 1) (n + 2) (n + 3)). Sixteen times that is conceded, and at most 1: what is hidden is
/// seldom and much, so that four of its deviations must look like one.
double hidden_jump_variance(double points);

/// Whether the parts of a box that is cut at a place are boxes, and so wide that rounded samples meet them as random
/// points do; beside : a sample nearby.
bool may_split(const Subject& subject, const UnitBox& box, std::size_t axis, double place,
               const Subject::Coordinates& beside);

/// Its volume in the cube.
double volume(const UnitBox& box, int dim);
/// Uniform in the box.
Subject::Coordinates random_point(const UnitBox& box, int dim, Pcg& random);
/// The image of v through the middle of the box.
Subject::Coordinates mirrored(const Subject::Coordinates& v, const UnitBox& box, int dim);

/// Random points in boxes: two in each part of a box, each with its mirror image through the middle. The mean over such
/// a pair is exact where the density is linear.
struct AntitheticPoints {
  std::vector<Subject::Coordinates> points; ///< four to a part, as EstimatedMass::add_part takes them
  std::vector<double> volumes;              ///< of the parts
  std::array<std::vector<double>, 3> ends{{{0, 1}, {0, 1}, {0, 1}}}; ///< of the parts along the axes of the last box
  /// The box is cut at the breaks inside, and evenly between them until there are `per_axis` parts along each axis.
  void add(const UnitBox& box, int dim, const std::array<std::vector<double>, 3>& breaks, std::size_t per_axis,
           Pcg& random);
};

/// What the points of a box saw: the largest density, and the largest volume that one of them stood for.
struct BoxMaxima {
  double density = 0, volume = 0;
};

/// Adds the integral of the density over a box, cut at the breaks of the subject and evenly into at least `per_axis`
/// parts along each axis.
BoxMaxima add_box(const Subject& subject, const UnitBox& box, std::size_t per_axis, Pcg& random, EstimatedMass& mass);

/// How far the points of boxes are from one linear function over all of them.
class LinearFit {
 public:
  explicit LinearFit(std::size_t dim) : dim_(dim) {}

  /// Points, each followed by its mirror image; part : the volume that one stands for.
  void add(const Subject::Coordinates& v, double density, double part);
  /// The largest that a difference is off after the least squares fit of a slope; begins anew.
  double largest_residual();

 private:
  using Difference = std::array<double, 4>; ///< of mirrored points along the axes, then of their densities

  std::size_t dim_;
  bool half_ = false;                    ///< a point waits for its mirror image
  std::vector<Difference> differences_;  ///< times the size of their box
  std::array<Difference, 3> products_{}; ///< sums of products of one along an axis with all
};

} // namespace mc

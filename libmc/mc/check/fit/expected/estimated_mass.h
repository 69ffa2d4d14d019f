#pragma once
/// Integrals of a density over boxes from random points. The error estimate is valid for any density, smooth or not.

#include <mc/check/fit/expected/partition.h>
#include <mc/check/subject/subject.h>
#include <mc/random/pcg.h>

#include <span>
#include <vector>

namespace mc {

/// An integral estimated with two random pairs of points in each of many boxes.
struct EstimatedMass {
  double value = 0;
  double variance = 0;        ///< variance of value, from the two pairs of each box
  double variance_square = 0; ///< sum of the squares of the added variances, for their degrees of freedom
  double largest = 0;         ///< largest contribution of one box
  double jump = 0; ///< largest deviation from linearity of the points of one box, in it and in neighbouring cells
  /// Returns the variance plus three standard deviations of its own estimate.
  double conservative_variance() const;
  /// Returns the conservative variance plus the square of the largest box, the mass that one box may hide.
  double worst_case_variance() const { return conservative_variance() + largest * largest; }
  /// Returns the conservative variance plus a bound for jumps that all points of a box miss. The bound assumes that
  /// `jump`, from neighbouring boxes, is the height. The masses are means of `passes` passes over the boxes.
  double variance_with_jumps(std::size_t passes = 1) const;
  /// Adds a part of a box, with its volume and the densities at its four points: two pairs of a point and its mirror
  /// image.
  void add_part(double volume, std::span<const double, 4> density);
};

/// Returns 16 times the variance that a jump of height 1 hides from n points of a box of volume 1, at most 1. A jump
/// that cuts off a random fraction f of the box has the hidden variance E f^2 (1 - f)^n = 2 / ((n + 1) (n + 2) (n +
/// 3)). Hidden mass is rare but large; the factor makes four standard deviations cover one occurrence.
double hidden_jump_variance(double points);

/// Whether a box may be cut at `place`: both parts must be nonempty and so wide that rounded samples fall into them
/// like random points.
///   beside : a sample nearby.
bool may_split(const Subject& subject, const UnitBox& box, std::size_t axis, double place,
               const Subject::Coordinates& beside);

/// Returns the volume in the cube.
double volume(const UnitBox& box, int dim);
/// Returns a uniform point in the box.
Subject::Coordinates random_point(const UnitBox& box, int dim, Pcg& random);
/// Returns the mirror image of v through the centre of the box.
Subject::Coordinates mirrored(const Subject::Coordinates& v, const UnitBox& box, int dim);

/// Random points in boxes: two in each part of a box, each with its mirror image through the centre. The mean over such
/// a pair is exact for a linear density.
struct AntitheticPoints {
  std::vector<Subject::Coordinates> points; ///< four per part, in the order of EstimatedMass::add_part
  std::vector<double> volumes;              ///< volumes of the parts
  /// Ends of the parts along each axis of the last box.
  PerAxis<std::vector<double>> ends;
  /// Cuts the box at the breaks inside, and evenly between them into at least `per_axis` parts along each axis. Adds
  /// the points of all parts.
  void add(const UnitBox& box, int dim, const PerAxis<std::vector<double>>& breaks, std::size_t per_axis, Pcg& random);
};

/// Largest density at the points of a box, and largest volume that one point represents.
struct BoxMaxima {
  double density = 0, volume = 0;
};

/// Adds the integral of the density over a box to `mass`. The box is cut at the breaks of the subject, and evenly
/// between them into at least `per_axis` parts along each axis.
BoxMaxima add_box(const Subject& subject, const UnitBox& box, std::size_t per_axis, Pcg& random, EstimatedMass& mass);

/// Deviation of the points of several boxes from a common linear function.
class LinearFit {
 public:
  explicit LinearFit(std::size_t dim) : dim_(dim) {}

  /// Adds a point; each point is followed by its mirror image.
  ///   part : the volume that one point represents.
  void add(const Subject::Coordinates& v, double density, double part);
  /// Returns the largest residual of a difference after the least-squares fit of a slope, and resets the fit.
  double largest_residual();

 private:
  /// Difference of mirrored points along the axes, then of their densities.
  using Difference = std::array<double, max_chart_dim + 1>;

  std::size_t dim_;
  bool half_ = false;                   ///< whether a point waits for its mirror image
  std::vector<Difference> differences_; ///< scaled with the volume of their box
  PerAxis<Difference> products_{};      ///< sums of products of the component along an axis with all components
};

} // namespace mc

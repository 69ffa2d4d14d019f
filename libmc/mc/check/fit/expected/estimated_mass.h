#pragma once
/// Integrals of a density over boxes, found by evaluating it at random points: an estimate with an error that is known
/// whatever the density does between them.

#include <mc/check/fit/expected/partition.h>
#include <mc/check/subject/subject.h>
#include <mc/core/types.h>
#include <mc/random/pcg.h>

#include <algorithm>
#include <cmath>
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
  double shown_variance() const;
  /// And the square of what one box may hide, whatever its points show.
  double safe_variance() const { return shown_variance() + largest * largest; }
  /// And that of the largest jump: one that no pair here sees is seen beside it.
  double variance_with_jumps() const { return shown_variance() + jump * jump; }
};

/// The claimed density at v, moved off the faces of the cube by 2^-60 at 0 and by 2^-53 at 1, where charts of infinite
/// domains have no point.
double density_inside(const Subject& subject, Subject::Coordinates v);

/// Its volume in the cube.
double volume(const UnitBox& box, int dim);
/// Uniform in the box.
Subject::Coordinates random_point(const UnitBox& box, int dim, Pcg& random);
/// The image of v through the middle of the box.
Subject::Coordinates mirrored(const Subject::Coordinates& v, const UnitBox& box, int dim);
/// Where an axis of a box is cut: at the breaks inside, and evenly between them until there are `least` intervals.
std::vector<double> cut_axis(double lo, double hi, const std::vector<double>& breaks, std::size_t least);

/// Two random points in each part of a box, each with its mirror image through the middle: the mean over such a pair is
/// exact where the density is linear. f(v, volume) returns several densities at v, a point that stands for that volume;
/// each is integrated.
template <std::size_t N, class F>
void add_pairs(const UnitBox& whole, int dim, const std::array<std::vector<double>, 3>& breaks, std::size_t per_axis,
               Pcg& random, F&& f, const std::array<EstimatedMass*, N>& masses) {
  std::array<std::vector<double>, 3> ends{{{0, 1}, {0, 1}, {0, 1}}};
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
    ends[d] = cut_axis(whole.lo[d], whole.hi[d], breaks[d], per_axis);
  for (std::size_t i = 0; i + 1 < ends[0].size(); ++i)
    for (std::size_t j = 0; j + 1 < ends[1].size(); ++j)
      for (std::size_t k = 0; k + 1 < ends[2].size(); ++k) {
        const UnitBox box{{ends[0][i], ends[1][j], ends[2][k]}, {ends[0][i + 1], ends[1][j + 1], ends[2][k + 1]}};
        const double size = volume(box, dim);
        std::array<std::array<double, N>, 2> pairs{};
        for (std::array<double, N>& pair : pairs) {
          const Subject::Coordinates v = random_point(box, dim, random);
          const std::array<double, N> a = f(v, size / 4), b = f(mirrored(v, box, dim), size / 4);
          for (std::size_t m = 0; m < N; ++m) pair[m] = 0.5 * (a[m] + b[m]);
        }
        for (std::size_t m = 0; m < N; ++m) {
          const double off = size * (pairs[0][m] - pairs[1][m]), variance = sqr(0.5 * off);
          masses[m]->value += 0.5 * size * (pairs[0][m] + pairs[1][m]);
          masses[m]->variance += variance;
          masses[m]->variance_square += sqr(variance);
          masses[m]->largest = std::max(masses[m]->largest, 0.5 * size * (pairs[0][m] + pairs[1][m]));
          masses[m]->jump = std::max(masses[m]->jump, std::abs(off));
        }
      }
}

/// What the points of a box saw: the largest density, and the largest volume that one of them stood for.
struct Seen {
  double density = 0, volume = 0;
};

/// Adds the integral of the density over a box, cut at the breaks of the subject and evenly into at least `per_axis`
/// parts along each axis.
Seen add_box(const Subject& subject, const UnitBox& box, std::size_t per_axis, Pcg& random, EstimatedMass& mass);

/// How far the points of boxes are from one linear function over all of them.
class LinearFit {
 public:
  explicit LinearFit(std::size_t dim) : dim_(dim) {}

  /// Points in the order of add_pairs, each followed by its mirror image.
  void add(const Subject::Coordinates& v, double density, double part);
  /// The largest that a difference is off after the least squares fit of a slope; begins anew.
  double largest_residual();

 private:
  std::size_t dim_, points_ = 0;
  std::vector<std::array<double, 4>> differences_; ///< of mirrored points, times the size of their box
};

} // namespace mc

#pragma once
/// What the claimed density says of cells, found by evaluating it at random points: an estimate with an error that is
/// known whatever the density does between them.

#include <mc/check/fit/expected/partition.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/subject/subject.h>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace mc {

/// An integral estimated by two random points in each of many boxes.
struct EstimatedMass {
  double value = 0;
  double variance = 0;        ///< of value, as the differences of the pairs show it
  double variance_square = 0; ///< sum of the squares of the variances added up, for their degrees of freedom
  double largest = 0;         ///< what one pair may contribute: a jump that passes between no pair moves value so far
  /// The variance with its own uncertainty: three standard deviations above the estimate.
  double shown_variance() const;
  /// And the square of the largest pair: what they do not show.
  double safe_variance() const { return shown_variance() + largest * largest; }
};

/// The integral of the density over boxes, each cut at the breaks of the subject and evenly into at least `per_axis`
/// parts along each axis.
EstimatedMass estimate_mass(const Subject& subject, const std::vector<UnitBox>& boxes, std::size_t per_axis,
                            std::uint64_t seed);

/// The cube in strata, each with a cap on the density.
///   strata : the cells of a partition, cut on until each holds few points of the pilot, and around pilot points whose
///            density says that the pilot belongs into a smaller box: a lobe of any sharpness is looked at where it is
///   cap    : 16 times the density of the pilot in a stratum, or 4 times the smaller of two densities seen there. What
///            exceeds the cap could hide between the points, so it is left out on both sides: the density counts as
///            min(pdf, cap), and a sample as min(1, cap / pdf), which has the same mean. No point and no sample then
///            weighs much, and both sums have errors that their own values show
///   Source : truncated importance weights [Ionides08]; stratified sampling with two points each [Cochran77]
class Reference {
 public:
  Reference(const Subject& subject, const Partition& cells, const Pilot& pilot, std::uint64_t seed);

  /// The stratum of a point.
  struct Place {
    std::uint32_t cell = 0;
    std::uint32_t stratum = 0;
    double cap = 0;
    double density = 0; ///< mean density of the pilot in the stratum
    /// What a sample counts where the claimed density is `claimed`: 1 nearly always.
    double weight(double claimed) const { return claimed > cap ? cap / claimed : 1.0; }
  };
  const Place& place(const Subject::Coordinates& v) const {
    const Node* node = &nodes_[static_cast<std::size_t>(cells_.cell(v))];
    while (node->axis >= 0) node = &nodes_[node->index + (v[static_cast<std::size_t>(node->axis)] >= node->at)];
    return places_[node->index];
  }
  /// Those of many points at once, which is faster: no descent waits for another.
  std::vector<const Place*> places(std::span<const Subject::Coordinates> points) const;

  struct Goal {
    double samples = 1e6;        ///< that will be counted: the variance need not be far below that of their counts
    std::size_t least = 1 << 15; ///< points
    std::size_t most = 1 << 22;
  };
  /// Called with each point, its density and its share of the integral; shares add up to the integral times the passes.
  using Visit = std::function<void(const Subject::Coordinates& v, const Place& place, double density, double share)>;

  struct Masses {
    std::vector<EstimatedMass> cells; ///< integrals of min(pdf, cap)
    EstimatedMass total;
    std::size_t evaluations = 0, passes = 0;
    std::vector<double> volumes; ///< by stratum: the largest that one random point of one pass stands for
    /// What a random point would say to Visit where the claimed density is `claimed`.
    double share(const Place& place, double claimed) const {
      return std::min(claimed, place.cap) * volumes[place.stratum];
    }
    std::optional<Subject::Coordinates> bad; ///< first point where the density was negative or not finite
  };
  Masses integrate(const Subject& subject, const Goal& goal, std::uint64_t seed, const Visit& visit = {}) const;

  std::size_t strata() const { return places_.size(); }

 private:
  struct Node {
    double at = 0;
    int axis = -1;           ///< -1: a stratum
    std::uint32_t index = 0; ///< of the lower child (the upper follows), or of the stratum
  };
  struct Builder;

  const Partition& cells_;
  int dim_;
  std::vector<Node> nodes_;    ///< the roots of all cells first
  std::vector<UnitBox> boxes_; ///< of the strata
  std::vector<Place> places_;
};

/// The claimed density at v, moved off the faces of the cube by 2^-60 at 0 and by 2^-53 at 1, where charts of infinite
/// domains have no point.
double density_inside(const Subject& subject, Subject::Coordinates v);

} // namespace mc

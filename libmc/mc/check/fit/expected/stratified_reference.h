#pragma once
/// What the claimed density says of cells, found by evaluating it at random points: an estimate with an error that is
/// known whatever the density does between them.

#include <mc/check/fit/expected/estimated_mass.h>
#include <mc/check/fit/expected/partition.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/subject/subject.h>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace mc {

/// The cells of a pilot, and in which each of its points lies.
struct PilotCells {
  Partition partition;
  std::vector<std::uint32_t> cell_of_point;
  /// Cells are as wide as rounding leaves them.
  PilotCells(const Subject& subject, const Pilot& pilot, int depth);
  /// The share of all samples that rounding by a step may carry into each cell, or out of it: what lies within two
  /// steps of its faces, halved. 0 but for lobes of few steps.
  std::vector<double> rounding_shares(const Subject& subject, const Pilot& pilot) const;
};

/// The cube in strata, each with a cap on the density.
///   strata : the cells of a partition, cut on until each holds few points of the pilot, and around pilot points whose
///            density says that the pilot belongs into a smaller box: a lobe of any sharpness is looked at where it is
///   cap    : 16 times the density of the pilot in a stratum, or 4 times the smaller of two densities seen there. What
///            exceeds the cap could hide between the points, so it is left out on both sides: the density counts as
///            min(pdf, cap), and a sample as min(1, cap / pdf), which has the same mean. No point and no sample then
///            weighs much, and both sums have errors that their own values show
///   Source : truncated importance weights [Ionides08]; stratified sampling, with two mirrored pairs each [Cochran77]
class StratifiedReference {
 public:
  StratifiedReference(const Subject& subject, const Pilot& pilot, const PilotCells& cells, std::uint64_t seed);

  /// The stratum of a point.
  struct Stratum {
    std::uint32_t cell = 0;
    std::uint32_t index = 0;
    double cap = 0;
    double density = 0; ///< mean density of the pilot in the stratum; 0 where rounding places the samples
    double volume = 0;  ///< the largest that one random point stands for
    /// What a sample counts where the claimed density is `claimed`: 1 nearly always.
    double weight(double claimed) const { return claimed > cap ? cap / claimed : 1.0; }
    /// What a random point would say to PointVisitor where the claimed density is `claimed`.
    double share(double claimed) const { return std::min(claimed, cap) * volume; }
  };
  const Stratum& find_stratum(const Subject::Coordinates& v) const {
    const Node* node = &nodes_[guide_[bin(v)]];
    while (node->axis >= 0) node = &nodes_[node->index + (v[static_cast<std::size_t>(node->axis)] >= node->position)];
    return strata_[node->index];
  }
  /// Those of many points at once, which is faster: no descent waits for another.
  std::vector<const Stratum*> find_strata(std::span<const Subject::Coordinates> points) const;

  struct Goal {
    double samples = 1e6;             ///< that will be counted: the variance need not be far below that of their counts
    std::size_t min_points = 1 << 15; ///< points
    std::size_t max_points = 1 << 22;
  };
  /// A point with its share of the integral: the shares add up to the integral times the passes.
  struct EvaluatedPoint {
    Subject::Coordinates v;
    const Stratum* stratum;
    double density, share;
  };
  /// Called with all points, many at a time.
  using PointVisitor = std::function<void(std::span<const EvaluatedPoint> points)>;

  struct CellMasses {
    std::vector<EstimatedMass> cells; ///< integrals of min(pdf, cap)
    EstimatedMass total;
    EstimatedMass uncapped; ///< the integral of pdf itself, whatever exceeds the caps
    std::size_t evaluations = 0, passes = 0;
    std::optional<Subject::Coordinates> invalid_point; ///< first point where the density was negative or not finite
    void take_means(); ///< over the passes, whose sums the cells hold; adds up the total
  };
  CellMasses integrate(const Subject& subject, const Goal& goal, std::uint64_t seed, const PointVisitor& visit = {});

  std::size_t strata() const { return strata_.size(); }

 private:
  struct Node {
    double position = 0;
    int axis = -1;           ///< -1: a stratum
    std::uint32_t index = 0; ///< of the lower child (the upper follows), or of the stratum
  };
  struct Builder;
  struct Integration;
  using Bin = std::array<std::uint32_t, 3>;
  void add_cells(const Partition& cells, int split, std::size_t node, const UnitBox& box, Builder& builder);
  void fill_guide(std::size_t node, Bin lo, Bin hi);
  std::size_t bin(const Subject::Coordinates& v) const {
    std::size_t index = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(dim_); ++d) {
      const double scaled = v[d] * static_cast<double>(guide_size_), top = static_cast<double>(guide_size_ - 1);
      index = index * guide_size_ + static_cast<std::size_t>(static_cast<std::int64_t>(std::clamp(scaled, 0.0, top)));
    }
    return index;
  }

  int dim_;
  std::size_t cells_;
  std::vector<Node> nodes_;          ///< the root first
  std::vector<std::uint32_t> guide_; ///< by bins of a grid: the smallest node that holds all of the bin
  std::size_t guide_size_ = 1;       ///< bins along an axis
  std::vector<UnitBox> boxes_;       ///< of the strata
  std::vector<Stratum> strata_;
};

} // namespace mc

#pragma once
/// Expected counts of cells from evaluations of the claimed density at random points. The error estimate is valid for
/// any density, smooth or not.

#include <mc/check/fit/expected/estimated_mass.h>
#include <mc/check/fit/expected/partition.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/subject/subject.h>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace mc {

/// The cells of a pilot, and the cell of each pilot point.
struct PilotCells {
  Partition partition;
  std::vector<std::uint32_t> cell_of_point;
  /// Builds the cells; rounding limits their smallest width.
  PilotCells(const Subject& subject, const Pilot& pilot, int depth);
  /// Returns the fraction of all samples that rounding may move into or out of each cell. This is half of the samples
  /// within two rounding steps of its faces. 0 except for lobes of few steps.
  std::vector<double> rounding_shares(const Subject& subject, const Pilot& pilot) const;
};

/// A decomposition of the cube into strata, each with a cap on the density.
///   strata : the cells of a partition, cut further until each contains few pilot points. If the density at a pilot
///            point requires more points than the box contains, the box is cut around it. Lobes of any sharpness thus
///            get small strata.
///   cap    : 16 times the density of the pilot in a stratum, or 4 times the smaller of two sampled densities. Mass
///            above the cap could hide between the points, so both sides omit it: the density counts as min(pdf, cap),
///            a sample as min(1, cap / pdf), which has the same mean. No point and no sample then has a large weight,
///            and the error of each sum can be estimated from its terms.
///   Source : truncated importance weights [Ionides08]; stratified sampling, with two mirrored pairs each [Cochran77].
class StratifiedReference {
 public:
  StratifiedReference(const Subject& subject, const Pilot& pilot, const PilotCells& cells, std::uint64_t seed);

  /// A stratum of the cube.
  struct Stratum {
    std::uint32_t cell = 0;
    std::uint32_t index = 0;
    double cap = 0;
    /// Mean density of the pilot in the stratum; 0 if rounding determines the positions of the samples.
    double density = 0;
    double volume = 0; ///< largest volume that one random point represents
    /// Returns the weight of a sample for a claimed density; nearly always 1.
    double weight(double claimed) const { return claimed > cap ? cap / claimed : 1.0; }
    /// Returns the share that a random point would have in EvaluatedPoint, for a claimed density.
    double share(double claimed) const { return std::min(claimed, cap) * volume; }
  };
  const Stratum& find_stratum(const Subject::Coordinates& v) const {
    const Node* node = &nodes_[guide_[bin(v)]];
    while (node->axis >= 0) node = &nodes_[node->index + (v[static_cast<std::size_t>(node->axis)] >= node->position)];
    return strata_[node->index];
  }
  /// Returns the strata of many points. Faster than single calls, because the descents do not wait for each other.
  std::vector<const Stratum*> find_strata(std::span<const Subject::Coordinates> points) const;

  struct Goal {
    /// Number of samples to be counted; the variance need not be far below the variance of their counts.
    double samples = 1e6;
    std::size_t min_points = 1 << 15; ///< number of points
    std::size_t max_points = 1 << 22;
  };
  /// A point with its share of the integral. The shares add up to the integral times the number of passes.
  struct EvaluatedPoint {
    Subject::Coordinates v;
    const Stratum* stratum;
    double density, share;
  };
  /// Receives all points, in batches.
  using PointVisitor = std::function<void(std::span<const EvaluatedPoint> points)>;

  struct CellMasses {
    std::vector<EstimatedMass> cells; ///< integrals of min(pdf, cap)
    EstimatedMass total;
    EstimatedMass uncapped; ///< the integral of pdf itself, including mass above the caps
    std::size_t evaluations = 0, passes = 0;
    std::optional<Subject::Coordinates> invalid_point; ///< first point where the density is negative or not finite
    void take_means(); ///< divides the sums in the cells by the number of passes, and computes the total
  };
  CellMasses integrate(const Subject& subject, const Goal& goal, std::uint64_t seed, const PointVisitor& visit = {});

  std::size_t strata() const { return strata_.size(); }

 private:
  struct Node {
    double position = 0;
    int axis = -1;           ///< -1: a stratum
    std::uint32_t index = 0; ///< index of the lower child (the upper child follows), or of the stratum
  };
  struct Builder;
  struct Integration;
  using Bin = PerAxis<std::uint32_t>;
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
  std::vector<std::uint32_t> guide_; ///< for each bin of a grid, the smallest node that contains the whole bin
  std::size_t guide_size_ = 1;       ///< number of bins along an axis
  std::vector<UnitBox> boxes_;       ///< boxes of the strata
  std::vector<Stratum> strata_;
};

} // namespace mc

#pragma once
/// Bins adapted to a density.

#include <mc/check/subject/axis.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace mc {

/// An axis-parallel box of the unit cube, half open: lo <= v < hi (closed for hi = 1).
struct UnitBox {
  PerAxis<double> lo{}, hi = unit_corner;
};

/// A complete kd-tree over the unit cube. Its 2^depth cells contain about equal shares of a pilot sample, so a lobe of
/// any sharpness gets as fine a resolution as a cosine. Axes alternate between levels. Each split is the shortest
/// binary fraction between the pilot's 45 % and 55 % quantiles. The edges of tables, supports and branches are often
/// such fractions, and no cell then straddles them. Cells are numbered in tree order: the nodes of level k are the
/// aligned runs of 2^(depth - k) cells.
class Partition {
 public:
  using Coordinates = PerAxis<double>;

  /// Returns whether a box may be cut at a place on an axis; `beside` is a pilot point in the box.
  using MaySplit = std::function<bool(const UnitBox& box, std::size_t axis, double place, const Coordinates& beside)>;

  /// Builds the tree. The pilot must be independent of the samples that are counted later. If a box may not be cut
  /// along any axis, its lower half is the whole box and its upper half is empty.
  ///   may_split : allows every place if empty.
  Partition(std::vector<Coordinates> pilot, int dim, int depth, const MaySplit& may_split = {});

  int size() const { return 1 << depth_; }
  int depth() const { return depth_; }
  UnitBox box(int cell) const { return box(cell, depth_); }
  /// Returns the box of a run of cells: run i of 2^depth aligned runs.
  UnitBox box(int run, int depth) const;
  /// Returns the cells of many points. Faster than single calls, because the descents do not wait for each other.
  std::vector<std::uint32_t> find_cells(const std::vector<Coordinates>& points) const;
  int cell(const Coordinates& v) const {
    int node = 1;
    for (int level = 0; level < depth_; ++level) {
      const Split& s = splits_[static_cast<std::size_t>(node)];
      node = 2 * node + (v[s.axis] >= s.position);
    }
    return node - size();
  }

  /// The cut of an inner node. Nodes 1 .. size() - 1 are in heap order: the root is 1, the children of i are 2 i and 2
  /// i + 1. The cells follow as size() + cell.
  struct Split {
    double position; ///< `no_split` if the lower half is the whole box
    std::uint32_t axis;
  };
  static constexpr double no_split = 2;
  const Split& split(int node) const { return splits_[static_cast<std::size_t>(node)]; }
  /// Returns the two halves of a box.
  static std::array<UnitBox, 2> halves(const UnitBox& box, const Split& split);

 private:
  struct Builder;

  int dim_, depth_;
  std::vector<Split> splits_; ///< heap order, root at 1
};

/// Returns the binary fraction with the fewest digits in (a, b], for 0 <= a < b <= 1.
double shortest_binary_fraction(double a, double b);

} // namespace mc

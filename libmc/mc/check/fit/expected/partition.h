#pragma once
/// Bins adapted to a density.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace mc {

/// An axis-parallel box of the unit cube, half open: lo <= v < hi (closed where hi = 1).
struct UnitBox {
  std::array<double, 3> lo{0, 0, 0}, hi{1, 1, 1};
};

/// A complete kd-tree over the unit cube whose 2^depth cells hold about equal shares of a pilot sample, so that a lobe
/// of any sharpness gets as many cells as a cosine. Axes alternate from level to level. Each split is the shortest
/// binary fraction between the pilot's 45 % and 55 % quantiles: the edges of tables, supports and branches mostly lie
/// on such places, and then no cell straddles them.
///   Cells are numbered in tree order: the nodes of level k are the aligned runs of 2^(depth - k) cells.
class Partition {
 public:
  using Coordinates = std::array<double, 3>;

  /// Whether a box may be cut at a place on an axis, where `beside` is a point of the pilot in it.
  using MaySplit = std::function<bool(const UnitBox& box, std::size_t axis, double place, const Coordinates& beside)>;

  /// The pilot must be independent of the samples that are counted later. A box that may not be cut along any axis is
  /// all in the lower of its halves; the upper one is empty and begins where it ends. may_split : any place if empty
  Partition(std::vector<Coordinates> pilot, int dim, int depth, const MaySplit& may_split = {});

  int size() const { return 1 << depth_; }
  int depth() const { return depth_; }
  UnitBox box(int cell) const { return box(cell, depth_); }
  /// The box of a run of cells: run i of the 2^depth aligned ones.
  UnitBox box(int run, int depth) const;
  /// The cells of many points at once, which is faster: no descent waits for another.
  std::vector<std::uint32_t> find_cells(const std::vector<Coordinates>& points) const;
  int cell(const Coordinates& v) const {
    int node = 1;
    for (int level = 0; level < depth_; ++level) {
      const Split& s = splits_[static_cast<std::size_t>(node)];
      node = 2 * node + (v[s.axis] >= s.position);
    }
    return node - size();
  }

  /// Where an inner node is cut: node i of 1 .. size() - 1 in heap order, root 1, children 2 i and 2 i + 1; the cells
  /// follow as size() + cell.
  struct Split {
    double position; ///< `no_split` where all of the box is in the lower half
    std::uint32_t axis;
  };
  static constexpr double no_split = 2;
  const Split& split(int node) const { return splits_[static_cast<std::size_t>(node)]; }
  /// The two parts of a box that is split so.
  static std::array<UnitBox, 2> halves(const UnitBox& box, const Split& split);

 private:
  struct Builder;

  int dim_, depth_;
  std::vector<Split> splits_; ///< heap order, root at 1
};

/// The binary fraction with the fewest digits in (a, b], 0 <= a < b <= 1.
double shortest_binary_fraction(double a, double b);

} // namespace mc

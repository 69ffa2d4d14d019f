#pragma once
/// A partition of the unit cube into boxes, the structure behind TableDistTree.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mc {

/// A node of the kd-tree: a plane perpendicular to an axis, or a leaf.
struct BoxTreeNode {
  static constexpr std::uint32_t leaf = 0xffffffff; ///< Value of `axis` in a leaf.

  std::uint32_t axis = leaf; ///< Normal of the plane.
  double value = 1;          ///< Coordinate of the plane, or weight of the leaf.
};

/// A partition of the unit cube into boxes. Each box has a counterpart in u, a box of [0,1)^d with a volume equal to
/// its probability. The same planes cut both cubes, at different coordinates. In u, a plane splits its interval in
/// proportion to the weights on its two sides, within 2^-52. Each leaf of positive weight keeps at least 2^-53.
///   nodes  : in preorder: each plane is followed by its lower subtree, then by its upper subtree.
///   throws : Error for dim < 1, nodes that do not form one tree, an axis beyond dim, a plane outside of its box, a
///            weight that is not finite and >= 0, or all weights 0.
///   Source : a kd-tree [Bentley75] as a density.
class BoxTree {
 public:
  /// One side of a leaf: [u_lo, u_hi) is mapped to [x_lo, x_hi) along an axis.
  struct AxisExtent {
    std::uint32_t axis; ///< Axis of the side.
    double x_lo,        ///< Lower end in x.
        x_hi,           ///< Upper end in x.
        u_lo,           ///< Lower end of the preimage in u.
        u_hi;           ///< Upper end of the preimage in u.
  };

  /// Builds the partition from its nodes in preorder.
  explicit BoxTree(int dim, std::span<const BoxTreeNode> nodes);
  /// The whole cube as one box.
  explicit BoxTree(int dim) : BoxTree(dim, std::vector<BoxTreeNode>(1)) {}

  /// Partition into at most `leaves` boxes adapted to f. Repeatedly halves the box with the largest standard deviation
  /// of f over 32 points times its volume, unless rounding would show in its halves. The weight of a box is the mean of
  /// f over these points times the volume.
  ///   throws : Error if f is not finite and >= 0, or is 0 at all points evaluated.
  static BoxTree from_function(int dim, const std::function<double(std::span<const double>)>& f, std::size_t leaves);

  /// Number of dimensions.
  int dim() const { return dim_; }
  /// Number of leaves.
  std::size_t leaves() const { return density_.size(); }
  /// The nodes passed to the constructor.
  std::span<const BoxTreeNode> nodes() const { return nodes_; }

  /// Leaf of the point with coordinates u.
  template <class P> std::size_t leaf_of_u(const P& u) const {
    return find([&](const Split& s) { return u[s.axis] < s.u; });
  }
  /// Leaf of the point x.
  template <class P> std::size_t leaf_of_x(const P& x) const {
    return find([&](const Split& s) { return x[s.axis] < s.x; });
  }
  /// The sides of a leaf that were cut; along the other axes the leaf spans [0,1).
  std::span<const AxisExtent> extents(std::size_t leaf) const {
    return {extents_.data() + first_[leaf], first_[leaf + 1] - first_[leaf]};
  }
  /// Probability of a leaf divided by its volume.
  double density(std::size_t leaf) const { return density_[leaf]; }

  /// Maps u to x in place. Returns |dx/du| = 1 / density.
  double map(std::span<double> u) const;

 private:
  struct Split {
    std::uint32_t axis;
    std::uint32_t next[2]; // above, below: the index of a split, or the complement of the index of a leaf
    double u, x;
  };
  struct Builder;

  template <class Below> std::size_t find(Below&& below) const {
    std::uint32_t at = root_;
    while (!(at & 0x80000000)) at = splits_[at].next[below(splits_[at])];
    return ~at;
  }

  int dim_;
  std::uint32_t root_ = 0;
  std::vector<BoxTreeNode> nodes_;
  std::vector<Split> splits_;
  std::vector<AxisExtent> extents_; // extents of all leaves in sequence
  std::vector<std::size_t> first_;  // first entry in extents_ of each leaf, and the end
  std::vector<double> density_;
};

} // namespace mc

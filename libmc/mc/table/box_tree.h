#pragma once
/// The unit cube cut into boxes: what TableDistTree is a distribution on.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mc {

/// A plane across an axis, or a box that is not cut any more.
struct BoxTreeNode {
  static constexpr std::uint32_t leaf = 0xffffffff;

  std::uint32_t axis = leaf; ///< that the plane is at right angles to
  double value = 1;          ///< where the plane cuts it, or the weight of the leaf
};

/// Boxes of the unit cube and, for each, a box of u in [0,1)^d whose volume is its probability. Both are cut by the
/// same planes but for their places: in u a plane leaves to either side the share of its weight, within 2^-52 and 2^-53
/// for each leaf: as much is left to each whose weight is positive.
///   nodes  : in preorder: each plane is followed by all that lies below it, then by all that lies above
///   throws : Error for dim < 1, nodes that do not make one tree, an axis beyond dim, a plane outside of its box, a
///            weight that is not finite and >= 0, or all weights 0
///   Source : a kd-tree [Bentley75] as a density
class BoxTree {
 public:
  /// One side of a leaf: [x_lo, x_hi) along an axis, which [u_lo, u_hi) is mapped to.
  struct AxisExtent {
    std::uint32_t axis;
    double x_lo, x_hi, u_lo, u_hi;
  };

  explicit BoxTree(int dim, std::span<const BoxTreeNode> nodes);
  /// The whole cube as one box.
  explicit BoxTree(int dim) : BoxTree(dim, std::vector<BoxTreeNode>(1)) {}

  /// `leaves` boxes, halved again and again where f varies most, by its deviation over 32 places times the volume;
  /// their weights are the mean of f over these places times the volume.
  ///   throws : Error where f is not finite and >= 0, or 0 at all places it was asked
  static BoxTree from_function(int dim, const std::function<double(std::span<const double>)>& f, std::size_t leaves);

  int dim() const { return dim_; }
  std::size_t leaves() const { return density_.size(); }
  /// The nodes that it was made of.
  std::span<const BoxTreeNode> nodes() const { return nodes_; }

  /// The leaf of a point: by its coordinates u, or by x.
  template <class P> std::size_t leaf_of_u(const P& u) const {
    return find([&](const Split& s) { return u[s.axis] < s.u; });
  }
  template <class P> std::size_t leaf_of_x(const P& x) const {
    return find([&](const Split& s) { return x[s.axis] < s.x; });
  }
  /// The sides of a leaf that were cut; along the other axes it is [0,1).
  std::span<const AxisExtent> extents(std::size_t leaf) const {
    return {extents_.data() + first_[leaf], first_[leaf + 1] - first_[leaf]};
  }
  /// Probability of a leaf over its volume.
  double density(std::size_t leaf) const { return density_[leaf]; }

  /// Maps u to x, in place, and returns |dx/du| = 1 / density.
  double map(std::span<double> u) const;

 private:
  struct Split {
    std::uint32_t axis;
    std::uint32_t next[2]; // above, below: the index of a split, or the complement of that of a leaf
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
  std::vector<AxisExtent> extents_; // of all leaves, one after the other
  std::vector<std::size_t> first_;  // of each leaf's, and the end
  std::vector<double> density_;
};

} // namespace mc

#pragma once
/// A binary hierarchy of boxes.

#include <render/core/bounds.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace render {

/// A binary bounding volume hierarchy, split until a node has few enough boxes for a leaf.
///   build : binned SAH [Wald07] with 8 to 32 bins and costs counted in leaves of `lanes` boxes, followed by tree
///           rotations [Kensler08]. Uses all threads of the machine for many boxes. The result does not depend on the
///           number of threads.
class BinaryTree {
 public:
  /// A leaf or an inner node.
  struct Node {
    Bounds box;                         ///< Bounds of all boxes below the node.
    std::uint32_t first = 0, count = 0; ///< A leaf has count > 0 and consists of order()[first, first + count).
    std::uint32_t left = 0, right = 0;  ///< Children of an inner node.
    int depth = 0, height = 0;          ///< Number of levels above and below.
  };
  static constexpr int max_depth = 96; ///< Maximum number of nodes above a leaf, for any arrangement of the boxes.

  /// Builds the tree.
  ///   count : number of boxes, at least one.
  ///   box   : returns the bounds of a box; called from several threads.
  ///   lanes : maximum number of boxes in a leaf, a power of two.
  BinaryTree(std::size_t count, const std::function<Bounds(std::size_t)>& box, std::uint32_t lanes);

  /// All nodes, the root first.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Indices of the boxes; the boxes of a leaf are contiguous.
  std::vector<std::uint32_t>& order() { return order_; }
  /// All nodes, each before its children. The first list is the top of the tree; each further list is a subtree below
  /// it, which one thread can process.
  const std::vector<std::vector<std::uint32_t>>& parents_first() const { return parents_first_; }

 private:
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<std::vector<std::uint32_t>> parents_first_;
};

} // namespace render

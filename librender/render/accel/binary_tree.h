#pragma once
/// A binary hierarchy of boxes.

#include <render/core/bounds.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace render {

/// Halves, halved again until they are few enough for a leaf.
///   build : binned SAH [Wald07] with 8 to 32 bins, costs counted in leaves of `lanes` boxes, then rotated to smaller
///           boxes [Kensler08]. By all of the machine's threads where there are many boxes; the same for any number.
class BinaryTree {
 public:
  struct Node {
    Bounds box;
    std::uint32_t first = 0, count = 0; ///< count > 0: a leaf over order()[first, first + count)
    std::uint32_t left = 0, right = 0;  ///< children, of what is no leaf
    int depth = 0, height = 0;          ///< levels above and below
  };
  static constexpr int max_depth = 96; ///< no more than these are above a leaf, however the boxes lie

  /// count : at least one
  /// box   : of each, called by several threads
  /// lanes : a power of two
  BinaryTree(std::size_t count, const std::function<Bounds(std::size_t)>& box, std::uint32_t lanes);

  /// The root first.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// The boxes, those of a leaf together.
  std::vector<std::uint32_t>& order() { return order_; }
  /// All nodes, each before its children: first the top of the tree, and then trees below it, for a thread each.
  const std::vector<std::vector<std::uint32_t>>& parents_first() const { return parents_first_; }

 private:
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<std::vector<std::uint32_t>> parents_first_;
};

} // namespace render

#include <render/accel/wide_tree.h>

#include <algorithm>
#include <array>

namespace render {

WideTree::WideTree(std::size_t count, const std::function<Bounds(std::size_t)>& box, std::uint32_t lanes) {
  static_assert(stack_size >= 7 * BinaryTree::levels);
  if (count == 0) return;
  BinaryTree tree(count, box, lanes);
  bounds_ = tree.nodes()[0].box;
  collapse(tree, cheapest_cuts(tree), 0);
  order_ = std::move(tree.order());
  nodes_.shrink_to_fit();
  leaves_.shrink_to_fit();
}

// The node of eight children that a binary one becomes costs the chance that a ray meets it, its area: then those below
// it cost least when the two halves of what they stand for do, for the best share of the children between the halves.
WideTree::Cuts WideTree::cheapest_cuts(const BinaryTree& tree) {
  const auto& binary = tree.nodes();
  Cuts cuts(binary.size());
  // [children]; leaves cost nothing, since they are there however nodes are cut.
  std::vector<std::array<double, 9>> costs(binary.size());
  const auto order = tree.parents_first();
  for (auto it = order.rbegin(); it != order.rend(); ++it) {
    const std::uint32_t i = *it;
    if (binary[i].count > 0) continue;
    const auto &left = costs[binary[i].left], &right = costs[binary[i].right];
    auto& cost = costs[i];
    for (std::size_t children = 2; children <= 8; ++children) {
      std::size_t best = 1;
      for (std::size_t k = 2; k < children; ++k)
        if (left[k] + right[children - k] < left[best] + right[children - best]) best = k;
      cost[children] = left[best] + right[children - best];
      cuts[i][children - 1] = static_cast<std::uint8_t>(best);
    }
    cost[1] = double(binary[i].box.half_area()) + cost[8];
    for (std::size_t children = 2; children < 8; ++children)
      if (cost[1] < cost[children]) {
        cost[children] = cost[1];
        cuts[i][children - 1] = 0;
      }
  }
  return cuts;
}

std::uint32_t WideTree::collapse(const BinaryTree& tree, const Cuts& cuts, std::uint32_t root) {
  const auto& binary = tree.nodes();
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  std::array<std::uint32_t, 8> open{};
  std::size_t n = 0;
  const auto gather = [&](const auto& self, std::uint32_t from, std::size_t children) -> void {
    const std::size_t left = binary[from].count > 0 ? 0 : cuts[from][children - 1];
    if (left == 0) {
      open[n++] = from;
      return;
    }
    self(self, binary[from].left, left);
    self(self, binary[from].right, children - left);
  };
  gather(gather, root, 8);
  Node node;
  for (std::size_t i = 0; i < 8; ++i) {
    const Bounds box = i < n ? binary[open[i]].box : Bounds{}; // an empty box is never entered
    for (int a = 0; a < 3; ++a) {
      node.bounds[a][i] = box.lo[a];
      node.bounds[a + 3][i] = box.hi[a];
    }
    node.child[i] = leaf_bit;
    if (i >= n) continue;
    const BinaryTree::Node& child = binary[open[i]];
    if (child.count > 0) {
      node.child[i] = leaf_bit | static_cast<std::uint32_t>(leaves_.size());
      leaves_.push_back({child.first, child.count});
    } else {
      node.child[i] = collapse(tree, cuts, open[i]);
    }
  }
  nodes_[index] = node;
  return index;
}

} // namespace render

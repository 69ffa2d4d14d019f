#include <render/accel/wide_tree.h>

#include <mc/core/parallel.h>

#include <algorithm>
#include <array>

namespace render {

/// Nodes and leaves of a part of the tree. Indices count from the first node and leaf of the part.
struct WideTree::Part {
  std::vector<Node> nodes;
  std::vector<Leaf> leaves;
  struct Hanging {
    std::uint32_t root, node, child; ///< the binary node that will become child `child` of `node`
  };
  std::vector<Hanging> hanging;
};

WideTree::WideTree(std::size_t count, const std::function<Bounds(std::size_t)>& box, std::uint32_t lanes) {
  static_assert(stack_size >= 7 * BinaryTree::max_depth);
  if (count == 0) return;
  BinaryTree tree(count, box, lanes);
  bounds_ = tree.nodes()[0].box;
  const Cuts cuts = cheapest_cuts(tree);
  Part top;
  collapse(tree, cuts, 0, tree.parents_first()[0].size(), top);
  std::vector<Part> parts(top.hanging.size());
  mc::parallel_for(parts.size(), 0,
                   [&](std::size_t i) { collapse(tree, cuts, top.hanging[i].root, tree.nodes().size(), parts[i]); });
  join(top, parts);
  order_ = std::move(tree.order());
}

// Dynamic programming over the binary tree. A node costs its area, which is proportional to the probability that a ray
// hits it. costs[i][k] is the least cost of the subtree i when k children of a wide node replace it. The minimum is
// over all ways to split the k children between the two halves.
WideTree::Cuts WideTree::cheapest_cuts(const BinaryTree& tree) {
  const auto& binary = tree.nodes();
  Cuts cuts(binary.size());
  std::vector<std::array<double, 9>, HugePageAllocator<std::array<double, 9>>> costs(binary.size()); // [children]
  const auto cut = [&](std::uint32_t i) {
    auto& cost = costs[i];
    if (binary[i].count > 0) {
      cost.fill(0); // leaves cost the same for every cut
      return;
    }
    const auto &left = costs[binary[i].left], &right = costs[binary[i].right];
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
  };
  const auto& lists = tree.parents_first();
  const auto cut_all = [&](const std::vector<std::uint32_t>& list) { std::for_each(list.rbegin(), list.rend(), cut); };
  mc::parallel_for(lists.size() - 1, 0, [&](std::size_t i) { cut_all(lists[i + 1]); });
  cut_all(lists[0]);
  return cuts;
}

// Leaves binary nodes from `limit` on, other than `root`, in part.hanging instead of entering them.
std::uint32_t WideTree::collapse(const BinaryTree& tree, const Cuts& cuts, std::uint32_t root, std::size_t limit,
                                 Part& part) {
  const auto& binary = tree.nodes();
  const auto index = static_cast<std::uint32_t>(part.nodes.size());
  part.nodes.emplace_back();
  std::array<std::uint32_t, 8> open{};
  std::uint32_t n = 0;
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
  for (std::uint32_t i = 0; i < 8; ++i) {
    const Bounds box = i < n ? binary[open[i]].box : Bounds{}; // no ray enters an empty box
    for (int a = 0; a < 3; ++a) {
      node.bounds[a][i] = box.lo[a];
      node.bounds[a + 3][i] = box.hi[a];
    }
    node.child[i] = leaf_bit;
    if (i >= n) continue;
    const BinaryTree::Node& child = binary[open[i]];
    if (child.count > 0) {
      node.child[i] = leaf_bit | static_cast<std::uint32_t>(part.leaves.size());
      part.leaves.push_back({child.first, child.count});
    } else if (open[i] < limit) {
      node.child[i] = collapse(tree, cuts, open[i], limit, part);
    } else {
      part.hanging.push_back({open[i], index, i});
    }
  }
  part.nodes[index] = node;
  return index;
}

// Concatenates the top and the parts below it.
void WideTree::join(Part& top, const std::vector<Part>& parts) {
  std::vector<std::size_t> nodes = {top.nodes.size()}, leaves = {top.leaves.size()};
  for (const Part& part : parts) {
    nodes.push_back(nodes.back() + part.nodes.size());
    leaves.push_back(leaves.back() + part.leaves.size());
  }
  nodes_.resize(nodes.back());
  leaves_.resize(leaves.back());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part::Hanging& at = top.hanging[i];
    top.nodes[at.node].child[at.child] = static_cast<std::uint32_t>(nodes[i]);
  }
  std::copy(top.nodes.begin(), top.nodes.end(), nodes_.begin());
  std::copy(top.leaves.begin(), top.leaves.end(), leaves_.begin());
  mc::parallel_for(parts.size(), 0, [&](std::size_t i) {
    std::copy(parts[i].leaves.begin(), parts[i].leaves.end(), leaves_.begin() + static_cast<std::ptrdiff_t>(leaves[i]));
    const auto moved = [&](Node node) {
      for (std::uint32_t& child : node.child)
        child += static_cast<std::uint32_t>(child & leaf_bit ? leaves[i] : nodes[i]);
      return node;
    };
    std::transform(parts[i].nodes.begin(), parts[i].nodes.end(), nodes_.begin() + static_cast<std::ptrdiff_t>(nodes[i]),
                   moved);
  });
}

} // namespace render

#include <render/accel/wide_tree.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace render {

/// A node of the binary tree that is collapsed afterwards. count > 0: a leaf over order[first, first + count).
struct WideTree::Binary {
  Bounds box;
  std::uint32_t first = 0, count = 0, left = 0, right = 0;
  int depth = 0, height = 0; ///< levels above and below, for rotate()
};

namespace {

constexpr int bins = 32;
constexpr int deepest = 64;          // beyond this depth halves are taken by count, which adds at most 32 levels
constexpr int levels = deepest + 32; // what the stack of a ray suffices for

struct Split {
  int axis = 0, bin = 0;
  double cost = mc::infinity<double>; ///< infinite: there is none
};

struct Bins {
  std::array<Bounds, bins> box;
  std::array<std::uint32_t, bins> count{};
};

double blocks(std::uint32_t count, std::uint32_t lanes) {
  const std::uint32_t whole = (count + lanes - 1) / lanes;
  return whole;
}

// The last bin on the left side of the cheapest border: areas times blocks, on both sides.
Split cheapest_border(const Bins& b, int axis, std::uint32_t count, std::uint32_t lanes) {
  std::array<double, bins> right{};
  Bounds sweep;
  std::uint32_t swept = 0;
  for (std::size_t i = bins - 1; i > 0; --i) {
    sweep.add(b.box[i]);
    swept += b.count[i];
    right[i] = double(sweep.half_area()) * blocks(swept, lanes);
  }
  Split best;
  sweep = Bounds{};
  swept = 0;
  for (std::size_t i = 0; i + 1 < bins; ++i) {
    sweep.add(b.box[i]);
    swept += b.count[i];
    const double cost = double(sweep.half_area()) * blocks(swept, lanes) + right[i + 1];
    if (swept > 0 && swept < count && cost < best.cost) best = {axis, static_cast<int>(i), cost};
  }
  return best;
}

} // namespace

WideTree::WideTree(const std::vector<Bounds>& boxes, std::uint32_t lanes) : order_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<Binary> tree(1);
  tree[0].count = static_cast<std::uint32_t>(boxes.size());
  for (const Bounds& b : boxes) tree[0].box.add(b);

  const auto center = [&](std::uint32_t i, int axis) {
    return Float(0.5) * boxes[i].lo[axis] + Float(0.5) * boxes[i].hi[axis];
  };
  struct Task {
    std::uint32_t node;
    int depth;
  };
  std::vector<Task> tasks = {{0, 0}};
  while (!tasks.empty()) {
    const auto [index, depth] = tasks.back();
    tasks.pop_back();
    const std::uint32_t first = tree[index].first, count = tree[index].count;
    if (count <= lanes) continue;
    const auto begin = order_.begin() + first, end = begin + count;

    Bounds centers;
    for (auto it = begin; it != end; ++it) centers.add(Vec3(center(*it, 0), center(*it, 1), center(*it, 2)));
    const auto bin_of = [&](std::uint32_t i, int axis) {
      const Float extent = centers.hi[axis] - centers.lo[axis];
      return std::min(bins - 1, static_cast<int>((center(i, axis) - centers.lo[axis]) / extent * Float(bins)));
    };

    Split best;
    for (int axis = 0; axis < 3 && depth < deepest; ++axis) {
      if (!(centers.hi[axis] > centers.lo[axis])) continue;
      Bins binned;
      for (auto it = begin; it != end; ++it) {
        const auto b = static_cast<std::size_t>(bin_of(*it, axis));
        binned.box[b].add(boxes[*it]);
        ++binned.count[b];
      }
      const Split split = cheapest_border(binned, axis, count, lanes);
      if (split.cost < best.cost) best = split;
    }

    auto middle = begin + count / 2; // identical centres, or too deep: halves by count
    if (best.cost < mc::infinity<double>) {
      middle = std::partition(begin, end, [&](std::uint32_t i) { return bin_of(i, best.axis) <= best.bin; });
    } else {
      int axis = 0;
      (centers.hi - centers.lo).maxCoeff(&axis);
      std::nth_element(begin, middle, end,
                       [&](std::uint32_t a, std::uint32_t b) { return center(a, axis) < center(b, axis); });
    }

    Binary left, right;
    left.first = first;
    left.count = static_cast<std::uint32_t>(middle - begin);
    right.first = first + left.count;
    right.count = count - left.count;
    for (auto it = begin; it != middle; ++it) left.box.add(boxes[*it]);
    for (auto it = middle; it != end; ++it) right.box.add(boxes[*it]);
    const auto children = static_cast<std::uint32_t>(tree.size());
    tree[index].count = 0;
    tree[index].left = children;
    tree[index].right = children + 1;
    tree.push_back(left);
    tree.push_back(right);
    tasks.push_back({children, depth + 1});
    tasks.push_back({children + 1, depth + 1});
  }
  for (int pass = 0; pass < 2; ++pass) rotate(tree); // more passes gain next to nothing
  collapse(tree, cheapest_cuts(tree), 0);
  nodes_.shrink_to_fit();
  leaves_.shrink_to_fit();
}

std::vector<std::uint32_t> WideTree::parents_first(const std::vector<Binary>& tree) {
  std::vector<std::uint32_t> order, open = {0};
  while (!open.empty()) {
    const std::uint32_t i = open.back();
    open.pop_back();
    order.push_back(i);
    if (tree[i].count == 0) open.insert(open.end(), {tree[i].left, tree[i].right});
  }
  return order;
}

// Borders are drawn by the items of a node, before it is known which boxes these end up in. Now that it is, a child of
// a node changes places with a child of the other one, where that makes the other one's box smaller.
void WideTree::rotate(std::vector<Binary>& tree) {
  const auto order = parents_first(tree);
  for (const std::uint32_t i : order)
    if (tree[i].count == 0) tree[tree[i].left].depth = tree[tree[i].right].depth = tree[i].depth + 1;
  const auto height_over = [&](std::uint32_t a, std::uint32_t b) {
    return 1 + std::max(tree[a].height, tree[b].height);
  };
  for (auto it = order.rbegin(); it != order.rend(); ++it) {
    Binary& n = tree[*it];
    if (n.count > 0) continue;
    n.height = height_over(n.left, n.right);
    double best = 0;
    Binary* smaller = nullptr; // the child that gets the box when `out` of it and `in` change places
    Bounds box;
    std::uint32_t *in = nullptr, *out = nullptr;
    for (const auto& [child, sibling] : {std::pair(&n.left, &n.right), std::pair(&n.right, &n.left)}) {
      Binary& c = tree[*child];
      if (c.count > 0) continue;
      for (const auto& [goes, stays] : {std::pair(&c.left, &c.right), std::pair(&c.right, &c.left)}) {
        Bounds together = tree[*sibling].box;
        together.add(tree[*stays].box);
        const double gain = double(c.box.half_area()) - double(together.half_area());
        const int height = 1 + std::max(height_over(*sibling, *stays), tree[*goes].height);
        if (!(gain > best) || (height > n.height && n.depth + height > levels)) continue;
        best = gain;
        smaller = &c;
        box = together;
        in = sibling;
        out = goes;
      }
    }
    if (!smaller) continue;
    std::swap(*in, *out);
    smaller->box = box;
    smaller->height = height_over(smaller->left, smaller->right);
    n.height = height_over(n.left, n.right);
  }
}

// The node of eight children that a binary one becomes costs the chance that a ray meets it, its area: then those below
// it cost least when the two halves of what they stand for do, for the best share of the children between the halves.
WideTree::Cuts WideTree::cheapest_cuts(const std::vector<Binary>& binary) {
  Cuts cuts(binary.size());
  // [children]; leaves cost nothing, since they are there however nodes are cut.
  std::vector<std::array<double, 9>> costs(binary.size());
  const auto order = parents_first(binary);
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

std::uint32_t WideTree::collapse(const std::vector<Binary>& binary, const Cuts& cuts, std::uint32_t root) {
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
    const Binary& child = binary[open[i]];
    if (child.count > 0) {
      node.child[i] = leaf_bit | static_cast<std::uint32_t>(leaves_.size());
      leaves_.push_back({child.first, child.count});
    } else {
      node.child[i] = collapse(binary, cuts, open[i]);
    }
  }
  nodes_[index] = node;
  return index;
}

} // namespace render

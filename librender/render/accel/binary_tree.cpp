#include <render/accel/binary_tree.h>
#include <render/core/huge_pages.h>
#include <render/core/lanes.h>

#include <mc/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace render {

namespace {

using Node = BinaryTree::Node;

// Bounds in a vector register. The first three lanes hold the low sides, lanes five to seven the negated high sides, so
// one minimum merges two boxes.
struct Box {
  Lanes sides = mc::infinity<Float> - Lanes{};

  void add(const Lanes& other) { sides = detail::smaller(other, sides); }
  double half_area() const {
    const Float x = sides[0] + sides[4], y = sides[1] + sides[5], z = sides[2] + sides[6]; // negative
    return double(x * y + y * z + z * x);
  }
  Float extent(int axis) const { return -sides[axis + 4] - sides[axis]; }
  Bounds bounds() const { return {{sides[0], sides[1], sides[2]}, {-sides[4], -sides[5], -sides[6]}}; }
};

// A box with its index. The index is split over the two spare lanes into integers that a float represents exactly.
struct Item {
  Lanes sides;

  Item() = default;
  Item(const Bounds& b, std::size_t i)
      : sides{b.lo[0], b.lo[1], b.lo[2], Float(i >> 12), -b.hi[0], -b.hi[1], -b.hi[2], Float(i & 4095)} {}
  std::uint32_t index() const {
    return static_cast<std::uint32_t>(sides[3]) << 12 | static_cast<std::uint32_t>(sides[7]);
  }
  Float center(int axis) const { return Float(0.5) * sides[axis] - Float(0.5) * sides[axis + 4]; }
  // The centre as a box.
  Lanes center() const {
    const Lanes half = Float(0.5) * sides;
    return half - __builtin_shufflevector(half, half, 4, 5, 6, 7, 0, 1, 2, 3);
  }
};

// A range of items with the bounds of their boxes and of their centres.
struct Part {
  Box box = {}, centers = {};
  std::uint32_t first = 0, count = 0;
  int depth = 0;

  void add(const Item& item) {
    box.add(item.sides);
    centers.add(item.center());
  }
  void merge(const Part& p) {
    box.add(p.box.sides);
    centers.add(p.centers.sides);
    count += p.count;
  }
};

constexpr std::int32_t bins = 32;
constexpr int deepest = BinaryTree::max_depth - 32; // deeper nodes are halved by count, which adds at most 32 levels

// Bins: equal slices of the centres of a part along each axis. An axis along which the centres do not differ has a
// single bin.
class Slices {
 public:
  explicit Slices(const Part& part) : count(std::min(bins, 8 + static_cast<std::int32_t>(part.count / 8))) {
    for (int a = 0; a < 3; ++a) {
      const Float scale = Float(count) / part.centers.extent(a);
      origin_[a] = part.centers.sides[a];
      scale_[a] = std::isfinite(scale) ? scale : Float(0);
    }
  }
  const std::int32_t count;

  std::array<std::int32_t, 3> bins_of(const Item& item) const {
    const Lanes at = detail::smaller((item.center() - origin_) * scale_, Float(count - 1) - Lanes{});
    return {static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]), static_cast<std::int32_t>(at[2])};
  }
  // Whether bins_of(item)[axis] <= last.
  bool is_up_to(std::int32_t last, const Item& item, int axis) const {
    return (item.center(axis) - origin_[axis]) * scale_[axis] < Float(last + 1);
  }

 private:
  Lanes origin_{}, scale_{};
};

struct Bin {
  Box box;
  std::uint32_t count = 0;

  void add(const Bin& b) {
    box.add(b.box.sides);
    count += b.count;
  }
};

// Bins along all axes.
struct Bins {
  Bin along[3][bins];

  void merge(const Bins& b) {
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t i = 0; i < bins; ++i) along[a][i].add(b.along[a][i]);
  }
};

Bins bins_of(std::span<const Item> items, const Slices& slices) {
  constexpr std::size_t many = 1 << 16; // items for one thread
  if (items.size() > many)
    return mc::parallel_reduce<Bins>((items.size() + many - 1) / many, 0, [&](std::size_t i) {
      return bins_of(items.subspan(i * many, std::min(many, items.size() - i * many)), slices);
    });
  Bins all;
  for (const Item& item : items) {
    const auto at = slices.bins_of(item);
    for (std::size_t a = 0; a < 3; ++a) {
      Bin& bin = all.along[a][at[a]];
      bin.box.add(item.sides);
      ++bin.count;
    }
  }
  return all;
}

struct Border {
  int axis = 0, bin = 0;              ///< last bin on the left side
  double cost = mc::infinity<double>; ///< infinite: no border
};

// Number of lanes in whole blocks for `count` boxes.
double filled(std::uint32_t count, std::uint32_t lanes) { return (count + lanes - 1) & ~(lanes - 1); }

// The cheapest border along an axis. The cost is area times lanes, summed over both sides.
Border cheapest_border(std::span<const Bin> along, int axis, std::uint32_t lanes) {
  std::array<double, bins> right;
  Bin sweep;
  for (std::size_t i = along.size() - 1; i > 0; --i) {
    sweep.add(along[i]);
    right[i] = sweep.count > 0 ? sweep.box.half_area() * filled(sweep.count, lanes) : mc::infinity<double>;
  }
  Border best;
  sweep = Bin();
  for (std::size_t i = 0; i + 1 < along.size(); ++i) {
    sweep.add(along[i]);
    if (sweep.count == 0) continue;
    const double cost = sweep.box.half_area() * filled(sweep.count, lanes) + right[i + 1];
    if (cost < best.cost) best = {axis, static_cast<int>(i), cost};
  }
  return best;
}

// The two halves of a part. Splitting reorders its items.
struct Halves {
  Part left, right;
};

// Assigns the first `count` items to the left half.
Halves halves_after(std::span<const Item> items, const Part& part, std::uint32_t count) {
  const auto part_of = [&](std::uint32_t first, std::uint32_t n) {
    Part half{.first = first, .count = n, .depth = part.depth + 1};
    for (const Item& item : items.subspan(first, n)) half.add(item);
    return half;
  };
  return {part_of(part.first, count), part_of(part.first + count, part.count - count)};
}

Halves halves_by_count(std::span<Item> items, const Part& part) {
  const auto begin = items.begin() + part.first, middle = begin + part.count / 2, end = begin + part.count;
  int axis = 0;
  for (int a = 1; a < 3; ++a)
    if (part.centers.extent(a) > part.centers.extent(axis)) axis = a;
  std::nth_element(begin, middle, end, [&](const Item& a, const Item& b) { return a.center(axis) < b.center(axis); });
  return halves_after(items, part, part.count / 2);
}

Halves halves_at(std::span<Item> items, const Part& part, const Slices& slices, const Border& border) {
  std::uint32_t end = 0;                                     // end of the left items
  for (Item& item : items.subspan(part.first, part.count)) { // without a branch, which would be mispredicted
    const bool is_left = slices.is_up_to(border.bin, item, border.axis);
    std::swap(item, items[part.first + end]);
    end += is_left;
  }
  return halves_after(items, part, end);
}

Halves halves_of(std::span<Item> items, const Part& part, std::uint32_t lanes) {
  Border best;
  const Slices slices(part);
  if (part.depth < deepest) {
    const Bins all = bins_of(items.subspan(part.first, part.count), slices);
    for (int a = 0; a < 3; ++a) {
      const Border border = cheapest_border(std::span(all.along[a], static_cast<std::size_t>(slices.count)), a, lanes);
      if (border.cost < best.cost) best = border;
    }
  }
  return best.cost < mc::infinity<double> ? halves_at(items, part, slices, best) : halves_by_count(items, part);
}

// A node that is still to be split.
struct Open {
  std::uint32_t node;
  Part part;
};

Node node_of(const Part& part) { return {part.box.bounds(), part.first, part.count, 0, 0, part.depth, 0}; }

// Adds two children to a node and passes them to `open`.
template <class F> void divide(std::vector<Node>& nodes, std::uint32_t node, const Halves& halves, F&& open) {
  const auto first = static_cast<std::uint32_t>(nodes.size());
  nodes[node].count = 0;
  nodes[node].left = first;
  nodes[node].right = first + 1;
  nodes.push_back(node_of(halves.left));
  nodes.push_back(node_of(halves.right));
  open(Open{first, halves.left});
  open(Open{first + 1, halves.right});
}

// The nodes below `limit` that are reached through such nodes only, each before its children.
std::vector<std::uint32_t> top_down(const std::vector<Node>& nodes, std::uint32_t limit) {
  std::vector<std::uint32_t> order, open = {0};
  order.reserve(limit);
  while (!open.empty()) {
    const std::uint32_t i = open.back();
    open.pop_back();
    order.push_back(i);
    if (nodes[i].count > 0) continue;
    for (const std::uint32_t child : {nodes[i].left, nodes[i].right})
      if (child < limit) open.push_back(child);
  }
  return order;
}

// Tree rotations. The split of a node does not yet take the final boxes below it into account. A rotation swaps a child
// of a node with a grandchild on the other side if this reduces the area of the other child. Nodes from `limit` on
// belong to finished subtrees and keep their children.
void rotate(std::vector<Node>& nodes, std::uint32_t limit) {
  const auto order = top_down(nodes, limit);
  const auto height_over = [&](std::uint32_t a, std::uint32_t b) {
    return 1 + std::max(nodes[a].height, nodes[b].height);
  };
  for (const std::uint32_t i : order)
    if (nodes[i].count == 0) nodes[nodes[i].left].depth = nodes[nodes[i].right].depth = nodes[i].depth + 1;
  for (auto it = order.rbegin(); it != order.rend(); ++it) {
    Node& n = nodes[*it];
    if (n.count > 0) continue;
    n.height = height_over(n.left, n.right);
    double best = 0;
    Node* smaller = nullptr; // the child with the new box after `out`, one of its children, and `in` are swapped
    Bounds box;
    std::uint32_t *in = nullptr, *out = nullptr;
    for (const auto& [child, sibling] : {std::pair(&n.left, &n.right), std::pair(&n.right, &n.left)}) {
      Node& c = nodes[*child];
      if (c.count > 0 || *child >= limit) continue;
      for (const auto& [goes, stays] : {std::pair(&c.left, &c.right), std::pair(&c.right, &c.left)}) {
        Bounds together = nodes[*sibling].box;
        together.add(nodes[*stays].box);
        const double gain = double(c.box.half_area()) - double(together.half_area());
        const int height = 1 + std::max(height_over(*sibling, *stays), nodes[*goes].height);
        if (!(gain > best) || (height > n.height && n.depth + height > BinaryTree::max_depth)) continue;
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

constexpr int rotations = 2; // further rotations gain next to nothing

struct Tree {
  std::vector<Node> nodes; ///< the root first
  std::vector<std::uint32_t> parents_first;
};

// Builds the tree of a part.
Tree grown(std::span<Item> items, const Part& part, std::uint32_t lanes) {
  std::vector<Node> nodes = {node_of(part)};
  std::vector<Open> open;
  const auto add = [&](const Open& node) {
    if (node.part.count > lanes) open.push_back(node);
  };
  add({0, part});
  while (!open.empty()) {
    const Open at = open.back();
    open.pop_back();
    divide(nodes, at.node, halves_of(items, at.part, lanes), add);
  }
  const auto size = static_cast<std::uint32_t>(nodes.size());
  for (int i = 0; i < rotations; ++i) rotate(nodes, size);
  auto order = top_down(nodes, size);
  return {std::move(nodes), std::move(order)};
}

} // namespace

// Splits the large nodes level by level, then builds the subtrees of the small nodes in parallel.
BinaryTree::BinaryTree(std::size_t count, const std::function<Bounds(std::size_t)>& box, std::uint32_t lanes)
    : order_(count) {
  constexpr std::uint32_t large = 4096; // boxes; one thread builds the subtree of a smaller node within its cache
  std::vector<Item, HugePageAllocator<Item>> items(count);
  std::vector<Part> parts((count + large - 1) / large);
  mc::parallel_parts(count, large, 0, [&](std::size_t begin, std::size_t end) {
    Part& part = parts[begin / large];
    for (std::size_t i = begin; i < end; ++i) part.add(items[i] = Item(box(i), i));
    part.count = static_cast<std::uint32_t>(end - begin);
  });
  Part whole;
  for (const Part& part : parts) whole.merge(part);

  std::vector<Open> level, next, small;
  const auto add = [&](const Open& node) { (node.part.count > large ? next : small).push_back(node); };
  nodes_ = {node_of(whole)};
  add({0, whole});
  while (!next.empty()) {
    level = std::exchange(next, {});
    std::vector<Halves> halves(level.size());
    mc::parallel_for(level.size(), 0, [&](std::size_t i) { halves[i] = halves_of(items, level[i].part, lanes); });
    for (std::size_t i = 0; i < level.size(); ++i) divide(nodes_, level[i].node, halves[i], add);
  }

  std::vector<Tree> trees(small.size());
  mc::parallel_for(small.size(), 0, [&](std::size_t i) {
    trees[i] = grown(items, small[i].part, lanes);
    for (std::uint32_t k = small[i].part.first; k < small[i].part.first + small[i].part.count; ++k)
      order_[k] = items[k].index();
  });
  const auto top = static_cast<std::uint32_t>(nodes_.size());
  parents_first_.resize(1);
  for (std::size_t i = 0; i < small.size(); ++i) {
    auto& [nodes, order] = trees[i];
    const auto offset = static_cast<std::uint32_t>(nodes_.size()) - 1; // the root of the subtree exists already
    for (Node& n : nodes)
      if (n.count == 0) {
        n.left += offset;
        n.right += offset;
      }
    nodes_[small[i].node] = nodes[0];
    nodes_.insert(nodes_.end(), nodes.begin() + 1, nodes.end());
    order.erase(order.begin());
    for (std::uint32_t& node : order) node += offset;
    parents_first_.push_back(std::move(order));
  }
  if (small.size() > 1)
    for (int i = 0; i < rotations; ++i) rotate(nodes_, top);
  parents_first_[0] = top_down(nodes_, top);
}

} // namespace render

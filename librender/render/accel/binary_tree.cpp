#include <render/accel/binary_tree.h>
#include <render/core/huge_pages.h>

#include <mc/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace render {

namespace {

using Node = BinaryTree::Node;

// A point in the first three lanes.
typedef Float Four __attribute__((vector_size(4 * sizeof(Float))));
typedef std::int32_t FourInts __attribute__((vector_size(4 * sizeof(std::int32_t))));

Four smaller(const Four& a, const Four& b) { return a < b ? a : b; }
Four larger(const Four& a, const Four& b) { return a > b ? a : b; }

// A Bounds in vector registers.
struct Box {
  Four lo = mc::infinity<Float> - Four{}, hi = -mc::infinity<Float> - Four{};

  void add(const Four& low, const Four& high) {
    lo = smaller(lo, low);
    hi = larger(hi, high);
  }
  double half_area() const {
    const Four e = hi - lo;
    return double(e[0] * e[1] + e[1] * e[2] + e[2] * e[0]);
  }
  Bounds bounds() const { return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}; }
};

// A box to be sorted. Its number is in the spare lanes: whole numbers that a float holds.
struct Item {
  Four lo, hi;

  Item() = default;
  Item(const Bounds& b, std::size_t i)
      : lo{b.lo[0], b.lo[1], b.lo[2], Float(i >> 12)}, hi{b.hi[0], b.hi[1], b.hi[2], Float(i & 4095)} {}
  std::uint32_t index() const { return static_cast<std::uint32_t>(lo[3]) << 12 | static_cast<std::uint32_t>(hi[3]); }
  Float center(int axis) const { return Float(0.5) * lo[axis] + Float(0.5) * hi[axis]; }
  Four center() const { return Float(0.5) * lo + Float(0.5) * hi; }
};

// Items of a node, and the boxes around them and around their centres.
struct Part {
  Box box, centers;
  std::uint32_t first = 0, count = 0;
  int depth = 0;

  void add(const Item& item) {
    const Four center = item.center();
    box.add(item.lo, item.hi);
    centers.add(center, center);
  }
  void merge(const Part& p) {
    box.add(p.box.lo, p.box.hi);
    centers.add(p.centers.lo, p.centers.hi);
    count += p.count;
  }
};

constexpr std::int32_t bins = 32;
constexpr int deepest = BinaryTree::levels - 32; // beyond, halves are taken by count, which adds at most 32 levels

// Equal slices of a part's centres along each axis, a bin for each. An axis along which they do not differ has one.
class Slices {
 public:
  explicit Slices(const Part& part) : origin_(part.centers.lo) {
    for (int a = 0; a < 3; ++a) {
      const Float scale = Float(bins) / (part.centers.hi[a] - part.centers.lo[a]);
      scale_[a] = std::isfinite(scale) ? scale : Float(0);
    }
  }
  FourInts bins_of(const Item& item) const {
    const Four at = (item.center() - origin_) * scale_, last = Float(bins - 1) - Four{};
    return __builtin_convertvector(smaller(at, last), FourInts); // infinity times 0 is in the last one
  }
  // Whether bins_of(item)[axis] <= last.
  bool is_up_to(std::int32_t last, const Item& item, int axis) const {
    return (item.center(axis) - origin_[axis]) * scale_[axis] < Float(last + 1);
  }

 private:
  Four origin_, scale_{};
};

struct Bin {
  Box box;
  std::uint32_t count = 0;

  void add(const Bin& b) {
    box.add(b.box.lo, b.box.hi);
    count += b.count;
  }
};
using Bins = std::array<Bin, bins>;

struct Border {
  int axis = 0, bin = 0;              ///< the last bin on its left side
  double cost = mc::infinity<double>; ///< infinite: there is none
};

// As many lanes as whole blocks for `count` boxes have.
double filled(std::uint32_t count, std::uint32_t lanes) { return (count + lanes - 1) & ~(lanes - 1); }

// The cheapest border along an axis: areas times lanes, on both sides.
Border cheapest_border(const Bins& along, int axis, std::uint32_t lanes) {
  std::array<double, bins> right;
  Bin sweep;
  for (std::size_t i = bins - 1; i > 0; --i) {
    sweep.add(along[i]);
    right[i] = sweep.count > 0 ? sweep.box.half_area() * filled(sweep.count, lanes) : mc::infinity<double>;
  }
  Border best;
  sweep = Bin();
  for (std::size_t i = 0; i + 1 < bins; ++i) {
    sweep.add(along[i]);
    if (sweep.count == 0) continue;
    const double cost = sweep.box.half_area() * filled(sweep.count, lanes) + right[i + 1];
    if (cost < best.cost) best = {axis, static_cast<int>(i), cost};
  }
  return best;
}

// The two halves of a part, whose items change places.
struct Halves {
  Part left, right;
};

Halves halves_by_count(std::span<Item> items, const Part& part) {
  const auto begin = items.begin() + part.first, middle = begin + part.count / 2, end = begin + part.count;
  const Four extent = part.centers.hi - part.centers.lo;
  int axis = 0;
  for (int a = 1; a < 3; ++a)
    if (extent[a] > extent[axis]) axis = a;
  std::nth_element(begin, middle, end, [&](const Item& a, const Item& b) { return a.center(axis) < b.center(axis); });
  Halves h;
  for (auto it = begin; it != middle; ++it) h.left.add(*it);
  for (auto it = middle; it != end; ++it) h.right.add(*it);
  h.left.count = part.count / 2;
  return h;
}

Halves halves_at(std::span<Item> items, const Part& part, const Slices& slices, const Border& border) {
  Halves h;
  std::uint32_t i = part.first, j = part.first + part.count;
  const auto is_left = [&](const Item& item) { return slices.is_up_to(border.bin, item, border.axis); };
  while (true) {
    for (; i < j && is_left(items[i]); ++i) h.left.add(items[i]);
    for (; i < j && !is_left(items[j - 1]); --j) h.right.add(items[j - 1]);
    if (i == j) break;
    std::swap(items[i], items[j - 1]);
  }
  h.left.count = i - part.first;
  return h;
}

Halves halves_of(std::span<Item> items, const Part& part, std::uint32_t lanes) {
  Border best;
  const Slices slices(part);
  if (part.depth < deepest) {
    std::array<Bins, 3> axes;
    for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
      const FourInts at = slices.bins_of(items[i]);
      for (std::size_t a = 0; a < 3; ++a) {
        Bin& bin = axes[a][static_cast<std::size_t>(at[a])];
        bin.box.add(items[i].lo, items[i].hi);
        ++bin.count;
      }
    }
    for (int a = 0; a < 3; ++a) {
      const Border border = cheapest_border(axes[static_cast<std::size_t>(a)], a, lanes);
      if (border.cost < best.cost) best = border;
    }
  }
  Halves h = best.cost < mc::infinity<double> ? halves_at(items, part, slices, best) : halves_by_count(items, part);
  h.left.first = part.first;
  h.right.first = part.first + h.left.count;
  h.right.count = part.count - h.left.count;
  h.left.depth = h.right.depth = part.depth + 1;
  return h;
}

// A node that is still to be halved.
struct Open {
  std::uint32_t node;
  Part part;
};

Node node_of(const Part& part) { return {part.box.bounds(), part.first, part.count, 0, 0, part.depth, 0}; }

// Makes a node the parent of two new ones, and tells `open` of these.
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

// The nodes among the first `limit` that are reached through such nodes, each before its children.
std::vector<std::uint32_t> parents_first(const std::vector<Node>& nodes, std::uint32_t limit) {
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

// Borders are drawn by the items of a node, before it is known which boxes these end up in. Now that it is, a child of
// a node changes places with a child of the other one, where that makes the other one's box smaller. Of the nodes from
// `limit` on, whose trees are finished, none but those at the top move.
void rotate(std::vector<Node>& nodes, std::uint32_t limit) {
  const auto order = parents_first(nodes, limit);
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
    Node* smaller = nullptr; // the child that gets the box when `out` of it and `in` change places
    Bounds box;
    std::uint32_t *in = nullptr, *out = nullptr;
    for (const auto& [child, sibling] : {std::pair(&n.left, &n.right), std::pair(&n.right, &n.left)}) {
      Node& c = nodes[*child];
      if (c.count > 0) continue;
      for (const auto& [goes, stays] : {std::pair(&c.left, &c.right), std::pair(&c.right, &c.left)}) {
        Bounds together = nodes[*sibling].box;
        together.add(nodes[*stays].box);
        const double gain = double(c.box.half_area()) - double(together.half_area());
        const int height = 1 + std::max(height_over(*sibling, *stays), nodes[*goes].height);
        if (!(gain > best) || (height > n.height && n.depth + height > BinaryTree::levels)) continue;
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

constexpr int rotations = 2; // more gain next to nothing

// The tree of a part, its root first.
std::vector<Node> grown(std::span<Item> items, const Part& part, std::uint32_t lanes) {
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
  for (int i = 0; i < rotations; ++i) rotate(nodes, static_cast<std::uint32_t>(nodes.size()));
  return nodes;
}

} // namespace

// The large nodes of a level at once, and then the trees of the small ones.
BinaryTree::BinaryTree(std::size_t count, const std::function<Bounds(std::size_t)>& box, std::uint32_t lanes)
    : order_(count) {
  constexpr std::uint32_t large = 4096; // boxes; the tree of fewer takes one thread, in 128 KB
  std::vector<Item, HugePages<Item>> items(count);
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

  std::vector<std::vector<Node>> trees(small.size());
  mc::parallel_for(small.size(), 0, [&](std::size_t i) {
    trees[i] = grown(items, small[i].part, lanes);
    for (std::uint32_t k = small[i].part.first; k < small[i].part.first + small[i].part.count; ++k)
      order_[k] = items[k].index();
  });
  const auto top = static_cast<std::uint32_t>(nodes_.size());
  for (std::size_t i = 0; i < small.size(); ++i) {
    const auto offset = static_cast<std::uint32_t>(nodes_.size()) - 1; // its root is there already
    for (Node& n : trees[i])
      if (n.count == 0) {
        n.left += offset;
        n.right += offset;
      }
    nodes_[small[i].node] = trees[i][0];
    nodes_.insert(nodes_.end(), trees[i].begin() + 1, trees[i].end());
  }
  if (small.size() == 1) return;
  for (int i = 0; i < rotations; ++i) rotate(nodes_, top);
}

std::vector<std::uint32_t> BinaryTree::parents_first() const {
  return render::parents_first(nodes_, static_cast<std::uint32_t>(nodes_.size()));
}

} // namespace render

#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/table/box_tree.h>

#include <algorithm>
#include <cmath>

namespace mc {

// Builds the tree in one pass over the nodes. The call stack holds the sides of the current box.
struct BoxTree::Builder {
  BoxTree& tree;
  std::vector<double> weight;        // weight of each node: the sum over its leaves
  std::vector<double> positive;      // number of leaves of positive weight below each node
  std::vector<std::size_t> after;    // index of the first node after the subtree of each node
  std::vector<AxisExtent> path = {}; // sides of the current box that were cut

  std::uint32_t build(std::size_t node) {
    const BoxTreeNode& n = tree.nodes_[node];
    if (n.axis == BoxTreeNode::leaf) return finish();
    const auto split = static_cast<std::uint32_t>(tree.splits_.size());
    const auto extent = std::find_if(path.begin(), path.end(), [&](const AxisExtent& s) { return s.axis == n.axis; });
    const auto place = static_cast<std::size_t>(extent - path.begin());
    const bool fresh = extent == path.end();
    const AxisExtent whole = fresh ? AxisExtent{n.axis, 0, 1, 0, 1} : *extent;
    require(n.value > whole.x_lo && n.value < whole.x_hi, "BoxTree: node {} cuts axis {} at {}; its box spans ({}, {})",
            node, n.axis, n.value, whole.x_lo, whole.x_hi);
    const double cut = cut_in_u(whole.u_lo, whole.u_hi, node + 1, after[node + 1]);
    tree.splits_.push_back({n.axis, {0, 0}, cut, n.value});
    if (fresh) path.push_back(whole);
    path[place] = {n.axis, whole.x_lo, n.value, whole.u_lo, cut};
    const std::uint32_t lower = build(node + 1);
    path[place] = {n.axis, n.value, whole.x_hi, cut, whole.u_hi};
    const std::uint32_t upper = build(after[node + 1]);
    if (fresh) path.pop_back();
    else path[place] = whole;
    tree.splits_[split].next[1] = lower;
    tree.splits_[split].next[0] = upper;
    return split;
  }

  // The cut in u: splits [lo, hi) in proportion to the weights of the two subtrees. Leaves at least 2^-53 to each leaf
  // of positive weight, so that later cuts find numbers in between.
  double cut_in_u(double lo, double hi, std::size_t below, std::size_t above) const {
    const double sum = weight[below] + weight[above];
    // With both weights 0, no u maps here and any share is valid.
    const double share = sum > 0 ? weight[below] / sum : 0.5;
    const double lowest = lo + 0x1p-53 * positive[below], highest = hi - 0x1p-53 * positive[above];
    return std::max(std::min(lo + share * (hi - lo), highest), lowest);
  }

  std::uint32_t finish() {
    double density = 1;
    for (const AxisExtent& s : path) density *= (s.u_hi - s.u_lo) / (s.x_hi - s.x_lo);
    tree.extents_.insert(tree.extents_.end(), path.begin(), path.end());
    tree.first_.push_back(tree.extents_.size());
    tree.density_.push_back(density);
    return ~static_cast<std::uint32_t>(tree.density_.size() - 1);
  }
};

BoxTree::BoxTree(int dim, std::span<const BoxTreeNode> nodes)
    : dim_(dim), nodes_(nodes.begin(), nodes.end()), first_{0} {
  require(dim >= 1, "BoxTree: dimension {} must be at least 1", dim);
  require(!nodes.empty() && nodes.size() < 1u << 31, "BoxTree: {} nodes; between 1 and 2^31 are possible",
          nodes.size());
  double largest = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const BoxTreeNode& n = nodes[i];
    if (n.axis == BoxTreeNode::leaf) {
      require(std::isfinite(n.value) && n.value >= 0, "BoxTree: node {} has the weight {}; it must be finite and >= 0",
              i, n.value);
      largest = std::max(largest, n.value);
    } else require(n.axis < static_cast<std::uint32_t>(dim), "BoxTree: node {} cuts axis {} of {}", i, n.axis, dim);
  }
  require(largest > 0, "BoxTree: the weights of all leaves are 0; at least one must be > 0");
  int exponent;
  std::frexp(largest, &exponent); // prevents overflow of the sums
  std::vector<double> weight(nodes.size()), positive(nodes.size());
  std::vector<std::size_t> after(nodes.size()), open; // open: nodes without a parent so far
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (nodes[i].axis == BoxTreeNode::leaf) {
      weight[i] = std::ldexp(nodes[i].value, -exponent);
      positive[i] = nodes[i].value > 0 ? 1 : 0;
      after[i] = i + 1;
    } else {
      require(open.size() >= 2, "BoxTree: node {} needs two parts below it", i);
      const std::size_t below = open.back(), above = open[open.size() - 2];
      open.resize(open.size() - 2);
      weight[i] = weight[below] + weight[above];
      positive[i] = positive[below] + positive[above];
      after[i] = after[above];
    }
    open.push_back(i);
  }
  require(open.size() == 1, "BoxTree: {} nodes make {} trees; one is needed", nodes.size(), open.size());
  root_ = Builder{*this, std::move(weight), std::move(positive), std::move(after)}.build(0);
}

namespace {
struct MeasuredBox {
  std::vector<double> lo, hi;
  double mean = 0, gain = 0; // gain: standard deviation of f times volume
  std::uint32_t axis = 0;
  std::size_t below = 0; // index of the lower half, followed by the upper half; 0: none

  double volume() const {
    double v = 1;
    for (std::size_t a = 0; a < lo.size(); ++a) v *= hi[a] - lo[a];
    return v;
  }
  double middle() const { return (lo[axis] + hi[axis]) / 2; }
  // Whether the halves contain thousands of doubles, so that points within them stay uniform.
  bool is_divisible() const { return hi[axis] - lo[axis] > 0x1p-40 * hi[axis]; }
};

// Steps of a rank-1 sequence: powers of the root of x^(d + 1) = x + 1. Its points cover the cube in any dimension, so
// features away from the middle are sampled too.
std::vector<double> steps(std::size_t dim) {
  double root = 2;
  for (int i = 0; i < 60; ++i) root = std::pow(1 + root, 1 / static_cast<double>(dim + 1));
  std::vector<double> step(dim);
  for (std::size_t a = 0; a < dim; ++a) step[a] = std::pow(root, -static_cast<double>(a + 1));
  return step;
}

MeasuredBox measured(const std::function<double(std::span<const double>)>& f, std::vector<double> lo,
                     std::vector<double> hi) {
  constexpr int points = 32;
  MeasuredBox box{std::move(lo), std::move(hi)};
  const std::size_t d = box.lo.size();
  const std::vector<double> step = steps(d);
  std::vector<double> at(d), below(d), above(d), counted(d), values;
  for (int k = 1; k <= points; ++k) {
    for (std::size_t a = 0; a < d; ++a) {
      const double v = 0.5 + k * step[a] - std::floor(0.5 + k * step[a]);
      at[a] = box.lo[a] + (box.hi[a] - box.lo[a]) * v;
      counted[a] = v;
    }
    const double value = f(at);
    require(std::isfinite(value) && value >= 0, "BoxTree: the function is {}; it must be finite and >= 0", value);
    box.mean += value / points;
    values.push_back(value);
    for (std::size_t a = 0; a < d; ++a) (counted[a] < 0.5 ? below : above)[a] += value / points;
  }
  // Relative to the mean: squares of small numbers would underflow, squares of large ones overflow.
  double squares = 0;
  for (const double value : values) squares += box.mean > 0 ? sqr(value / box.mean - 1) / points : 0.0;
  box.gain = box.volume() * box.mean * std::sqrt(squares);
  // Selects the axis with the largest difference between its halves; among equal axes the longest.
  double most = -1;
  for (std::size_t a = 0; a < d; ++a) {
    const double apart = std::abs(above[a] - below[a]) + 1e-3 * box.mean * (box.hi[a] - box.lo[a]);
    if (apart > most) {
      most = apart;
      box.axis = static_cast<std::uint32_t>(a);
    }
  }
  return box;
}
} // namespace

BoxTree BoxTree::from_function(int dim, const std::function<double(std::span<const double>)>& f, std::size_t leaves) {
  require(dim >= 1, "BoxTree: dimension {} must be at least 1", dim);
  require(leaves >= 1, "BoxTree: 0 leaves; at least 1 is needed");
  const auto d = static_cast<std::size_t>(dim);
  std::vector<MeasuredBox> boxes = {measured(f, std::vector<double>(d, 0.0), std::vector<double>(d, 1.0))};
  // Among boxes in which f does not vary, the largest first: f may vary between the points.
  const auto less = [&](std::size_t a, std::size_t b) {
    return std::pair(boxes[a].gain, boxes[a].volume()) < std::pair(boxes[b].gain, boxes[b].volume());
  };
  std::vector<std::size_t> open = {0}; // a heap of boxes that may be halved
  for (std::size_t made = 1; made < leaves && !open.empty(); ++made) {
    std::pop_heap(open.begin(), open.end(), less);
    const std::size_t at = open.back();
    open.pop_back();
    std::vector<double> lo = boxes[at].lo, hi = boxes[at].hi;
    lo[boxes[at].axis] = hi[boxes[at].axis] = boxes[at].middle();
    boxes[at].below = boxes.size();
    MeasuredBox below = measured(f, boxes[at].lo, std::move(hi)), above = measured(f, std::move(lo), boxes[at].hi);
    for (MeasuredBox* half : {&below, &above}) {
      boxes.push_back(std::move(*half));
      if (!boxes.back().is_divisible()) continue;
      open.push_back(boxes.size() - 1);
      std::push_heap(open.begin(), open.end(), less);
    }
  }
  std::vector<BoxTreeNode> nodes;
  for (std::vector<std::size_t> next = {0}; !next.empty();) {
    const MeasuredBox& box = boxes[next.back()];
    next.pop_back();
    if (box.below == 0) nodes.push_back({BoxTreeNode::leaf, box.mean * box.volume()});
    else {
      nodes.push_back({box.axis, box.middle()});
      next.insert(next.end(), {box.below + 1, box.below});
    }
  }
  return BoxTree(dim, nodes);
}

double BoxTree::map(std::span<double> u) const {
  const std::size_t leaf = leaf_of_u(u);
  for (const AxisExtent& s : extents(leaf)) {
    const double x = s.x_lo + (u[s.axis] - s.u_lo) / (s.u_hi - s.u_lo) * (s.x_hi - s.x_lo);
    u[s.axis] = std::min(x, std::nextafter(s.x_hi, 0.0));
  }
  return 1 / density_[leaf];
}

} // namespace mc

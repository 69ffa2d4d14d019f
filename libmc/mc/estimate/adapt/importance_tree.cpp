#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/estimate/adapt/importance_tree.h>
#include <mc/random/hash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace mc {

namespace {

constexpr double uniform_share = 0.1; // of the probability, over the cube
constexpr double even_share = 0.02;   // of that of a box that is cut, over the box
constexpr double mean_share = 0.25;   // of the squared mean, beside the variance
constexpr double fewest = 16;         // points of either half in a box
constexpr double worthwhile = 0.02;   // a cut saves at least this share of what its box costs
constexpr std::size_t parts = 8;      // of a box, between which it may be cut

struct Sums {
  double n = 0, weight = 0, value = 0, square = 0;

  void add(double w, double x) {
    n += 1;
    weight += w;
    value += w * x;
    square += w * x * x;
  }
  Sums operator+(const Sums& b) const { return {n + b.n, weight + b.weight, value + b.value, square + b.square}; }
  Sums operator-(const Sums& b) const { return {n - b.n, weight - b.weight, value - b.value, square - b.square}; }
  // The root of what a point in the box costs.
  double spread() const {
    if (!(weight > 0)) return 0;
    const double mean = value / weight,
                 variance = std::max(square / weight - mean * mean, 0.0) * n / std::max(n - 1, 1.0);
    return std::sqrt(variance + mean_share * mean * mean);
  }
};
using Halves = std::array<Sums, 2>;

struct Open {
  std::size_t first, last; // of the order
  std::vector<double> lo, hi;
  double volume;
};

struct Cut {
  std::uint32_t axis = BoxTreeNode::leaf;
  double at = 0;
};

// What a subtree costs: what the first half of the points shows of the leaves says how points are shared among them,
// and what the second half shows says what that costs.
struct Cost {
  double asked = 0, paid = 0;
  double total() const { return asked * paid; }
};

struct Learner {
  const WeightedSamples& samples;
  std::vector<std::size_t> order;
  std::vector<BoxTreeNode> nodes = {};
  std::vector<double> volumes = {}; // of the leaves

  // Which half a point is in: hashed, since even points of a sequence lie on one side.
  static std::size_t half(std::size_t k) { return mix64(k) & 1; }

  Halves sums(const Open& box) const {
    Halves all{};
    for (std::size_t i = box.first; i < box.last; ++i)
      all[half(order[i])].add(samples.weights[order[i]], samples.values[order[i]]);
    return all;
  }

  // Where the first half of the points gains most; where it gains nothing, through the middle of the longest side: what
  // is symmetric shows only in the parts of the parts.
  Cut best(const Open& box, const Halves& all) const {
    Cut cut, middle;
    double largest = worthwhile, longest = 0;
    for (std::size_t a = 0; a < box.lo.size(); ++a) {
      std::array<Halves, parts> part{};
      const double side = box.hi[a] - box.lo[a];
      for (std::size_t i = box.first; i < box.last; ++i) {
        const std::size_t k = order[i];
        const double place = (samples.point(k)[a] - box.lo[a]) / side * parts;
        part[std::min(static_cast<std::size_t>(std::max(place, 0.0)), parts - 1)][half(k)].add(samples.weights[k],
                                                                                               samples.values[k]);
      }
      Halves below{};
      for (std::size_t k = 1; k < parts; ++k) {
        for (std::size_t h = 0; h < 2; ++h) below[h] = below[h] + part[k - 1][h];
        const Halves above = {all[0] - below[0], all[1] - below[1]};
        if (std::min({below[0].n, below[1].n, above[0].n, above[1].n}) < fewest) continue;
        const double share = static_cast<double>(k) / parts, cost = all[0].spread();
        const double gain = cost > 0 ? 1 - (share * below[0].spread() + (1 - share) * above[0].spread()) / cost : 0;
        const Cut here{static_cast<std::uint32_t>(a), box.lo[a] + share * side};
        if (gain > largest) {
          largest = gain;
          cut = here;
        }
        if (2 * k == parts && side > longest) {
          longest = side;
          middle = here;
        }
      }
    }
    return cut.axis == BoxTreeNode::leaf ? middle : cut;
  }

  // What lies beside a peak may belong to it, although no point has met it: a share of what the leaves of a box weigh
  // is spread evenly over the box. They are the last ones, from this node and this leaf on.
  void even_out(std::size_t node, std::size_t leaf, double volume) {
    double weight = 0;
    for (std::size_t i = node; i < nodes.size(); ++i) weight += nodes[i].axis == BoxTreeNode::leaf ? nodes[i].value : 0;
    for (std::size_t i = node; i < nodes.size(); ++i)
      if (nodes[i].axis == BoxTreeNode::leaf)
        nodes[i].value = (1 - even_share) * nodes[i].value + even_share * weight * volumes[leaf++] / volume;
  }

  // Adds the nodes of a box; leaves weigh what they cost. A subtree that does not pay becomes a leaf again.
  Cost grow(const Open& box, double parent) {
    const Halves all = sums(box);
    const double first = std::hypot(all[0].spread() * std::sqrt(0.9), parent * std::sqrt(0.1)),
                 second = all[1].spread();
    const Cost alone{box.volume * first, box.volume * (first > 0 ? second * second / first : 0)};
    const Cut cut = best(box, all);
    const std::size_t node = nodes.size(), leaf = volumes.size();
    if (cut.axis != BoxTreeNode::leaf) {
      nodes.push_back({cut.axis, cut.at});
      const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
      const auto middle = std::stable_partition(at(box.first), at(box.last),
                                                [&](std::size_t k) { return samples.point(k)[cut.axis] < cut.at; });
      Open below = box, above = box;
      below.last = above.first = static_cast<std::size_t>(middle - order.begin());
      below.hi[cut.axis] = above.lo[cut.axis] = cut.at;
      const double share = (cut.at - box.lo[cut.axis]) / (box.hi[cut.axis] - box.lo[cut.axis]);
      below.volume *= share;
      above.volume *= 1 - share;
      const Cost a = grow(below, first), b = grow(above, first), both{a.asked + b.asked, a.paid + b.paid};
      if (both.total() < (1 - worthwhile) * alone.total()) {
        even_out(node, leaf, box.volume);
        return both;
      }
      nodes.resize(node);
      volumes.resize(leaf);
    }
    nodes.push_back({BoxTreeNode::leaf, box.volume * (all[0] + all[1]).spread()});
    volumes.push_back(box.volume);
    return alone;
  }
};

} // namespace

BoxTree importance_tree(const WeightedSamples& samples) {
  const auto d = static_cast<std::size_t>(samples.dim);
  Learner learner{samples, std::vector<std::size_t>(samples.size())};
  std::iota(learner.order.begin(), learner.order.end(), std::size_t{0});
  learner.grow({0, samples.size(), std::vector<double>(d, 0.0), std::vector<double>(d, 1.0), 1}, 0);
  double total = 0;
  for (const BoxTreeNode& n : learner.nodes)
    if (n.axis == BoxTreeNode::leaf) total += n.value;
  std::size_t leaf = 0;
  for (BoxTreeNode& n : learner.nodes)
    if (n.axis == BoxTreeNode::leaf) {
      const double volume = learner.volumes[leaf++];
      n.value = total > 0 ? (1 - uniform_share) * n.value / total + uniform_share * volume : volume;
    }
  return BoxTree(samples.dim, learner.nodes);
}

} // namespace mc

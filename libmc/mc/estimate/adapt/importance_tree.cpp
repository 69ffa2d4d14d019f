#include <mc/estimate/adapt/importance_tree.h>
#include <mc/random/hash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace mc {

namespace {

constexpr double uniform_share = 0.1;  // of the probability, uniform over the cube
constexpr double even_share = 0.02;    // of the probability of a box that is cut, uniform over the box
constexpr double mean_share = 0.25;    // weight of the squared mean relative to the variance
constexpr double fewest = 16;          // minimum number of points of either half in a box
constexpr double worthwhile = 0.02;    // minimum share of the cost of a box that a cut must save
constexpr double resolution = 0x1p-12; // least side of a box that is cut, in units of its upper end
constexpr std::size_t parts = 8;       // equal parts of a side; cuts lie between them

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
  // Root of the cost per point in the box.
  double spread() const {
    if (!(weight > 0)) return 0;
    const double mean = value / weight,
                 variance = std::max(square / weight - mean * mean, 0.0) * n / std::max(n - 1, 1.0);
    return std::sqrt(variance + mean_share * mean * mean);
  }
};
using Halves = std::array<Sums, 2>;

struct Open {
  std::size_t first, last; // range in Learner::order
  std::vector<double> lo, hi;
  double volume;
};

struct Cut {
  std::uint32_t axis = BoxTreeNode::leaf;
  double at = 0;
};

// Cost of a subtree. The first half of the points determines the shares of the leaves (`asked`), the second half the
// resulting cost (`paid`).
struct Cost {
  double asked = 0, paid = 0;
  double total() const { return asked * paid; }
};

struct Learner {
  const WeightedSamples& samples;
  std::vector<std::size_t> order;
  std::vector<BoxTreeNode> nodes = {};
  std::vector<double> volumes = {}; // of the leaves

  // Half that contains point k. Uses a hash, because points with even index of a sequence lie on one side.
  static std::size_t half(std::size_t k) { return mix64(k) & 1; }

  Halves sums(const Open& box) const {
    Halves all{};
    for (std::size_t i = box.first; i < box.last; ++i)
      all[half(order[i])].add(samples.weights[order[i]], samples.values[order[i]]);
    return all;
  }

  // Cut with the largest gain for the first half of the points. If there is no gain, cuts the longest side in the
  // middle, because symmetric structure shows only in smaller boxes.
  Cut best(const Open& box, const Halves& all) const {
    Cut cut, middle;
    double largest = worthwhile, longest = 0;
    for (std::size_t a = 0; a < box.lo.size(); ++a) {
      std::array<Halves, parts> part{};
      const double side = box.hi[a] - box.lo[a];
      if (side < resolution * box.hi[a]) continue;
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

  // Spreads a share of the weight of the leaves evenly over the box, because points may have missed the neighbourhood
  // of a peak. The leaves of the box are the last ones, from `node` and `leaf` on.
  void even_out(std::size_t node, std::size_t leaf, double volume) {
    double weight = 0;
    for (std::size_t i = node; i < nodes.size(); ++i) weight += nodes[i].axis == BoxTreeNode::leaf ? nodes[i].value : 0;
    for (std::size_t i = node; i < nodes.size(); ++i)
      if (nodes[i].axis == BoxTreeNode::leaf)
        nodes[i].value = (1 - even_share) * nodes[i].value + even_share * weight * volumes[leaf++] / volume;
  }

  // Adds the nodes of a box; the weight of a leaf is its cost. Replaces a subtree that does not pay off by a leaf.
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

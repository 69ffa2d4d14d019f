#include <mc/core/error.h>
#include <mc/random/uniform.h>
#include <mc/table/box_tree.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

using mc::BoxTree;
using mc::BoxTreeNode;

// A random tree: planes anywhere in their boxes, weights over many orders of magnitude, including 0.
std::vector<BoxTreeNode> random_nodes(std::uint64_t seed, int dim, int depth, std::vector<double> lo,
                                      std::vector<double> hi) {
  const auto random = [&](std::uint64_t k) { return mc::hash_uniform<double>(seed, k); };
  if (depth == 0 || random(1) < 0.1)
    return {{BoxTreeNode::leaf, random(2) < 0.2 ? 0 : std::pow(10.0, 20 * random(3) - 10)}};
  const auto axis = static_cast<std::uint32_t>(random(4) * dim);
  const double at = lo[axis] + (hi[axis] - lo[axis]) * (0.05 + 0.9 * random(5));
  std::vector<BoxTreeNode> nodes = {{axis, at}};
  std::vector<double> middle = hi;
  middle[axis] = at;
  for (const BoxTreeNode& n : random_nodes(mc::hash(seed, 6), dim, depth - 1, lo, middle)) nodes.push_back(n);
  lo[axis] = at;
  for (const BoxTreeNode& n : random_nodes(mc::hash(seed, 7), dim, depth - 1, lo, hi)) nodes.push_back(n);
  return nodes;
}
BoxTree random_tree(std::uint64_t seed, int dim, int depth) {
  std::vector<BoxTreeNode> nodes =
      random_nodes(seed, dim, depth, std::vector<double>(static_cast<std::size_t>(dim), 0.0),
                   std::vector<double>(static_cast<std::size_t>(dim), 1.0));
  nodes.back().value = 1; // at least one positive weight
  return BoxTree(dim, nodes);
}

double volume(const BoxTree& tree, std::size_t leaf) {
  double v = 1;
  for (const BoxTree::AxisExtent& s : tree.extents(leaf)) v *= s.x_hi - s.x_lo;
  return v;
}

TEST(BoxTree, BoxesFillTheCubeAndProbabilitiesFollowTheWeights) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const BoxTree tree = random_tree(seed, 1 + static_cast<int>(seed % 6), 8);
    double total = 0, filled = 0, mass = 0;
    for (const BoxTreeNode& n : tree.nodes()) total += n.axis == BoxTreeNode::leaf ? n.value : 0;
    std::size_t leaf = 0;
    for (const BoxTreeNode& n : tree.nodes())
      if (n.axis == BoxTreeNode::leaf) {
        const double p = tree.density(leaf) * volume(tree, leaf);
        // Each plane rounds its share to an ulp of u.
        EXPECT_NEAR(p, n.value / total, 16 * 0x1p-52 + static_cast<double>(tree.leaves()) * 0x1p-53) << seed;
        EXPECT_EQ(tree.density(leaf) > 0, n.value > 0) << seed;
        filled += volume(tree, leaf++);
        mass += p;
      }
    EXPECT_EQ(leaf, tree.leaves());
    EXPECT_NEAR(filled, 1, 1e-12);
    EXPECT_NEAR(mass, 1, 1e-12);
  }
}

// Look-up by u and by x finds the same leaf, and the Jacobian is the inverse of the density. Includes the edges of u.
TEST(BoxTree, MapKeepsToTheLeaf) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const BoxTree tree = random_tree(seed, 3, 9);
    for (std::uint64_t i = 0; i < 500; ++i) {
      std::array<double, 3> u;
      for (std::size_t d = 0; d < 3; ++d) {
        const double ends[] = {0, mc::one_minus_epsilon<double>, mc::hash_uniform<double>(seed, i, d), 0.5};
        u[d] = ends[mc::hash(seed, i, 10 + d) % 4];
      }
      const std::size_t leaf = tree.leaf_of_u(u);
      const double jacobian = tree.map(u);
      for (const double x : u) ASSERT_TRUE(x >= 0 && x < 1);
      ASSERT_EQ(tree.leaf_of_x(u), leaf);
      ASSERT_GT(tree.density(leaf), 0);
      ASSERT_DOUBLE_EQ(jacobian * tree.density(leaf), 1);
    }
  }
}

TEST(BoxTree, FollowsAFunction) {
  const auto f = [](std::span<const double> x) { return x[0] > 0.75 && x[1] < 0.25 ? 1.0 : 0.01; };
  const BoxTree tree = BoxTree::from_function(2, f, 64);
  EXPECT_EQ(tree.leaves(), 64u);
  EXPECT_NEAR(tree.density(tree.leaf_of_x(std::array{0.8, 0.2})), 1 / (0.01 + 0.99 / 16), 0.2);
  EXPECT_NEAR(tree.density(tree.leaf_of_x(std::array{0.2, 0.2})), 0.01 / (0.01 + 0.99 / 16), 0.02);
  EXPECT_EQ(BoxTree(4).leaves(), 1u);
  EXPECT_EQ(BoxTree(4).density(0), 1);
}

TEST(BoxTree, RefusesNonsense) {
  constexpr std::uint32_t leaf = BoxTreeNode::leaf;
  const auto make = [](std::vector<BoxTreeNode> nodes) { return BoxTree(2, nodes); };
  EXPECT_THROW(make({}), mc::Error);
  EXPECT_THROW(make({{leaf, 0}}), mc::Error);
  EXPECT_THROW(make({{leaf, std::nan("")}}), mc::Error);
  EXPECT_THROW(make({{leaf, -1}}), mc::Error);
  EXPECT_THROW(make({{leaf, 1}, {leaf, 1}}), mc::Error);
  EXPECT_THROW(make({{0, 0.5}, {leaf, 1}}), mc::Error);
  EXPECT_THROW(make({{2, 0.5}, {leaf, 1}, {leaf, 1}}), mc::Error);
  EXPECT_THROW(make({{0, 1.0}, {leaf, 1}, {leaf, 1}}), mc::Error);
  EXPECT_THROW(make({{0, std::nan("")}, {leaf, 1}, {leaf, 1}}), mc::Error);
  EXPECT_THROW(make({{0, 0.5}, {0, 0.7}, {leaf, 1}, {leaf, 1}, {leaf, 1}}), mc::Error);
  EXPECT_THROW(BoxTree(0), mc::Error);
  EXPECT_THROW(BoxTree::from_function(
                   2, [](std::span<const double>) { return -1.0; }, 4),
               mc::Error);
  EXPECT_THROW(BoxTree::from_function(
                   2, [](std::span<const double>) { return 0.0; }, 4),
               mc::Error);
  EXPECT_THROW(BoxTree::from_function(
                   2, [](std::span<const double>) { return 1.0; }, 0),
               mc::Error);
}

// The small weight lies on either side of a plane.
TEST(BoxTree, SmallWeightsKeepAProbability) {
  for (const double tiny : {1e-15, 1e-17, 1e-50, 1e-300})
    for (const bool above : {false, true}) {
      const std::vector<BoxTreeNode> nodes = {
          {0, 0.5}, {BoxTreeNode::leaf, above ? 1 : tiny}, {BoxTreeNode::leaf, above ? tiny : 1}};
      const BoxTree tree(1, nodes);
      const double p = tree.density(above ? 1 : 0) / 2;
      EXPECT_NEAR(p, tiny, 0x1p-52) << tiny;
      EXPECT_GE(p, 0x1p-53) << tiny;
    }
}

// A leaf with nearly all of the weight must leave representable numbers for its neighbours, for any number of cuts.
TEST(BoxTree, ManySmallWeightsKeepTheirProbabilities) {
  for (const bool mirrored : {false, true}) {
    std::vector<BoxTreeNode> nodes;
    for (int k = 1; k <= 40; ++k) { // a large leaf, then ever smaller boxes on one side
      nodes.push_back({0, mirrored ? std::ldexp(1.0, -k) : 1 - std::ldexp(1.0, -k)});
      if (!mirrored) nodes.push_back({BoxTreeNode::leaf, k == 1 ? 1 : 1e-30});
    }
    nodes.push_back({BoxTreeNode::leaf, 1e-30});
    for (int k = 40; mirrored && k >= 1; --k) nodes.push_back({BoxTreeNode::leaf, k == 1 ? 1 : 1e-30});
    const BoxTree tree(1, nodes);
    for (std::size_t leaf = 0; leaf < tree.leaves(); ++leaf) EXPECT_GT(tree.density(leaf), 0) << mirrored << leaf;
  }
}

TEST(BoxTree, OfAFunctionInAnyUnit) {
  const auto tree = [](double unit) {
    return BoxTree::from_function(
        2, [unit](std::span<const double> x) { return unit * (x[0] * x[1] + 0.1); }, 64);
  };
  const BoxTree one = tree(1);
  for (const double unit : {0x1p-700, 0x1p-300, 0x1p300, 0x1p900}) {
    const BoxTree other = tree(unit);
    for (std::size_t leaf = 0; leaf < 64; ++leaf) EXPECT_EQ(other.density(leaf), one.density(leaf)) << unit;
  }
}

} // namespace

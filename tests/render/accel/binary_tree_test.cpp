#include <render/accel/binary_tree.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace render;

// Boxes by one of several rules, between -scale and scale.
std::vector<Bounds> boxes_of(std::size_t n, int rule, Float scale) {
  mc::Pcg random(n);
  std::vector<Bounds> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 p = 2 * Vec3(random.point<Float, 3>()) - Vec3::Ones();
    Float size = Float(0.01);
    switch (rule) {
    case 0: break;                                               // at random
    case 1: p[1] = Float(0.25); break;                           // in a plane
    case 2: p.setZero(); break;                                  // all the same
    case 3: size = random.uniform<Float>() < 0.1 ? 1 : 0; break; // points, and a few large ones
    case 4:
      p *= std::pow(Float(0.9), Float(i));
      size = 0;
      break;                                 // ever closer to the origin
    default: p = p.array().sign(); size = 0; // at eight places
    }
    Bounds& b = boxes.emplace_back();
    b.add(scale * p);
    b.add(scale * (p + size * Vec3(random.point<Float, 3>())));
  }
  return boxes;
}

BinaryTree binary_tree(const std::vector<Bounds>& boxes, std::uint32_t lanes) {
  return {boxes.size(), [&](std::size_t i) { return boxes[i]; }, lanes};
}

Bounds around(const Bounds& a, const Bounds& b) {
  Bounds both = a;
  both.add(b);
  return both;
}
std::vector<std::uint32_t> flat(const std::vector<std::vector<std::uint32_t>>& lists) {
  std::vector<std::uint32_t> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}
bool same(const Bounds& a, const Bounds& b) { return a.lo == b.lo && a.hi == b.hi; }

// Every box is in one leaf, leaves are no larger than asked for, and each node's box is that of what it holds.
TEST(BinaryTree, ContainsEachBoxOnceWithinMaxDepth) {
  for (const std::size_t n : {1, 2, 7, 8, 9, 40, 1000, 4096, 4097, 20000, 70000})
    for (int rule = 0; rule < 6; ++rule)
      for (const Float scale : {Float(1), Float(1e-38), Float(1e37)}) {
        SCOPED_TRACE(testing::Message() << n << " boxes by rule " << rule << " times " << scale);
        const auto boxes = boxes_of(n, rule, scale);
        const std::uint32_t lanes = n % 3 == 0 ? 1 : 8;
        BinaryTree tree = binary_tree(boxes, lanes);
        const auto& nodes = tree.nodes();
        std::vector<int> depth(nodes.size()), seen(n);
        std::size_t visited = 0;
        for (const std::uint32_t i : flat(tree.parents_first())) {
          const BinaryTree::Node& node = nodes[i];
          ++visited;
          ASSERT_LE(depth[i], BinaryTree::max_depth);
          if (node.count == 0) {
            ASSERT_TRUE(same(node.box, around(nodes[node.left].box, nodes[node.right].box)));
            depth[node.left] = depth[node.right] = depth[i] + 1;
            continue;
          }
          ASSERT_LE(node.count, lanes);
          Bounds box;
          for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            box.add(boxes[tree.order()[k]]);
            ++seen[tree.order()[k]];
          }
          ASSERT_TRUE(same(node.box, box));
        }
        EXPECT_EQ(visited, nodes.size());
        EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ptrdiff_t(n));
      }
}

TEST(BinaryTree, IsTheSameForAnyNumberOfThreads) {
  const auto boxes = boxes_of(150000, 3, 1);
  BinaryTree many = binary_tree(boxes, 8);
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  BinaryTree one = binary_tree(boxes, 8);
  EXPECT_EQ(many.order(), one.order());
  EXPECT_EQ(many.parents_first(), one.parents_first());
  ASSERT_EQ(many.nodes().size(), one.nodes().size());
  for (std::size_t i = 0; i < one.nodes().size(); ++i) {
    const auto &a = many.nodes()[i], &b = one.nodes()[i];
    ASSERT_TRUE(same(a.box, b.box) && a.first == b.first && a.count == b.count && a.left == b.left &&
                a.right == b.right);
  }
}

// Leaves hold up to eight boxes, each cluster more.
TEST(BinaryTree, KeepsClustersApart) {
  mc::Pcg random(5);
  std::vector<Bounds> boxes;
  for (int cluster = 0; cluster < 64; ++cluster) {
    const Vec3 center = random.point<Float, 3>();
    for (int i = 0; i < cluster + 9; ++i)
      boxes.emplace_back().add(center + Float(1e-3) * Vec3(random.point<Float, 3>()));
  }
  const BinaryTree tree = binary_tree(boxes, 8);
  for (const auto& node : tree.nodes()) {
    const Float size = (node.box.hi - node.box.lo).maxCoeff();
    EXPECT_TRUE(node.count == 0 || size < Float(2e-3)) << size;
  }
}

} // namespace

#include <render/accel/wide_tree.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace render;

std::vector<Bounds> random_boxes(int n, Float size) {
  mc::Pcg random(1);
  std::vector<Bounds> boxes;
  for (int i = 0; i < n; ++i) {
    Bounds box;
    const Vec3 p = random.point<Float, 3>();
    box.add(p);
    box.add(p + size * Vec3(random.point<Float, 3>()));
    boxes.push_back(box);
  }
  return boxes;
}

WideTree wide_tree(const std::vector<Bounds>& boxes, std::uint32_t lanes = WideTree::block) {
  return {boxes.size(), [&](std::size_t i) { return boxes[i]; }, lanes};
}

TEST(WideTree, LeavesHoldEveryBoxOnceInBlocks) {
  for (const int n : {1, 2, 4, 5, 9, 100, 3000, 30000})
    for (const Float size : {Float(0), Float(0.1)}) {
      const WideTree tree = wide_tree(random_boxes(n, size));
      std::set<std::uint32_t> seen;
      for (const auto& leaf : tree.leaves()) {
        EXPECT_GE(leaf.count, 1u);
        EXPECT_LE(leaf.count, std::uint32_t{WideTree::block});
        for (std::uint32_t i = 0; i < leaf.count; ++i) EXPECT_TRUE(seen.insert(tree.order()[leaf.first + i]).second);
      }
      EXPECT_EQ(seen.size(), static_cast<std::size_t>(n));
    }
}

TEST(WideTree, VisitsEveryLeafWithABoxThatTheRayMeets) {
  const auto boxes = random_boxes(20000, Float(0.05)); // enough boxes for a parallel build
  const WideTree tree = wide_tree(boxes);
  mc::Pcg random(2);
  for (int i = 0; i < 500; ++i) {
    Ray ray{random.point<Float, 3>(), mc::UniformSphere<Float>{}.sample(random.point<Float, 2>())};
    if (i % 3 == 0) ray.d = Vec3::Unit(i % 9 / 3) * Float(i % 2 ? 1 : -1);
    if (i % 5 == 0) ray.o = boxes[static_cast<std::size_t>(i)].lo; // on box planes
    std::set<std::uint32_t> visited;
    Float t_max = mc::infinity<Float>;
    tree.traverse(ray, t_max, [&](std::uint32_t leaf, Float&) {
      for (std::uint32_t k = 0; k < tree.leaves()[leaf].count; ++k)
        visited.insert(tree.order()[tree.leaves()[leaf].first + k]);
      return false;
    });
    for (std::uint32_t b = 0; b < boxes.size(); ++b) {
      double enter = 0, exit = mc::infinity<double>;
      for (int a = 0; a < 3; ++a) {
        const double o = double(ray.o[a]), d = double(ray.d[a]), lo = double(boxes[b].lo[a]),
                     hi = double(boxes[b].hi[a]);
        if (d == 0) {
          if (o < lo || o > hi) {
            enter = mc::infinity<double>;
            exit = 0;
          }
          continue;
        }
        enter = std::max(enter, std::min((lo - o) / d, (hi - o) / d));
        exit = std::min(exit, std::max((lo - o) / d, (hi - o) / d));
      }
      if (enter > exit) continue;
      EXPECT_EQ(visited.count(b), 1u) << "ray " << i << " box " << b;
    }
  }
}

// Boxes that shrink towards a corner make the deepest trees. The traversal stack is large enough for them.
TEST(WideTree, DeepTree_IsTraversedCompletely) {
  std::vector<Bounds> boxes;
  for (int i = 0; i < 2000; ++i) {
    Bounds box;
    box.add(Vec3::Zero());
    box.add(Vec3::Constant(std::pow(Float(0.95), Float(i))));
    boxes.push_back(box);
  }
  const WideTree tree = wide_tree(boxes, 1);
  std::size_t visited = 0;
  Float t_max = mc::infinity<Float>;
  tree.traverse({Vec3::Constant(-1), Vec3::Ones()}, t_max, [&](std::uint32_t, Float&) {
    ++visited;
    return false;
  });
  EXPECT_EQ(visited, boxes.size());
}

TEST(WideTree, StopsWhenALeafSaysSo) {
  const WideTree tree = wide_tree(random_boxes(500, Float(0.5)));
  const Ray ray{Vec3::Constant(-1), Vec3::Ones().normalized()};
  int calls = 0;
  Float t_max = mc::infinity<Float>;
  tree.traverse(ray, t_max, [&](std::uint32_t, Float&) { return ++calls == 2; });
  EXPECT_EQ(calls, 2);
}

TEST(WideTree, DiscardLeaves_ReleasesMemory) {
  WideTree tree = wide_tree(random_boxes(100, Float(0.1)));
  tree.discard_leaves();
  EXPECT_EQ(tree.order().capacity() + tree.leaves().capacity(), 0u);
}

TEST(WideTree, EmptyTreesAndBoxes) {
  EXPECT_TRUE(wide_tree({}).empty());
  EXPECT_EQ(Bounds{}.half_area(), Float(0));
}

} // namespace

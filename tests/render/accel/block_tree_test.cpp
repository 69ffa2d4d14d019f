#include <render/accel/block_tree.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

// A third block type, as a new shape would add one: planes z = const, defined by the area of a shape.
class LevelBlock {
 public:
  using ShapeType = Sphere;
  static constexpr std::uint32_t max_brute_force = 16;
  struct Primitive {
    Float z;
    int shape;
    Bounds bounds() const { return {Vec3(-1, -1, z), Vec3(1, 1, z)}; }
  };
  static std::size_t size(const Sphere&) { return 1; }
  static Primitive* collect(const Sphere& shape, int index, std::size_t, std::size_t, Primitive* to) {
    *to = {Float(shape.area()), index};
    return to + 1;
  }
  struct RaySetup {
    Float inverse;
    explicit RaySetup(const Ray& ray) : inverse(1 / ray.d.z()) {}
  };
  void set(std::uint32_t lane, const Primitive& p) { levels_[lane] = p; }
  template <bool any> bool intersect(const Ray& ray, const RaySetup& prepared, Float& t_max, Hit& hit) const {
    bool found = false;
    for (const Primitive& p : levels_) {
      const Float t = (p.z - ray.o.z()) * prepared.inverse;
      if (!(t > 0 && t < t_max)) continue;
      t_max = t;
      hit = {t, p.shape, 0, 0, 0};
      found = true;
    }
    return found;
  }

 private:
  Primitive levels_[8] = {};
};

// With and without a tree, the nearest of n levels is found. The height of a level is the area 4 pi r^2 of a sphere.
TEST(BlockTree, FindsTheNearestOfFewAndMany) {
  for (const int n : {1, 7, 16, 17, 200}) {
    std::vector<Shape> shapes;
    for (int i = 0; i < n; ++i) shapes.push_back(Sphere(Vec3d::Zero(), 1 + (i * 7 % n)));
    std::vector<const Shape*> pointers;
    for (const Shape& s : shapes) pointers.push_back(&s);
    const BlockTree<LevelBlock> tree(pointers);
    EXPECT_EQ(tree.bounds().lo.z(), Float(4 * mc::pi<double>));
    Float t_max = mc::infinity<Float>;
    Hit hit;
    ASSERT_TRUE(tree.intersect<false>({Vec3::Zero(), Vec3::UnitZ()}, t_max, hit)) << n;
    EXPECT_EQ(hit.shape, 0) << n;
    EXPECT_EQ(t_max, hit.t);
    EXPECT_FALSE(tree.intersect<true>({Vec3::Zero(), -Vec3::UnitZ()}, t_max, hit)) << n;
  }
}

TEST(BlockTree, OfNothingIsNeverHit) {
  Float t_max = mc::infinity<Float>;
  Hit hit;
  EXPECT_FALSE(BlockTree<LevelBlock>().intersect<false>({Vec3::Zero(), Vec3::UnitZ()}, t_max, hit));
}

} // namespace

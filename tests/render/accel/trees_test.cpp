#include <render/accel/trees.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

// For every instruction set, the hit is the nearest of the hits with each single shape, with equal bits.
TEST(Trees, EveryInstructionSetGivesTheSameBits) {
#if defined(RENDER_TRACE_CHOSEN)
  std::vector<const Bvh::Trace*> sets = {&trace_baseline};
  if (__builtin_cpu_supports("avx2")) sets.push_back(&trace_avx2);
  if (__builtin_cpu_supports("avx512dq")) sets.push_back(&trace_avx512);
#else
  const std::vector<const Bvh::Trace*> sets = {&trace_native};
#endif
  mc::Pcg random(7);
  const auto vector = [&](double size) { return Vec3d(size * random.point<double, 3>()); };
  std::vector<Shape> shapes;
  for (int i = 0; i < 100; ++i) {
    const Vec3d o = vector(1);
    const auto near = [&] { return Vec3((o + vector(0.2)).cast<Float>()); };
    shapes.emplace_back(TriangleMesh({near(), near(), near()}, {{0, 1, 2}}));
    shapes.emplace_back(
        Disk(Transform::translate(vector(1)) * Transform::rotate(vector(1), 100) * Transform::scale({0.1, 0.05, 1})));
    shapes.emplace_back(Cylinder(vector(1), vector(1), 0.02));
    shapes.emplace_back(Sphere(vector(1), 0.05 * random.uniform<double>() + 0.001));
  }
  std::vector<const Shape*> all;
  for (const Shape& s : shapes) all.push_back(&s);
  const Bvh::Trees trees(all);
  std::vector<Bvh> alone;
  for (const Shape* s : all) alone.emplace_back(std::span(&s, 1));
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{vector(1).cast<Float>(), mc::UniformSphere<Float>{}.sample(random.point<Float, 2>())};
    std::optional<Hit> expected;
    for (std::size_t k = 0; k < alone.size(); ++k)
      if (const auto met = alone[k].intersect(ray); met && (!expected || met->t < expected->t)) {
        expected = met;
        expected->shape = static_cast<int>(k);
      }
    hits += expected.has_value();
    for (const Bvh::Trace* set : sets) {
      Hit hit;
      ASSERT_EQ(set->nearest(trees, ray, hit), expected.has_value());
      ASSERT_EQ(set->any(trees, ray, hit), expected.has_value());
      if (!expected) continue;
      set->nearest(trees, ray, hit);
      ASSERT_EQ(hit.t, expected->t);
      ASSERT_EQ(hit.shape, expected->shape);
      ASSERT_EQ(hit.b1, expected->b1);
    }
  }
  EXPECT_GT(hits, 300);
}

} // namespace

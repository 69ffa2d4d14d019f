#include <render/shape/shape.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

static_assert(ShapeLike<Shape> && ShapeLike<Sphere> && ShapeLike<TriangleMesh>);

TEST(Shape, AnswersAsItsMember) {
  const Sphere sphere(Vec3d(0, 0, 3), 1);
  const Shape shape = sphere;
  const Vec3 ref = Vec3::Zero(), wi(0, 0, 1);
  EXPECT_EQ(shape.area(), sphere.area());
  EXPECT_EQ(shape.pdf(ref, wi), sphere.pdf(ref, wi));
  const auto a = shape.sample(ref, Vec2(Float(0.3), Float(0.7))), b = sphere.sample(ref, Vec2(Float(0.3), Float(0.7)));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->point.p, b->point.p);
  EXPECT_EQ(shape.pdf(ref, a->wi, a->point), a->pdf);
}

} // namespace

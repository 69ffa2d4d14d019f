#include <render/shape/shape.h>

#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>

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

// Lights are chosen by its spread. The projected solid angle towards the shape's middle is estimated by its samples:
// five standard errors for 400 shapes, and a thousandth, since just inside a sphere all but a few samples say the same.
TEST(Shape, FillsItsBoxAndNoMoreThanItsSpread) {
  mc::Pcg random(12);
  const auto number = [&] { return 4 * random.uniform<double>() - 2; };
  for (int trial = 0; trial < 400; ++trial) {
    const Vec3d at(number(), number(), number());
    const double size = std::pow(10, number());
    const Transform place = Transform::translate(at) * Transform::rotate({number(), number(), 1}, 90 * number()) *
                            Transform::scale({size, size, 2 * size});
    const Shape shapes[] = {Sphere(at, size), Sphere::cap(at, size, Vec3d(number(), number(), 1), size / 3),
                            TriangleMesh::rectangle(place), TriangleMesh::box(place)};
    const Shape& shape = shapes[trial % 4];
    const Vec3 ref = Vec3d(number(), number(), number()).cast<Float>(), n = (at.cast<Float>() - ref).normalized();
    mc::Moments filled;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto s = shape.sample(ref, {random.uniform<Float>(), random.uniform<Float>()});
      // A box shows half of its sides, the others lie behind.
      const double shares = trial % 4 == 3 ? 0.5 : 1;
      const double outside = s ? shape.box().exteriorDistance(s->point.p.cast<double>()) : 0;
      EXPECT_LE(outside, s ? 2 * double(s->point.error) : 0) << trial;
      filled.add(s ? shares * double(std::max(Float(0), s->wi.dot(n)) / s->pdf) : 0.0, i);
    }
    EXPECT_LE(filled.mean() - 5 * filled.std_error(), 1.001 * shape.spread(ref)) << trial;
  }
}

} // namespace

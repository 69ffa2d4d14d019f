#include <render/shape/shape.h>

#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

static_assert(ShapeLike<Shape> && ShapeLike<Sphere> && ShapeLike<TriangleMesh> && ShapeLike<Disk> &&
              ShapeLike<Cylinder>);

TEST(Shape, AnswersAsItsMember) {
  const Sphere sphere(Vec3d(0, 0, 3), 1);
  const Shape shape = sphere;
  const Vec3 ref = Vec3::Zero(), wi(0, 0, 1);
  EXPECT_EQ(shape.area(), sphere.area());
  EXPECT_EQ(shape.pdf(ref, wi), sphere.pdf(ref, wi));
  EXPECT_EQ(shape.bounding_ball().center, Vec3d(0, 0, 3));
  EXPECT_EQ(shape.bounding_ball().radius, 1);
  EXPECT_TRUE(shape.is_spherical());
  const Shape box = TriangleMesh::box(Transform::translate({1, 2, 3}));
  EXPECT_EQ(box.bounding_ball().center, Vec3d(1, 2, 3));
  EXPECT_NEAR(box.bounding_ball().radius, std::sqrt(3), 1e-12);
  EXPECT_FALSE(box.is_spherical());
  const auto a = shape.sample(ref, Vec2(Float(0.3), Float(0.7))), b = sphere.sample(ref, Vec2(Float(0.3), Float(0.7)));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->point.p, b->point.p);
  EXPECT_EQ(shape.pdf(ref, a->wi, a->point), a->pdf);
}

// With points uniform in area, uv_scale^2 area is the density of the shape's texture coordinates: each cell of a grid
// has its area.
TEST(Shape, UvScaleIsTheDensityOfTextureCoordinates) {
  mc::Pcg random(14);
  const Vec3d axis = Vec3d(1, 2, 2) / 3;
  for (const Shape& shape : {Shape(Sphere(Vec3d(1, 2, 3), 2.5)), Shape(Cylinder(Vec3d(0, 1, 0), axis, 0.7)),
                             Shape(Disk(Transform::scale(Vec3d(2, 3, 1))))}) {
    constexpr std::size_t cells = 4;
    std::array<mc::Moments, cells * cells> shares;
    for (int i = 0; i < 40'000; ++i) {
      const SurfacePoint point = *shape.sample_area(random.point<Float, 2>());
      const mc::Vec2<double> uv = shape.uv({}, point);
      const auto cell = [](double x) { return std::min(static_cast<std::size_t>(x * cells), cells - 1); };
      const double weight = mc::sqr(shape.uv_scale({}, point)) * shape.area();
      for (std::size_t k = 0; k < shares.size(); ++k)
        shares[k].add(k == cells * cell(uv[0]) + cell(uv[1]) ? weight : 0);
    }
    for (const mc::Moments& share : shares)
      EXPECT_NEAR(share.mean(), 1.0 / (cells * cells), 5 * share.std_error()) << shape.index();
  }
}

// Compares areas and solid angles with statistics of samples. Lights are selected by projected_solid_angle_bound, so
// samples estimate the projected solid angle of 400 shapes. Tolerance: five standard errors plus a thousandth, because
// just inside a sphere nearly all samples agree. Rays find the points of sample_area on the shape, and parts of equal
// area get equal counts. With 16,000 points in 16 parts, each part gets 1000 within four standard deviations of 31;
// five for the largest.
TEST(Shape, AreaIsSampledAlike) {
  mc::Pcg random(12);
  const auto counted = [&](const Shape& shape, auto&& part) {
    std::array<int, 16> counts = {};
    for (int i = 0; i < 16'000; ++i) {
      const auto point = shape.sample_area(random.point<Float, 2>());
      if (!point) return counts;
      EXPECT_NEAR(point->ng.norm(), 1, 1e-5);
      ++counts[std::min<std::size_t>(static_cast<std::size_t>(16 * part(*point)), 15)];
    }
    return counts;
  };
  const auto expect_alike = [](const std::array<int, 16>& counts) {
    for (const int n : counts) EXPECT_NEAR(n, 1000, 155);
  };
  // Bands of equal height have equal areas on a sphere and on a cap.
  expect_alike(counted(Shape(Sphere(Vec3d(1, 2, 3), 2)), [](const SurfacePoint& p) { return (p.p.z() - 1) / 4; }));
  expect_alike(counted(Shape(Sphere::cap(Vec3d::Zero(), 2, Vec3d::UnitZ(), 0.5)),
                       [](const SurfacePoint& p) { return (p.p.z() - Float(1.5)) * 2; }));
  const Shape square(TriangleMesh::rectangle(Transform::scale({4, 2, 1})));
  expect_alike(counted(square, [](const SurfacePoint& p) { return (p.p.x() + 4) / 8; }));
  expect_alike(counted(square, [](const SurfacePoint& p) { return (p.p.y() + 2) / 4; }));
  Shape forgotten = square;
  forgotten.discard_sampling_table();
  EXPECT_FALSE(forgotten.sample_area({0, 0}));
}

TEST(Shape, SolidAngleStaysBelowBound) {
  mc::Pcg random(12);
  const auto number = [&] { return 4 * random.uniform<double>() - 2; };
  for (int trial = 0; trial < 400; ++trial) {
    const Vec3d at(number(), number(), number());
    const double size = std::pow(10, number());
    const Transform place = Transform::translate(at) * Transform::rotate({number(), number(), 1}, 90 * number()) *
                            Transform::scale({size, size, 2 * size});
    const Shape shapes[] = {Sphere(at, size),
                            Sphere::cap(at, size, Vec3d(number(), number(), 1), size / 3),
                            TriangleMesh::rectangle(place),
                            TriangleMesh::box(place),
                            Disk(place),
                            Cylinder(at, place.point(Vec3d::UnitZ()), size)};
    const Shape& shape = shapes[trial % 6];
    const Vec3 ref = Vec3d(number(), number(), number()).cast<Float>(), n = (at.cast<Float>() - ref).normalized();
    mc::Moments filled;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto s = shape.sample(ref, {random.uniform<Float>(), random.uniform<Float>()});
      // Half of the sides of a box, and of a cylinder without its ends, are visible; the others lie behind them.
      const double shares = trial % 6 == 3 || trial % 6 == 5 ? 0.5 : 1;
      const double outside = s ? shape.box().exteriorDistance(s->point.p.cast<double>()) : 0;
      EXPECT_LE(outside, s ? 2 * double(s->point.error) : 0) << trial;
      filled.add(s ? shares * double(std::max(Float(0), s->wi.dot(n)) / s->pdf) : 0.0, i);
    }
    EXPECT_LE(filled.mean() - 5 * filled.std_error(), 1.001 * shape.projected_solid_angle_bound(ref)) << trial;
  }
}

} // namespace

#include <mc/check/subject/chart_axes.h>

#include <mc/domain/triangle.h>

#include <gtest/gtest.h>

namespace {

using mc::Axis, mc::chart_axes, mc::Vec2, mc::Vec3;

// Compares the axes of a domain of directions or of the plane with angles and radii of the chart's points.
template <class D> void expect_polar(const D& domain, bool directions) {
  const std::vector<Axis> axes = chart_axes(domain);
  ASSERT_EQ(axes.size(), 2u);
  for (const Vec2<double>& v : {Vec2<double>(0.1, 0.2), Vec2<double>(0.7, 0.9)}) {
    const auto x = domain.from_unit(v);
    const double first = directions ? 180 / mc::pi<double> * std::atan2(std::hypot(x[0], x[1]), x[x.size() - 1])
                                    : std::hypot(x[0], x[1]);
    EXPECT_NEAR(axes[0].value(v[0]), first, 1e-9);
    EXPECT_NEAR(axes[1].value(v[1]), 180 / mc::pi<double> * std::atan2(x[1], x[0]) + (x[1] < 0 ? 360 : 0), 1e-9);
  }
}

TEST(ChartAxes, PolarDomains_MatchAnglesAndRadii) {
  expect_polar(mc::Sphere<double>{}, true);
  expect_polar(mc::Hemisphere<double>{}, true);
  expect_polar(mc::Cap<double>{0.01}, true);
  expect_polar(mc::Disk<double>{}, false);
  expect_polar(mc::Annulus<double>{0.5, 2}, false);
}

TEST(ChartAxes, Ball_HasRadiusAndAngles) {
  const auto axes = chart_axes(mc::Ball<double>{});
  const Vec3<double> v(0.3, 0.2, 0.6), p = mc::Ball<double>{}.from_unit(v);
  ASSERT_EQ(axes.size(), 3u);
  EXPECT_DOUBLE_EQ(axes[0].value(v[0]), p.norm());
  EXPECT_NEAR(axes[1].value(v[1]), 180 / mc::pi<double> * std::acos(p.z() / p.norm()), 1e-12);
  EXPECT_DOUBLE_EQ(axes[2].value(v[2]), 216);
}

TEST(ChartAxes, LinesAndBoxes_MatchCoordinates) {
  EXPECT_DOUBLE_EQ(chart_axes(mc::Interval<double>{-3, 7})[0].value(0.3), (mc::Interval<double>{-3, 7}).from_unit(0.3));
  EXPECT_DOUBLE_EQ(chart_axes(mc::HalfLine<double>{2, -1})[0].value(0.3), (mc::HalfLine<double>{2, -1}).from_unit(0.3));
  EXPECT_DOUBLE_EQ(chart_axes(mc::RealLine<double>{2, 3})[0].value(0.3), (mc::RealLine<double>{2, 3}).from_unit(0.3));
  const auto box = chart_axes(mc::Square<double>{{0, 1}, {2, 4}});
  EXPECT_EQ(box[1].name, "y");
  EXPECT_DOUBLE_EQ(box[1].value(0.5), 2.5);
}

TEST(ChartAxes, Product_NamesEachAxisOnce) {
  const auto plane = chart_axes(mc::Plane<double>{});
  EXPECT_EQ(plane[0].name, "x");
  EXPECT_EQ(plane[1].name, "y");
}

TEST(ChartAxes, Triangle_HasBarycentricCoordinates) {
  const auto axes = chart_axes(mc::Triangle<double>{});
  const Vec2<double> b = mc::Triangle<double>{}.from_unit({0.3, 0.6});
  EXPECT_DOUBLE_EQ(axes[0].value(0.3), 1 - b[0]);
  EXPECT_DOUBLE_EQ(axes[1].value(0.6), b[1] / (1 - b[0]));
}

// A triangle without an overload of chart_axes.
struct Unknown : mc::Triangle<double> {};

TEST(ChartAxes, UnknownDomain_ShowsChartCoordinates) {
  const auto axes = chart_axes(Unknown{});
  EXPECT_EQ(axes[0].name, "v0");
  EXPECT_EQ(axes[1].name, "v1");
  EXPECT_DOUBLE_EQ(axes[1].value(0.25), 0.25);
}

} // namespace

#include <mc/check/subject/axis.h>

#include <gtest/gtest.h>

#include <set>

namespace {

using mc::Axis;
using Scale = mc::Axis::Scale;

TEST(Axis, Value_FollowsScale) {
  EXPECT_DOUBLE_EQ((Axis{"x", Scale::linear, -3, 7}).value(0.25), -0.5);
  EXPECT_DOUBLE_EQ((Axis{"r", Scale::radius, 0, 1}).value(0.25), 0.5);
  EXPECT_DOUBLE_EQ((Axis{"r", Scale::radius, 3, 5}).value(0.5), std::sqrt(17.0));
  EXPECT_DOUBLE_EQ((Axis{"r", Scale::ball_radius, 0, 2}).value(0.125), 1);
  EXPECT_DOUBLE_EQ((Axis{"x", Scale::half_line, 1, 2}).value(0.5), 3);
  EXPECT_DOUBLE_EQ((Axis{"x", Scale::real_line, 4, 2}).value(0.5), 4);
  EXPECT_DOUBLE_EQ((Axis{"phi", Scale::azimuth, 0, 1}).value(0.25), 90);
  EXPECT_NEAR((Axis{"theta", Scale::polar, 0, 2}).value(0.5), 90, 1e-12);
  EXPECT_NEAR((Axis{"theta", Scale::polar, 0, 1}).value(0.5), 60, 1e-12);
  EXPECT_NEAR((Axis{"theta", Scale::polar, 0, 1e-20}).value(1), 180 / std::numbers::pi * std::sqrt(2e-20), 1e-21)
      << "no cancellation at the pole";
}

TEST(Axis, Unit_AnglesAreDegrees) {
  EXPECT_EQ((Axis{"phi", Scale::azimuth, 0, 1}).unit(), "deg");
  EXPECT_EQ(Axis{}.unit(), "");
  std::set<std::string_view> names;
  for (const Scale s : {Scale::linear, Scale::radius, Scale::ball_radius, Scale::half_line, Scale::real_line,
                        Scale::polar, Scale::azimuth})
    names.insert(name(s));
  EXPECT_EQ(names.size(), 7u);
}

} // namespace

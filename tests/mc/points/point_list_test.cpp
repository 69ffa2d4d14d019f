#include <mc/core/error.h>
#include <mc/points/point_list.h>

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace {

TEST(PointList, RowsAreSideBySide) {
  const std::vector<double> values = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  const mc::PointList p{values, 3};
  EXPECT_EQ(p.size(), 2u);
  EXPECT_EQ(p[1][2], 0.6);
  EXPECT_NO_THROW(mc::require_unit_points(p));
}

TEST(PointList, RejectsPointsOutsideTheUnitCube) {
  for (const double bad : {-1e-300, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const std::vector<double> values = {0.5, bad};
    EXPECT_THROW(mc::require_unit_points({values, 2}), mc::Error) << bad;
  }
  const std::vector<double> three = {0, 0, 0};
  EXPECT_THROW(mc::require_unit_points({three, 2}), mc::Error);
  EXPECT_THROW(mc::require_unit_points({three, 0}), mc::Error);
  EXPECT_THROW(mc::require_unit_points({{}, 2}), mc::Error);
}

} // namespace

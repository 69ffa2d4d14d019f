#include <mc/domain/parallelogram.h>

#include "support/charts.h"
#include <mc/core/error.h>

namespace mc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Parallelogram, Chart) {
  expect_round_trip(Parallelogram<float>({0, 0, 0}, {1, 2, 3}, {-1, 0, 0.5f}), 16);
  expect_round_trip(Parallelogram<double>({0, 0, 0}, {1, 2, 3}, {-1, 0, 0.5}), 16);
  expect_jacobian(Parallelogram<Oracle>({1, 2, 3}, {1, 2, 3}, {-1, 0, Oracle(0.5)}));
  const Parallelogram<double> unit;
  EXPECT_FALSE(unit.contains({0.5, 0.5, 0.1}));
  EXPECT_FALSE(unit.contains({1.5, 0.5, 0}));
  EXPECT_FALSE(unit.contains({nan, 0.5, 0}));
}

TEST(Parallelogram, RefusesNonsense) {
  EXPECT_THROW((Parallelogram<double>({0, 0, 0}, {1, 1, 0}, {2, 2, 0})), Error);
  EXPECT_THROW((Parallelogram<double>({0, 0, nan}, {1, 0, 0}, {0, 1, 0})), Error);
}

} // namespace
} // namespace mc

#include <mc/domain/product.h>

#include "support/charts.h"
#include <mc/core/error.h>

namespace mc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(ProductDomain, Chart) {
  expect_round_trip(Plane<double>{}, 4);
  expect_jacobian(Plane<Oracle>{});
  expect_round_trip(ProductDomain<Interval<float>, HalfLine<float>>{}, 4);
  EXPECT_EQ((ProductDomain<Interval<float>, HalfLine<float>>::measure), Measure::area);
  EXPECT_FALSE(Plane<double>{}.contains({0, nan}));
}

} // namespace
} // namespace mc

#include <mc/domain/product.h>

#include "support/domain_laws.h"
#include <mc/core/error.h>

#include <cmath>

namespace mc {
namespace {

TEST(ProductDomain, Chart) {
  support::expect_domain_laws(Plane<double>{}, 4);
  support::expect_domain_laws(ProductDomain<Interval<float>, HalfLine<float>>{}, 4);
  EXPECT_EQ((ProductDomain<Interval<float>, HalfLine<float>>::measure), Measure::area);
  EXPECT_FALSE(Plane<double>{}.contains({0, std::nan("")}));
}

} // namespace
} // namespace mc

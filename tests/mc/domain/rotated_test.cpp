#include <mc/domain/rotated.h>

#include <mc/domain/hemisphere.h>

#include "support/domain_laws.h"
#include <mc/core/error.h>

#include <cmath>

namespace mc {
namespace {

TEST(RotatedDomain, Chart) {
  const Vec3<double> n = Vec3<double>(1, -2, 0.3).normalized();
  const RotatedDomain<Hemisphere<double>> turned{{}, Frame<double>::from_z(n)};
  support::expect_jacobian(turned);
  EXPECT_TRUE(turned.contains(n));
  EXPECT_FALSE(turned.contains(-n));
  EXPECT_FALSE(turned.contains({std::nan(""), 0, 1}));
  EXPECT_TRUE(turned.contains(turned.from_unit({1, 0.3}))) << "the rim";
}

} // namespace
} // namespace mc

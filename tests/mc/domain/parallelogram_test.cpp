#include <mc/domain/parallelogram.h>

#include "support/domain_laws.h"
#include <mc/core/error.h>

#include <cmath>

namespace mc {
namespace {

TEST(Parallelogram, Chart) {
  support::expect_domain_laws(Parallelogram<float>({0, 0, 0}, {1, 2, 3}, {-1, 0, 0.5f}), 16);
  support::expect_domain_laws(Parallelogram<double>({0, 0, 0}, {1, 2, 3}, {-1, 0, 0.5}), 16);
  support::expect_jacobian(Parallelogram<double>({1, 2, 3}, {1, 2, 3}, {-1, 0, 0.5}));
  const Parallelogram<double> unit;
  EXPECT_FALSE(unit.contains({0.5, 0.5, 0.1}));
  EXPECT_FALSE(unit.contains({1.5, 0.5, 0}));
  EXPECT_FALSE(unit.contains({std::nan(""), 0.5, 0}));
}

TEST(Parallelogram, RefusesNonsense) {
  EXPECT_THROW((Parallelogram<double>({0, 0, 0}, {1, 1, 0}, {2, 2, 0})), Error);
  EXPECT_THROW((Parallelogram<double>({0, 0, std::nan("")}, {1, 0, 0}, {0, 1, 0})), Error);
}

} // namespace
} // namespace mc

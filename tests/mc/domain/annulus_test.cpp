#include <mc/domain/annulus.h>

#include "support/domain_laws.h"
#include <mc/core/error.h>

#include <cmath>

namespace mc {
namespace {

TEST(Annulus, Chart) {
  for (const double inner : {0.0, 0.5, 0.99}) {
    support::expect_domain_laws(Annulus<float>(float(inner), 1), 8 / (1 - inner));
    support::expect_domain_laws(Annulus<double>(inner, 1), 8 / (1 - inner));
  }
  EXPECT_FALSE((Annulus<double>(0.5, 1).contains({0.1, 0.1})));
  EXPECT_FALSE((Annulus<double>(0.5, 1).contains({std::nan(""), 0.7})));
}

TEST(Annulus, RefusesNonsense) {
  EXPECT_THROW((Annulus<double>(1, 1)), Error);
  EXPECT_THROW((Annulus<double>(-1, 1)), Error);
  EXPECT_THROW((Annulus<double>(std::nan(""), 1)), Error);
  EXPECT_THROW((Annulus<double>(0, HUGE_VAL)), Error);
}

} // namespace
} // namespace mc

#include <mc/domain/hemisphere.h>

#include "support/domain_laws.h"

namespace {

TEST(Hemisphere, Chart) {
  support::expect_domain_laws(mc::Hemisphere<float>(), 8);
  support::expect_domain_laws(mc::Hemisphere<double>(), 8);
}

TEST(Hemisphere, EndsAtTheHorizon) {
  const mc::Hemisphere<float> hemisphere;
  EXPECT_TRUE(hemisphere.contains({1, 0, 0}));
  EXPECT_FALSE(hemisphere.contains({1, 0, -1e-7f}));
  EXPECT_FALSE(hemisphere.contains({NAN, 0, 1}));
}

} // namespace

#include <mc/estimate/estimate.h>

#include "support/files.h"

#include <gmock/gmock.h>

namespace {

TEST(Estimate, NormalInterval) {
  const mc::Estimate e{.value = 10, .std_error = 2};
  const auto [lo, hi] = e.interval(0.95);
  EXPECT_NEAR(lo, 10 - 2 * 1.959963984540054, 1e-12);
  EXPECT_NEAR(hi, 10 + 2 * 1.959963984540054, 1e-12);
}

// Quantiles of Student's t at .975: 12.7062 for 1 and 2.2622 for 9 degrees of freedom.
TEST(Estimate, StudentInterval) {
  EXPECT_NEAR((mc::Estimate{.value = 0, .std_error = 1, .dof = 1}.interval(0.95).hi), 12.7062047361747, 1e-9);
  EXPECT_NEAR((mc::Estimate{.value = 0, .std_error = 1, .dof = 9}.interval(0.95).hi), 2.26215716279820, 1e-9);
}

TEST(Estimate, RefusesNonsense) {
  for (const double confidence : {0.0, 1.0, -1.0, double(NAN)})
    EXPECT_THAT(support::error_of([&] { mc::Estimate{}.interval(confidence); }), testing::HasSubstr("must lie in (0, 1)")) << confidence;
}

} // namespace

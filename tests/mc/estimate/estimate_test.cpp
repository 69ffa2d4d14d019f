#include <mc/core/types.h>
#include <mc/estimate/estimate.h>

#include "support/files.h"

#include <gmock/gmock.h>

#include <cmath>

namespace {

TEST(Estimate, NormalInterval) {
  const mc::Estimate e{.value = 10, .std_error = 2};
  const auto [lo, hi] = e.interval(0.95);
  EXPECT_NEAR(lo, 10 - 2 * 1.959963984540054, 1e-12);
  EXPECT_NEAR(hi, 10 + 2 * 1.959963984540054, 1e-12);
}

// Quantiles of Student's t at .975: 12.7062 for 1 and 2.2622 for 9 degrees of freedom.
TEST(Estimate, StudentInterval) {
  EXPECT_NEAR(mc::Estimate::from_student_t(0, 1, 1, 2).interval(0.95).hi, 12.7062047361747, 1e-9);
  EXPECT_NEAR(mc::Estimate::from_student_t(0, 1, 9, 10).interval(0.95).hi, 2.26215716279820, 1e-9);
}

// std_error is half the 68.27 % interval for any number of values: tan(.68269 pi / 2) for one degree of freedom.
TEST(Estimate, StdErrorCoversOneSigmaForAnyDof) {
  const double probability = std::erf(std::sqrt(0.5));
  for (const double dof : {1.0, 2.0, 9.0, 23.0, 1e6}) {
    const mc::Estimate e = mc::Estimate::from_student_t(3, 0.5, dof, 0);
    EXPECT_NEAR(e.interval(probability).hi, 3 + e.std_error, 1e-12) << dof;
    EXPECT_DOUBLE_EQ(e.unwidened_std_error(), 0.5) << dof;
  }
  EXPECT_NEAR(mc::Estimate::from_student_t(0, 1, 1, 2).std_error, std::tan(probability * mc::pi<double> / 2), 1e-12);
  EXPECT_NEAR(mc::Estimate::from_student_t(0, 1, 23, 24).std_error, 1.0222, 5e-5);
  EXPECT_EQ((mc::Estimate{.value = 0, .std_error = 2}.unwidened_std_error()), 2);
}

TEST(Estimate, RefusesNonsense) {
  for (const double confidence : {0.0, 1.0, -1.0, double(NAN)})
    EXPECT_THAT(support::error_of([&] { mc::Estimate{}.interval(confidence); }),
                testing::HasSubstr("must lie in (0, 1)"))
        << confidence;
}

} // namespace

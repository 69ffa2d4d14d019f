#include <mc/estimate/hard_integrals.h>

#include <mc/estimate/integrate.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

// Each estimate agrees with its closed form within 5 standard errors of 23 degrees of freedom, alpha = 5e-5 each. If an
// exact result is impossible, the error is also small enough to detect a wrong value.
TEST(HardIntegrals, StatedValuesAreCorrect) {
  EXPECT_EQ(carlo::hard_integrals().size(), 10u);
  for (const carlo::UnitCubeIntegral& e : carlo::hard_integrals()) {
    mc::IntegrateOptions o;
    o.rel_error = 0;
    o.max_calls = 1'000'000;
    const mc::Integral r = mc::integrate_unit(e.f, e.dim, o);
    EXPECT_LE(std::abs(r.estimate.value - e.truth), 5 * r.estimate.std_error) << e.name;
    EXPECT_LE(r.estimate.std_error, 0.05 * e.truth) << e.name;
  }
}

} // namespace

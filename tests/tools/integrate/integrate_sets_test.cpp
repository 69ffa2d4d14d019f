#include <integrate/integrate_sets.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace carlo;

IntegrandSet set_of(const std::vector<std::string>& texts, const std::string& domain) {
  ExpressionContext context;
  context.domain = domain;
  return find_integrands(texts, context);
}

TEST(IntegrateSets, ResultsStandSetBySet) {
  const IntegrandSets sets = {set_of({"x", "x*x"}, "x=0:1"), set_of({"2*x", "3*x*x"}, "x=0:1")};
  mc::IntegrateOptions o;
  const mc::VectorIntegral r = integrate_sets(sets, {}, o);
  ASSERT_EQ(r.outputs.size(), 4u);
  const double truth[] = {0.5, 1.0 / 3, 1, 1};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(r.outputs[i].estimate.value, truth[i], 2e-3) << i;
}

TEST(IntegrateSets, FiniteSumIsExact) {
  mc::IntegrateOptions o;
  const mc::VectorIntegral r = integrate_sets({set_of({"k*k"}, "k=1..6")}, {}, o);
  EXPECT_EQ(r.outputs[0].estimate.value, 91);
  EXPECT_EQ(r.outputs[0].estimate.std_error, 0);
  EXPECT_EQ(r.outputs[0].interval.lo, r.outputs[0].interval.hi);
}

// The real part of this integral is 0, so an error relative to it would never be reached.
TEST(IntegrateSets, ComplexError_IsRelativeToTheModulus) {
  mc::IntegrateOptions o;
  o.max_calls = 1'000'000;
  const mc::VectorIntegral r = integrate_sets({set_of({"exp(i*_pi*x)"}, "x=0:1")}, {}, o);
  ASSERT_EQ(r.outputs.size(), 2u);
  EXPECT_EQ(r.outputs[0].stop, mc::StopReason::converged);
  const double modulus = 2 / std::acos(-1.0);
  EXPECT_NEAR(r.outputs[1].estimate.value, modulus, 5e-3 * modulus);
  EXPECT_NEAR(o.abs_error, 1e-3 * modulus, 1e-5);
}

TEST(InVariables, NamesThePlaceInTheExpressionsVariables) {
  const IntegrandSets sets = {set_of({"sqrt(x-1)"}, "x=0:4")};
  const std::string message = in_variables(mc::NotFinite(1, 2, {0.125}, "u = (0.125)"), sets);
  EXPECT_THAT(message, testing::AllOf(testing::HasSubstr("x = 0.5"), testing::HasSubstr("--nan")));
}

} // namespace

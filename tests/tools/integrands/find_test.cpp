#include <integrands/find.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using support::error_of;
using testing::HasSubstr;

TEST(FindIntegrand, FindsNamesAndExpressions) {
  EXPECT_EQ(carlo::find_integrand("pi", {}).dim, 2);
  EXPECT_EQ(carlo::find_integrand("pi", {.domain = "pi=0:2"}).f(std::vector{0.5}), 2);
  const carlo::IntegrandSet set = carlo::find_integrands({"x", "x*y"}, {.domain = "x=0:1,y=0:1"});
  ASSERT_EQ(set.integrands.size(), 2u);
  EXPECT_EQ(set.dim(), 2);
  EXPECT_EQ(carlo::measure_of(set, ""), 1);
  EXPECT_EQ(set.integrands[1].f(std::vector{0.5, 0.5}), 0.25);
  EXPECT_FALSE(carlo::find_integrands({"pi"}, {}).expression);
}

TEST(FindIntegrand, BadInput_GetsAdvice) {
  EXPECT_EQ(error_of([] {
              carlo::find_integrands({"x*y", "y=0:1"}, {.domain = "x=0:1"});
            }),
            "'y=0:1' is a bound and not an integrand; --domain takes all bounds as one argument: --domain "
            "\"x=0:1,y=0:1\"");
  EXPECT_THAT(error_of([] { carlo::find_integrand("y=0:1", {}); }), HasSubstr("--domain \"y=0:1\""));
  EXPECT_THAT(error_of([] { carlo::find_integrand("pie", {}); }), HasSubstr("did you mean 'pi'?"));
  EXPECT_THAT(error_of([] { carlo::find_integrand("x*x", {}); }), HasSubstr("for an expression give --domain"));
  EXPECT_THAT(error_of([] { carlo::find_integrand("pi", {.lets = {"r=2"}}); }), HasSubstr("a domain of its own"));
  EXPECT_THAT(error_of([] {
                carlo::find_integrands({"genz_c0_2d", "genz_c0_5d"}, {});
              }),
              HasSubstr("must be the same"));
}

} // namespace

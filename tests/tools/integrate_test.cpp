#include "expression.h"
#include "genz.h"

#include <mc/core/error.h>
#include <mc/estimate/integrate.h>

#include <gmock/gmock.h>

namespace {

TEST(Expression, IntegratesOverItsBox) {
  const carlo::Experiment e = carlo::parse_expression("exp(-x*x)*cos(y)", "x=0:1,y=-1:2");
  mc::IntegrateOptions o;
  o.rel_error = 1e-6;
  const mc::Integral r = mc::integrate_unit(e.f, e.dim, o);
  const double truth = std::sqrt(mc::pi<double>) / 2 * std::erf(1.0) * (std::sin(2.0) + std::sin(1.0));
  EXPECT_EQ(r.stop, mc::Stop::converged);
  EXPECT_LE(std::abs(r.estimate.value - truth), 5 * r.estimate.std_error);
}

TEST(Expression, TwoAtOnceDoNotMix) {
  const carlo::Experiment a = carlo::parse_expression("x", "x=0:2"), b = carlo::parse_expression("_pi", "x=0:1");
  const double u[] = {0.25};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(a.f(u), 1.0);
    EXPECT_DOUBLE_EQ(b.f(u), mc::pi<double>);
  }
}

TEST(Expression, RefusesNonsenseInOneLine) {
  const auto message = [](const char* expression, const char* box) -> std::string {
    try {
      carlo::parse_expression(expression, box);
    } catch (const mc::Error& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_THAT(message("x+", "x=0:1"), testing::HasSubstr("position"));
  EXPECT_THAT(message("x+z", "x=0:1"), testing::HasSubstr("z"));
  EXPECT_THAT(message("x", ""), testing::HasSubstr("--domain"));
  EXPECT_THAT(message("x", "x=1:0"), testing::HasSubstr("lo < hi"));
  EXPECT_THAT(message("x", "x=0:nan"), testing::HasSubstr("finite"));
  EXPECT_THAT(message("x", "x=0:1e999"), testing::HasSubstr("finite"));
  EXPECT_THAT(message("x", "x=0"), testing::HasSubstr("name=lo:hi"));
  EXPECT_THAT(message("x", "x=0:1,x=0:2"), testing::HasSubstr("twice"));
  EXPECT_THAT(message("x", "1x=0:1"), testing::HasSubstr("name"));
  EXPECT_THAT(message("x", "x=0:1,"), testing::HasSubstr("name=lo:hi"));
}

// Against the exact values of an independent program, whose parameters were printed with six digits.
TEST(Genz, TrueValues) {
  const double known[] = {-0.296538203498543, 0.330427988733901,  -0.33151717718612,  383.489107994049,  5861.82247981009,   3515.1675158421,
                          0.157652586526151,  0.0191763775830123, 0.0023208851724021, 0.0543691692087356, 0.0447845113982428, 0.0507512475186547,
                          0.0751924873775562, 0.0284361508662098, 0.01361211328293,   629.605673633046,  1386.89787835375,   4829.44716579627};
  ASSERT_EQ(carlo::genz_integrals().size(), std::size(known));
  for (std::size_t i = 0; i < std::size(known); ++i) EXPECT_LE(std::abs(carlo::genz_integrals()[i].truth / known[i] - 1), 3e-5) << carlo::genz_integrals()[i].name;
}

TEST(Genz, AutomaticIsWithinItsError) {
  for (const carlo::Experiment& e : carlo::genz_integrals()) {
    mc::IntegrateOptions o;
    o.rel_error = 0;
    o.max_calls = 100'000;
    const mc::Integral r = mc::integrate_unit(e.f, e.dim, o);
    if (r.consistent) { EXPECT_LE(std::abs(r.estimate.value - e.truth), 5 * r.estimate.std_error) << e.name; }
  }
}

} // namespace

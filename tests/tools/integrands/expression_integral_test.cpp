#include <integrands/expression_integral.h>

#include <mc/core/error.h>
#include <mc/estimate/integrate.h>
#include <support/files.h>

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace {

using carlo::ExpressionContext;
using support::error_of;
using testing::HasSubstr;

mc::Integral integral(const std::string& expression, const ExpressionContext& context, double rel_error = 1e-4) {
  const carlo::UnitCubeIntegral e = carlo::parse_expression(expression, context);
  mc::IntegrateOptions o;
  o.rel_error = rel_error;
  o.max_calls = 300'000;
  return mc::integrate_unit(e.f, e.dim, o);
}

// The integral of the expression by the midpoint rule over x in [0,1] and y between two straight lines.
double over_lines(int power_x, int power_y, double a, double b, double c, double d) {
  double sum = 0;
  constexpr int n = 2000; // midpoints: the integrand is a polynomial of degree 8 at most
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n, lo = a + b * x, hi = c + d * x;
    sum += std::pow(x, power_x) * (std::pow(hi, power_y + 1) - std::pow(lo, power_y + 1)) / (power_y + 1) / n;
  }
  return sum;
}

TEST(ExpressionIntegral, BoundsMayDependOnVariables) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> between(-1, 1);
  for (int i = 0; i < 30; ++i) {
    const double a = between(random), b = between(random), c = a + 1.5 + between(random), d = b + between(random);
    const int p = i % 3, q = i % 4;
    if (c + std::min(d, 0.0) < a + std::max(b, 0.0)) continue; // the lines cross
    const std::string domain = fmt::format("x=0:1,y={:.17g}+{:.17g}*x:{:.17g}+{:.17g}*x", a, b, c, d);
    const mc::Integral r = integral(fmt::format("x^{}*y^{}", p, q), {.domain = domain});
    // The bound fails for 1e-5 of the choices of seeds: Student's t of 23 degrees of freedom.
    EXPECT_NEAR(r.estimate.value, over_lines(p, q, a, b, c, d), 5.5 * r.estimate.std_error + 1e-6) << domain;
  }
}

TEST(ExpressionIntegral, ConditionThatIsNotANumber_IsRefusedWithItsPlace) {
  const std::string message =
      support::error_of([] { integral("x", {.domain = "x=0:1", .conditions = {"sqrt(x-2)"}}); });
  EXPECT_THAT(message, testing::AllOf(testing::StartsWith("--where: a condition is not a number at x = 0."),
                                      testing::EndsWith("; it must be true or false there")));
}

TEST(ExpressionIntegral, HasKnownValues) {
  const double pi = mc::pi<double>;
  const struct {
    const char* expression;
    ExpressionContext context;
    double truth;
  } cases[] = {
      {"1", {.domain = "x=0:1,y=0:x,z=0:y"}, 1.0 / 6},
      {"exp(-y)", {.domain = "x=0:2,y=x:inf"}, 1 - std::exp(-2.0)},
      {"exp(y)", {.domain = "x=0:1,y=-inf:-x"}, 1 - std::exp(-1.0)},
      {"exp(-(y-x)^2)", {.domain = "x=0:1,y=-inf:inf"}, std::sqrt(pi)},
      {"r^2*sin(t)", {.domain = "r=0:1,t=0:_pi,p=0:2*_pi"}, 4 * pi / 3},
      {"1", {.domain = "x=-1:1,y=-1:1", .conditions = {"x*x + y*y < 1"}}, pi},
      {"1", {.domain = "x=-1:1,y=-1:1", .conditions = {"x*x + y*y < 1", "x > 0"}}, pi / 2},
      {"sqrt(1-x*x-y*y)", {.domain = "x=-1:1,y=-1:1", .conditions = {"x*x+y*y<=1"}}, 2 * pi / 3},
      {"1", {.domain = "x=-1:1,y=-sqrt(1-x^2):sqrt(1-x^2)"}, pi},
      {"z^4", {.domain = "z=normal"}, 3},
      {"exp(z)", {.domain = "z=normal(1, 0.5)"}, std::exp(1.125)},
      {"z*z", {.domain = "m=normal(2,1),z=normal(m,abs(m)/2+1e-9)"}, 5 + 5.0 / 4},
      {"z > 1", {.domain = "z=normal"}, std::erfc(1 / std::sqrt(2.0)) / 2},
      {"x^k", {.domain = "x=0:1,k=1..6"}, 0.5 + 1.0 / 3 + 0.25 + 0.2 + 1.0 / 6 + 1.0 / 7},
      {"x", {.domain = "k=1..4,x=0:k"}, (1 + 4 + 9 + 16) / 2.0},
      {"1/k^2", {.domain = "k=1..inf"}, pi * pi / 6},
      {"2^k", {.domain = "k=-inf..-1"}, 1},
      {"(1+k-floor(k))*exp(-k)", {.domain = "x=0.2:0.8,k=x..inf"}, 0.6 / (std::exp(1.0) - 1)},
      {"(1+k-floor(k))*exp(k)", {.domain = "x=0.2:0.8,k=-inf..x"}, 0.6 / (1 - std::exp(-1.0))},
      {"exp(-abs(k))", {.domain = "k=-inf..inf"}, 1 / std::tanh(0.5)},
      {"k", {.domain = "k=1..100000"}, 5000050000.0},
      {"x > (k-1)/10", {.domain = "x=0:1,k=1..ceil(10*x)"}, 5.5},
      {"a*x^b", {.domain = "x=0:a", .lets = {"b=c-1"}, .settings = {"a=2", "c=3"}}, 16.0 / 3},
      {"exp(-r)",
       {.domain = "x=-1:1,y=-1:1", .conditions = {"r<1"}, .lets = {"s=x*x+y*y", "r=sqrt(s)"}},
       2 * pi * (1 - 2 * std::exp(-1.0))},
      {"sqrt(x)", {.domain = "x=-1:1", .conditions = {}, .lets = {}, .settings = {}, .nan = 0}, 2.0 / 3},
      {"1", {.domain = "x=0:1,y=0:h", .lets = {"h=x^2"}}, 1.0 / 3},
  };
  for (const auto& c : cases) {
    const mc::Integral r = integral(c.expression, c.context);
    EXPECT_NEAR(r.estimate.value, c.truth, 5.5 * r.estimate.std_error + 1e-9)
        << c.expression << " " << c.context.domain;
    EXPECT_LE(r.estimate.std_error, 2e-2 * c.truth) << c.expression << " " << c.context.domain;
  }
}

TEST(ExpressionIntegral, FiniteSumsAreExact) {
  const carlo::ExpressionIntegral sum({.domain = "l=0..3,m=-l..l"}, {"1", "m*m"});
  EXPECT_TRUE(sum.is_exact_sum());
  std::vector<double> values(2);
  sum.evaluate(std::vector{0.3}, values);
  EXPECT_EQ(values, (std::vector<double>{16, 2 + 10 + 28}));
  EXPECT_EQ(carlo::parse_expression("k", {.domain = "k=0.5..4.5"}).f(std::vector{0.0}), 10);
  EXPECT_EQ(carlo::parse_expression("1", {.domain = "x=0:1,k=1..0*x"}).f(std::vector{0.5}), 0) << "no term";
  EXPECT_FALSE(carlo::ExpressionIntegral({.domain = "k=0..1000"}, {"1"}).is_exact_sum());
}

TEST(ExpressionIntegral, ConditionsHideTheIntegrand) {
  const carlo::UnitCubeIntegral e =
      carlo::parse_expression("sqrt(x-0.5)", {.domain = "x=0:1", .conditions = {"x>0.5"}});
  EXPECT_EQ(e.f(std::vector{0.25}), 0);
  EXPECT_EQ(e.f(std::vector{0.75}), 0.5);
  EXPECT_EQ(e.describe_point(std::vector{0.25}), "a point outside the domain");
  EXPECT_EQ(e.describe_point(std::vector{0.75}), "x = 0.75");
}

TEST(ExpressionIntegral, CountsReplacedValues) {
  const carlo::ExpressionIntegral e({.domain = "x=-1:1", .conditions = {}, .lets = {}, .settings = {}, .nan = 7},
                                    {"sqrt(x)", "1/x"});
  std::vector<double> values(2);
  e.evaluate(std::vector{0.25}, values);
  EXPECT_EQ(values, (std::vector<double>{14, -4}));
  e.evaluate(std::vector{0.5}, values);
  EXPECT_EQ(values[1], HUGE_VAL) << "infinite values stay";
  EXPECT_EQ(e.take_replaced(), 1u);
  EXPECT_EQ(e.take_replaced(), 0u);
}

TEST(ExpressionIntegral, UniformMeasureNeedsABox) {
  const auto measure = [](const ExpressionContext& context) {
    return carlo::ExpressionIntegral(context, {"1"}).uniform_measure("--quantiles");
  };
  EXPECT_EQ(measure({.domain = "x=0:2,y=1:4,z=normal"}), 6);
  const auto refused = [&](const ExpressionContext& context) { return error_of([&] { measure(context); }); };
  EXPECT_EQ(refused({.domain = "x=0:inf"}), "--quantiles: the domain is infinite along x; values need a finite volume");
  EXPECT_THAT(refused({.domain = "x=0:1,y=0:x"}), HasSubstr("'y=0:x' is not one of its sides"));
  EXPECT_THAT(refused({.domain = "x=0:1,k=1..3"}), HasSubstr("'k=1..3' is not one of its sides"));
  EXPECT_THAT(refused({.domain = "x=0:1", .conditions = {"x<.5"}}), HasSubstr("--where"));
}

TEST(ExpressionIntegral, ValueAtFollowsTheMap) {
  const carlo::ExpressionIntegral e({.domain = "x=1:3,y=0:x,z=normal(1,2),k=1..3"}, {"1"});
  EXPECT_EQ(e.value_at("x", 0.25), 1.5);
  EXPECT_EQ(e.value_at("z", 0.5), 1);
  EXPECT_FALSE(e.value_at("y", 0.5));
  EXPECT_FALSE(e.value_at("k", 0.5));
}

TEST(ExpressionIntegral, BadInput_IsOneLineThatNamesTheOption) {
  const auto refused = [](const ExpressionContext& context) {
    return error_of([&] { carlo::parse_expression("x", context).f(std::vector(8, 0.75)); });
  };
  EXPECT_EQ(refused({.domain = "x=0:1;y=0:1"}),
            "--domain: 'x=0:1;y=0:1' contains ';'; a comma separates variables, as in \"x=0:1,y=-1:2\"");
  EXPECT_EQ(refused({.domain = "x=0:1,y=x:0.5"}),
            "--domain: 'y=x:0.5' has bounds 0.75 and 0.5 at x = 0.75; lo <= hi is needed; --where restricts the "
            "variables before");
  EXPECT_THAT(refused({.domain = "y=0:x,x=0:1"}), HasSubstr("'x' in 'y=0:x' may use the variables before it: "));
  EXPECT_THAT(refused({.domain = "x=0:1,y=0:sqrt(-x)"}), HasSubstr("'y=0:sqrt(-x)' has bounds 0 and "));
  EXPECT_THAT(refused({.domain = "x=0:1,z=normal(0,x-1)"}), HasSubstr("standard deviation -0.25 at x = 0.75"));
  EXPECT_THAT(refused({.domain = "x=normal(0)"}), HasSubstr("needs a mean and a standard deviation"));
  EXPECT_THAT(refused({.domain = "x=normal(0,0)"}), HasSubstr("must be > 0 and finite"));
  EXPECT_THAT(refused({.domain = "x=normal(0,1"}), HasSubstr("not of the form"));
  EXPECT_THAT(refused({.domain = "x=normals"}), HasSubstr("not of the form"));
  EXPECT_THAT(refused({.domain = "x=0:1,k=0.1..0.9"}), HasSubstr("no whole number lies between"));
  EXPECT_THAT(refused({.domain = "x=0:1,k=0..1e6*x"}), HasSubstr("at most 1000 terms"));
  EXPECT_THAT(refused({.domain = "x=0:1", .lets = {"x=1"}}), HasSubstr("--let: 'x' has a meaning already"));
  EXPECT_THAT(refused({.domain = "x=0:1", .lets = {"r=r+1"}}),
              HasSubstr("--let 'r=r+1': expression 'r+1', position 0"));
  EXPECT_THAT(refused({.domain = "x=0:1", .lets = {"r"}}), HasSubstr("not of the form name=value"));
  EXPECT_THAT(refused({.domain = "x=0:1", .lets = {"sin=1"}}), HasSubstr("'sin' is no name of a variable"));
  EXPECT_THAT(refused({.domain = "x=0:1", .settings = {"a=q"}}), HasSubstr("--set 'a=q': expression 'q'"));
  EXPECT_THAT(refused({.domain = "x=0:1", .settings = {"a=1:2:1"}}), HasSubstr("one value is needed"));
  EXPECT_THAT(refused({.domain = "x=0:1", .conditions = {"x<q"}}), HasSubstr("--where 'x<q': expression 'x<q'"));
}

} // namespace

#include <integrands/complex_expression.h>
#include <integrands/expression_integral.h>

#include <mc/core/error.h>
#include <support/files.h>

#include <gmock/gmock.h>

#include <cmath>

namespace {

using carlo::ComplexExpression;
using support::error_of;
using testing::HasSubstr;
using Value = std::complex<double>;

Value value(const std::string& text, double x = 0.7, double y = -1.3) {
  carlo::ExpressionProgram program;
  program.add_value("x", x);
  program.add_value("y", y);
  const ComplexExpression e(text, program);
  return e.evaluate(program.frame());
}

TEST(ComplexExpression, AgreesWithComplexArithmetic) {
  const Value i(0, 1), x = 0.7, y = -1.3;
  const std::pair<const char*, Value> cases[] = {
      {"i", i},
      {"i^2", -1},
      {"-i^2", 1},
      {"2^-i", std::pow(Value(2), -i)},
      {"exp(i*x)", std::exp(i * x)},
      {"x + y*i - 2*i/(1+i)", x + y * i - 2.0 * i / (1.0 + i)},
      {"(x+i)^3/(x-i)^2", (x + i) * (x + i) * (x + i) / ((x - i) * (x - i))},
      {"(x+i)^-2", 1.0 / ((x + i) * (x + i))},
      {"sqrt(i*y)*log(x+i)", std::sqrt(i * y) * std::log(x + i)},
      {"x - y - i - 1", x - y - i - 1.0},
      {"8/2/i", 4.0 / i},
      {"conj(exp(i*x))*abs(i+x) + arg(i)", std::conj(std::exp(i * x)) * std::abs(i + x) + std::arg(i)},
      {"if(x > 0, x, y)*i + max(x, y)^2 - sin(x*(y+1))", x * i + x * x - std::sin(0.7 * -0.3)},
      {"(x > 0 and y < 0)*cosh(i*x) + 1e-3", std::cosh(i * x) + 1e-3},
      {"besselj(0, x) + 1.5e+1*tan(x+i)", std::cyl_bessel_j(0.0, 0.7) + 15.0 * std::tan(x + i)},
      {" - ( i * x ) ", -i * x},
      {"2^3^2*i", 512.0 * i},
  };
  for (const auto& [text, truth] : cases)
    EXPECT_LE(std::abs(value(text) - truth), 1e-13 * (1 + std::abs(truth))) << text << " " << value(text);
}

TEST(ComplexExpression, RealValuesAreRecognised) {
  carlo::ExpressionProgram program;
  program.add_value("x");
  for (const char* text : {"abs(exp(i*x))^2", "re(i*x) + x", "2*arg(i)", "-im(i)", "exp(-abs(i*x))", "sqrt(abs(x+i))"})
    EXPECT_TRUE(ComplexExpression(text, program).is_real_valued()) << text;
  for (const char* text : {"i*i", "x + i", "conj(i*x)", "abs(i) + i"})
    EXPECT_FALSE(ComplexExpression(text, program).is_real_valued()) << text;
}

TEST(ComplexExpression, BadInput_IsReportedWithItsPlace) {
  const auto refused = [](const char* text) { return error_of([&] { value(text); }); };
  EXPECT_THAT(refused("i < x"), HasSubstr("position 2: '<' cannot follow a complex value"));
  EXPECT_THAT(refused("2i"), HasSubstr("position 0: '2i' is not a number; a product is 2*i"));
  EXPECT_THAT(refused("gamma(i)"), HasSubstr("position 0: gamma takes no complex value; use one of exp, log"));
  EXPECT_THAT(refused("sine(i)"), HasSubstr("did you mean 'sin'?"));
  EXPECT_THAT(refused("exp(i*x"), HasSubstr("a parenthesis is not closed"));
  EXPECT_THAT(refused("i*"), HasSubstr("position 2: a value is missing"));
  EXPECT_THAT(refused("max(i, x)"), HasSubstr("',' cannot follow a complex value"));
  EXPECT_THAT(refused("i*q"), HasSubstr("unknown name 'q'"));
}

TEST(ComplexExpression, IsTwoOutputs) {
  const carlo::ExpressionIntegral e({.domain = "x=0:1"}, {"x", "exp(i*x)", "abs(i*x)"});
  ASSERT_EQ(e.outputs().size(), 4u);
  std::vector<double> values(4);
  e.evaluate(std::vector{0.25}, values);
  EXPECT_EQ(values, (std::vector<double>{0.25, std::cos(0.25), std::sin(0.25), 0.25}));
  EXPECT_EQ(carlo::ExpressionIntegral({.domain = "x=0:1,i=1..3"}, {"i*x"}).outputs().size(), 1u) << "a variable";
  EXPECT_EQ(carlo::ExpressionIntegral({.domain = "x=0:1", .settings = {"i=3"}}, {"i*x"}).outputs().size(), 1u);
  EXPECT_THAT(error_of([] { carlo::parse_expression("exp(i*x)", {.domain = "x=0:1"}); }),
              HasSubstr("'exp(i*x)' is complex; take re(...), im(...) or abs(...) of it"));
  const carlo::UnitCubeIntegral root = carlo::parse_expression("abs(i*x)^0.5 * re(i*i)^0.5", {.domain = "x=0:1"});
  EXPECT_TRUE(std::isnan(root.f(std::vector{0.5}))) << "the root of a negative number";
}

} // namespace

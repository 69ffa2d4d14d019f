#include <integrands/expression_integral.h>
#include <integrands/genz.h>
#include <tools/interrupt_carlo.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/estimate/integrate.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace {

TEST(Expression, IntegratesOverTheBox) {
  const carlo::UnitCubeIntegral e = carlo::parse_expression("exp(-x*x)*cos(y)", {.domain = "x=0:1,y=-1:2"});
  mc::IntegrateOptions o;
  o.rel_error = 1e-6;
  const mc::Integral r = mc::integrate_unit(e.f, e.dim, o);
  const double truth = std::sqrt(mc::pi<double>) / 2 * std::erf(1.0) * (std::sin(2.0) + std::sin(1.0));
  EXPECT_EQ(r.stop, mc::StopReason::converged);
  EXPECT_LE(std::abs(r.estimate.value - truth), 5 * r.estimate.std_error);
}

TEST(Expression, BoundsMayBeInfinite) {
  const double pi = mc::pi<double>;
  const struct {
    const char *expression, *box;
    double truth;
  } cases[] = {{"exp(-x*x)", "x=-inf:inf", std::sqrt(pi)},
               {"exp(-x*x)", "x=1:inf", std::sqrt(pi) / 2 * std::erfc(1)},
               {"exp(x)*y", "x=-inf:2,y=0:2", 2 * std::exp(2.0)},
               {"1/(1+x*x)/(1+y*y)", "x=-inf:inf,y=0:inf", pi * pi / 2},
               {"x^-2.5", "x=1:inf", 1 / 1.5},
               {"exp(-(x-100)^2/2e6)", "x=-inf:inf", std::sqrt(2e6 * pi)},
               {"exp(-abs(x)-y*y-z*z)", "x=-inf:inf,y=-inf:inf,z=-inf:inf", 2 * pi}};
  for (const auto& c : cases) {
    const carlo::UnitCubeIntegral e = carlo::parse_expression(c.expression, {.domain = c.box});
    mc::IntegrateOptions o;
    o.rel_error = 1e-4;
    const mc::Integral r = mc::integrate_unit(e.f, e.dim, o);
    EXPECT_EQ(r.stop, mc::StopReason::converged) << c.expression << " over " << c.box;
    EXPECT_LE(std::abs(r.estimate.value - c.truth), 5 * r.estimate.std_error) << c.expression << " over " << c.box;
  }
  // The integrand is constant over the unit cube: the rule of three bounds the error.
  const carlo::UnitCubeIntegral same = carlo::parse_expression("x^-2", {.domain = "x=1:inf"});
  mc::IntegrateOptions few;
  few.max_calls = 10'000;
  const mc::Integral r = mc::integrate_unit(same.f, same.dim, few);
  EXPECT_TRUE(r.constant);
  EXPECT_GT(r.estimate.std_error, 1e-4);
  EXPECT_NEAR(r.estimate.value, 1, 1e-12);
  const double zero[] = {0};
  EXPECT_EQ(carlo::parse_expression("exp(-x*x)", {.domain = "x=-inf:inf"}).f(zero), 0);
  EXPECT_EQ(carlo::parse_expression("x", {.domain = "x=-inf:0"}).describe_point(std::vector{0.5}), "x = -1");
}

TEST(Expression, SupportsAndOrNotIf) {
  const auto value = [](const char* expression, double x) {
    return carlo::parse_function(expression, {"x"})(std::vector{x});
  };
  EXPECT_EQ(value("x > 0 and x < 1", 0.5), 1);
  EXPECT_EQ(value("x > 0 and x < 1", 1.5), 0);
  EXPECT_EQ(value("x < 0 or x > 1 and x < 2", -1), 1) << "'and' binds closer";
  EXPECT_EQ(value("x < 0 or x > 1", 0.5), 0);
  EXPECT_EQ(value("not(x > 0) and 1", 0.5), 0);
  EXPECT_EQ(value("if(x > 0, 1/x, 0)", 0), 0) << "the branch that is not chosen is infinite";
  EXPECT_EQ(value("if(x > 0, 1/x, 0)", 4), 0.25);
  const auto f = carlo::parse_function("land + order*2", {"land", "order"}); // operator words inside names
  EXPECT_EQ(f(std::vector{1.0, 2.0}), 5);
}

TEST(Expression, VariableNamedLikeAConstantIsAccepted) {
  EXPECT_THAT(
      [] {
        carlo::parse_function("2e*x", {"x", "e"});
      },
      testing::ThrowsMessage<mc::Error>(testing::HasSubstr("an operator is missing")));
}

// muParser would assign to the variable and continue with the new value.
TEST(Expression, AssignmentIsRejected) {
  const auto parse = [](const char* expression) { carlo::parse_function(expression, {"x", "y"}); };
  for (const char* expression : {"x=3", "(x=0.5)*y", "x = = 3", "x=>3", "x<1 ? y=2 : 1"})
    EXPECT_THAT([&] { parse(expression); }, testing::ThrowsMessage<mc::Error>(testing::HasSubstr("use == to compare")))
        << expression;
  for (const char* expression : {"x==3", "x<=3", "x>=3", "x!=3", "(x==y)+(x >= -y)"})
    EXPECT_NO_THROW(parse(expression)) << expression;
}

TEST(Expression, SyntaxErrorsSuggestTheRightSpelling) {
  const auto message = [](const std::string& expression) -> std::string {
    try {
      carlo::parse_function(expression, {"x"});
    } catch (const mc::Error& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("x\u22121"), "expression 'x\u22121', position 1: this is the minus of typeset text; type -");
  EXPECT_EQ(message("1 + x**2"), "expression '1 + x**2', position 6: a power is x^2, not x**2");
  EXPECT_EQ(message(" x**2"), "expression ' x**2', position 3: a power is x^2, not x**2");
  EXPECT_EQ(message("x%2"), "expression 'x%2', position 1: there is no %; the rest of x by 2 is x - 2*floor(x/2)");
  EXPECT_EQ(message("pow(x,2)"), "expression 'pow(x,2)', position 0: a power is x^2, not pow(x, 2)");
  for (const char* e : {"pi*x", "x*pi", "2pi", "sin(pi)", "2*\u03c0"})
    EXPECT_THAT(message(e), testing::EndsWith(": pi is _pi")) << e;
  for (const char* e : {"e^x", "2e*x"}) EXPECT_THAT(message(e), testing::HasSubstr(": e is _e;")) << e;
  for (const char* e : {"2x", "2 x", ".5x", "2.x", "2(x)", "(x)(x)", "x(2)", "2sin(x)", "sin(2x)", "x 2", "2_pi"})
    EXPECT_THAT(message(e), testing::EndsWith(": an operator is missing; a product is 2*x")) << e;
  EXPECT_EQ(message("x+1e400"), "expression 'x+1e400', position 2: a number must be at most 1.7e308");
  EXPECT_EQ(message("2*expo"),
            "expression '2*expo', position 2: unknown name 'expo'; did you mean 'exp'?; use one of x, _e, _pi");
  EXPECT_EQ(message("a*x + 1e5 + b*a"),
            "expression 'a*x + 1e5 + b*a', position 0: unknown names 'a', 'b'; use one of x, _e, _pi");
  EXPECT_THAT(
      message("x + gama(x) + foo (b)"),
      testing::AllOf(testing::HasSubstr("unknown functions 'gama', 'foo'; did you mean 'gamma'?; use one of abs"),
                     testing::HasSubstr(", besselj, ")));
  EXPECT_THAT(message("sin x"), testing::HasSubstr("sin is a function; its argument stands in parentheses: sin(x)"));
  EXPECT_EQ(message("x+"), "expression 'x+', position 2: Unexpected end of expression");
  EXPECT_EQ(message(""), "expression '': Expression is empty.");
  EXPECT_EQ(message("x<.5?1"), "expression 'x<.5?1': If-then-else operator is missing an else clause");
  EXPECT_EQ(message("2*(0.2 < x <= 0.5)"),
            "expression '2*(0.2 < x <= 0.5)', position 11: comparisons do not chain; write 0.2 < x and x < 0.5");
  for (const char* e : {"0.2 < x and x < 0.5 or x == 2", "(x < 1) < x", "x < 1 ? x > 2 : x != 3", "x<1 && x<2 || x>=3",
                        "if(x < 1, x > 2, x <= 3)"})
    EXPECT_EQ(message(e), "accepted") << e;
  std::string sum = "x";
  while (sum.size() < 19'999) sum += "+x";
  EXPECT_EQ(message(sum), "accepted");
  EXPECT_THAT(message(sum + "+x"), testing::EndsWith("...' is too long: 20001 bytes; at most 19999 are read"));
  for (const std::string& e : {sum + "+x", sum.substr(0, 9999) + "+q" + sum.substr(0, 9998), sum.substr(0, 9999) + "=x",
                               sum.substr(0, 9999) + "%" + std::string(500, '%'), sum.substr(0, 9999) + ",x"})
    EXPECT_LT(message(e).size(), 200u) << e;
  EXPECT_THAT(
      message(sum.substr(0, 999) + "+q" + sum.substr(1, 998)),
      testing::HasSubstr("'...x+x+x+x+x+x+x+x+x+x+x+x+x+x+x+q+x+x+x+x+x+x+x+x+x+x+x+x+x+x+...', position 1000: "));
}

TEST(Expression, FloorRoundsDown) {
  const auto f = carlo::parse_function("floor(x) + 10*(x - 2*floor(x/2))", {"x"});
  EXPECT_EQ(f(std::vector{-0.5}), 14);
  EXPECT_EQ(f(std::vector{3.0}), 13);
}

TEST(Expression, ConcurrentEvaluationIsIndependent) {
  const carlo::UnitCubeIntegral a = carlo::parse_expression("x", {.domain = "x=0:2"}),
                                b = carlo::parse_expression("_pi", {.domain = "x=0:1"});
  const double u[] = {0.25};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(a.f(u), 1.0);
    EXPECT_DOUBLE_EQ(b.f(u), mc::pi<double>);
  }
}

TEST(Expression, BadInput_IsReportedInOneLine) {
  const auto message = [](const char* expression, const char* box) -> std::string {
    try {
      carlo::parse_expression(expression, {.domain = box});
    } catch (const mc::Error& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_THAT(message("x+", "x=0:1"), testing::HasSubstr("position"));
  EXPECT_THAT(message("x+z", "x=0:1"), testing::HasSubstr("z"));
  EXPECT_THAT(message("x", ""), testing::HasSubstr("--domain"));
  EXPECT_THAT(message("x", "x=1:0"), testing::HasSubstr("lo < hi"));
  EXPECT_THAT(message("x", "x=0:nan"), testing::HasSubstr("not a number"));
  EXPECT_THAT(message("x", "x=0:1e999"), testing::HasSubstr("not a number"));
  EXPECT_THAT(message("x", "x=inf:inf"), testing::HasSubstr("lo < hi"));
  EXPECT_THAT(message("if(x, 1)", "x=0:1"), testing::HasSubstr("position"));
  EXPECT_THAT(message("x", "x=0"), testing::HasSubstr("name=lo:hi"));
  EXPECT_THAT(message("x", "x=0:1,x=0:2"), testing::HasSubstr("twice"));
  EXPECT_THAT(message("x", "1x=0:1"), testing::HasSubstr("name"));
  EXPECT_THAT(message("x", "x=0:1,"), testing::HasSubstr("name=lo:hi"));
  EXPECT_THAT(message("x", "x=0:1e200,y=0:1e200"), testing::HasSubstr("overflows"));
  EXPECT_THAT(message("x", "x=0:1e-200,y=0:1e-200"), testing::HasSubstr("too small for a double"));
  EXPECT_EQ(message("x", "x=0:1e200,y=0:1e200,z=0:1e-200"), "accepted");
}

// Compares with exact values of an independent program, which printed its parameters with six digits.
TEST(Genz, TrueValues) {
  const double known[] = {-0.296538203498543, 0.330427988733901,  -0.33151717718612,  383.489107994049,
                          5861.82247981009,   3515.1675158421,    0.157652586526151,  0.0191763775830123,
                          0.0023208851724021, 0.0543691692087356, 0.0447845113982428, 0.0507512475186547,
                          0.0751924873775562, 0.0284361508662098, 0.01361211328293,   629.605673633046,
                          1386.89787835375,   4829.44716579627};
  ASSERT_EQ(carlo::genz_integrals().size(), std::size(known));
  for (std::size_t i = 0; i < std::size(known); ++i)
    EXPECT_LE(std::abs(carlo::genz_integrals()[i].truth / known[i] - 1), 3e-5) << carlo::genz_integrals()[i].name;
}

TEST(Genz, AutomaticMethodReachesItsError) {
  for (const carlo::UnitCubeIntegral& e : carlo::genz_integrals()) {
    mc::IntegrateOptions o;
    o.rel_error = 0;
    o.max_calls = 100'000;
    const mc::Integral r = mc::integrate_unit(e.f, e.dim, o);
    if (r.consistent) {
      EXPECT_LE(std::abs(r.estimate.value - e.truth), 5 * r.estimate.std_error) << e.name;
    }
  }
}

// A narrow peak that the default number of calls misses.
TEST(Integrate, MinCalls_FindSmallFeatures) {
  const std::string f = "integrate '1+1000*exp(-((x-.3)^2+(y-.6)^2)*1e5)' -d x=0:1,y=0:1 --method rqmc --min-calls ";
  const auto value = [](const std::string& text) { return std::strtod(text.c_str() + text.find("= ") + 2, nullptr); };
  EXPECT_NEAR(value(support::run_carlo(f + "1e6").output), 1.0314, 1e-3);
  EXPECT_THAT(support::run_carlo("integrate 1 x -d x=0:1").output,
              testing::AllOf(testing::HasSubstr("constant at all "), testing::HasSubstr("stopped: converged")));
}

// Shares of unflagged runs within 1 and 2 standard errors. Normal errors with known sigma would give .6827 and .9545,
// Student's t of 16 replicates .6827 and .936. The bounds are 3.5 binomial deviations of 1080 runs beyond both values;
// the corrections for skewness and tail may add .05 to the first. The seeds are fixed.
TEST(Genz, ErrorBarsAreCalibrated) {
  for (const mc::Method method :
       {mc::Method::plain, mc::Method::stratified, mc::Method::rqmc, mc::Method::vegas, mc::Method::automatic}) {
    mc::IntegrateOptions o;
    o.method = method;
    o.rel_error = 0;
    o.max_calls = 2500;
    o.threads = 1;
    int runs = 0, flagged = 0, within1 = 0, within2 = 0;
    for (const carlo::UnitCubeIntegral& e : carlo::genz_integrals())
      for (int i = 0; i < 60; ++i, ++runs, ++o.seed) {
        const mc::Integral r = mc::integrate_unit(e.f, e.dim, o);
        const double sigmas = std::abs(r.estimate.value - e.truth) / r.estimate.std_error;
        if (!r.consistent) ++flagged;
        else {
          within1 += sigmas <= 1;
          within2 += sigmas <= 2;
        }
      }
    const auto slack = [&](double p) { return 3.5 * std::sqrt(p * (1 - p) / runs); };
    const double share1 = double(within1) / (runs - flagged), share2 = double(within2) / (runs - flagged);
    EXPECT_THAT(share1, testing::AllOf(testing::Ge(0.6827 - slack(0.6827)), testing::Le(0.7327 + slack(0.6827))))
        << name(method);
    EXPECT_THAT(share2, testing::AllOf(testing::Ge(0.9475 - slack(0.9475)), testing::Le(0.9545 + slack(0.9545))))
        << name(method);
    EXPECT_LE(flagged, 10) << name(method);
  }
}

TEST(Integrate, CountsAcceptScientificNotation) {
  const auto value = [](const std::string& calls) {
    const support::ProcessResult r =
        support::run_carlo("integrate x*x -d x=0:1 --method plain --rel-error 1e-9 --max-calls " + calls);
    return r.output.substr(0, r.output.find('\n'));
  };
  EXPECT_EQ(value("1e3"), value("1000"));
  EXPECT_NE(value("1e4"), value("1000"));
  EXPECT_EQ(support::run_carlo("integrate x -d x=0:1 --max-calls 1.5").exit_code, 2);
  EXPECT_THAT(support::run_carlo("integrate x -d x=0:1 --max-calls -5").output, testing::HasSubstr("-5 must be >= 0"));
}

TEST(Integrate, CommaSeparatedValues_AreRejected) {
  EXPECT_THAT(support::run_carlo("integrate 'x, x*x' -d x=0:1").output, testing::HasSubstr("has 2 values"));
}

// Regression test: the message was that the integrand is 0 at every point.
TEST(Integrate, Underflow_IsNotReportedAsZero) {
  for (const std::string arguments :
       {"x -d x=0:1e-300", "1 '(-x)' -d x=0:1e-200", "'1e-300*exp(-y)' -d x=0:1e-30,y=0:inf"}) {
    const support::ProcessResult r = support::run_carlo("integrate " + arguments);
    EXPECT_EQ(r.exit_code, 2) << arguments;
    EXPECT_THAT(r.output,
                testing::ContainsRegex("': its values times the volume of '.*' are below 4.9e-324, the smallest"));
    EXPECT_EQ(std::count(r.output.begin(), r.output.end(), '\n'), 1) << r.output;
  }
  EXPECT_THAT(support::run_carlo("integrate '1e300*x' -d x=0:1e-300").output, testing::ContainsRegex("x = (5.0|4.9)"));
  EXPECT_THAT(support::run_carlo("integrate x -d x=0:1e-160").output, testing::HasSubstr("e-321 ± 4.9e-324"));
  EXPECT_THAT(support::run_carlo("integrate 'x > 2' -d x=0:1").output, testing::HasSubstr("was 0 at all"));
  EXPECT_EQ(support::run_carlo("integrate 'x-0.5' -d x=0:1 --abs-error 0.1").exit_code, 0);
}

TEST(Integrate, TheExitCodeTellsWhetherTheErrorWasReached) {
  const auto code = [](const std::string& arguments) { return support::run_carlo("integrate " + arguments).exit_code; };
  EXPECT_EQ(code("x*x -d x=0:1"), 0);
  EXPECT_EQ(code("x*x -d x=0:1 --rel-error 1e-12 --max-calls 4096"), 1) << "the error was not reached";
  EXPECT_THAT(support::run_carlo("integrate x*x -d x=0:1 --rel-error 1e-12 --max-calls 4096").output,
              testing::EndsWith("\nthe wanted error was not reached; raise --max-calls\n"));
  EXPECT_EQ(code("'x > 2' -d x=0:1"), 1) << "the error is not known";
  EXPECT_EQ(code("'x^-0.9' -d x=0:1 --max-calls 1e5"), 1) << "the variance is infinite";
  EXPECT_EQ(code("x 'x > 2' -d x=0:1 --max-calls 1e5"), 1) << "of one of two integrands it is not known";
  EXPECT_EQ(code("--list"), 0);
}

TEST(Integrate, NonFiniteValue_ReportsTheVariables) {
  const auto says = [](const std::string& arguments) { return support::run_carlo("integrate " + arguments).output; };
  EXPECT_THAT(says("'max(exp(.2*x-.02)-1,0)*exp(-x*x/2)/sqrt(2*_pi)' -d x=-inf:inf --method plain"),
              testing::AllOf(testing::ContainsRegex("points, the first at x = [0-9.]+; it must be finite"),
                             testing::EndsWith("; it is nan there: inf * 0 or inf - inf? Merge the exponents or bound "
                                               "the domain\n")));
  EXPECT_THAT(says("1 'sqrt(x-y)' -d x=0:1,y=2:3"),
              testing::AllOf(testing::ContainsRegex("the first at x = 0[.][0-9]+, y = 2[.][0-9]+; it must be finite"),
                             testing::EndsWith("; it is nan there (see --nan)\n")));
  EXPECT_THAT(says("1/0 -d x=2:3"),
              testing::AllOf(testing::HasSubstr("the first at x = 2."), testing::EndsWith("almost everywhere\n")));
}

TEST(Integrate, CtrlC_PrintsResultSoFar) {
  for (const std::string method : {"plain", "vegas", "tree"}) { // the last two first learn for a while
    const support::ProcessResult r =
        support::interrupt_carlo("integrate genz_c0_8d --rel-error 1e-12 --max-calls 1e12 --method " + method);
    EXPECT_EQ(r.exit_code, 130) << r.output;
    EXPECT_THAT(r.output, testing::AllOf(testing::HasSubstr(" ± "),
                                         testing::HasSubstr(" by " + method + "; stopped: interrupted")));
  }
}

TEST(Integrate, ZeroIntegral_AsksForAbsError) {
  const auto r = support::run_carlo("integrate 'x^3+x' -d x=-1:1 --max-calls 20000 --seed 3");
  EXPECT_EQ(r.exit_code, 1) << r.output;
  EXPECT_THAT(r.output, testing::HasSubstr("it is relative to an integral that may be 0; give --abs-error"));
  EXPECT_EQ(support::run_carlo("integrate 'x^3+x' -d x=-1:1 --max-calls 20000 --abs-error 0.01").exit_code, 0);
}

TEST(Integrate, ZeroWantedError_UsesAllCallsAndSucceeds) {
  const auto r = support::run_carlo("integrate 'exp(x)' -d x=0:1 --rel-error 0 --max-calls 20000");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, testing::Not(testing::HasSubstr("not reached")));
}

TEST(Integrate, DerivedValueWithoutError_Fails) {
  for (const std::string derived : {"log(-I1)", "I1/0"}) {
    const auto r = support::run_carlo("integrate x -d x=0:1 --derive '" + derived + "'");
    EXPECT_EQ(r.exit_code, 1) << r.output;
    EXPECT_THAT(r.output, testing::HasSubstr("error not known"));
  }
}

// An integral of tail index 1 is on the border: the text says at least that it may be infinite.
TEST(Integrate, DivergentIntegral_IsNamed) {
  for (const std::string method : {"auto", "vegas", "rqmc"}) {
    const auto text_of = [&](const std::string& integral) {
      const auto r = support::run_carlo("integrate " + integral + " --max-calls 1e6 --method " + method);
      EXPECT_EQ(r.exit_code, 1) << r.output;
      return r.output;
    };
    EXPECT_THAT(text_of("'x^-2' -d x=0:1"),
                testing::ContainsRegex("^x\\^-2: .*does not (seem to )?converge absolutely"));
    for (const char* integral : {"'1/(1+x)' -d x=0:inf", "'sin(x)/x' -d x=0:inf"})
      EXPECT_THAT(text_of(integral),
                  testing::ContainsRegex("converge absolutely|looks infinite, and the integral may be"))
          << method;
  }
}

} // namespace

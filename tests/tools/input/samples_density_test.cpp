// carlo validate --samples-file --pdf: right and wrong densities as expressions, on every kind of domain.

#include "tools/input/samples_scratch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

namespace {

using carlo::ValidateCommandOptions;
using support::Output, support::refusal, support::run;
using testing::HasSubstr;

using std::numbers::pi;

// Right and wrong samples, 40000 rows of six digits.
struct Expression {
  const char *name, *domain, *pdf, *wrong;
  std::function<std::string(mc::Pcg&)> draw;
  friend void PrintTo(const Expression& e, std::ostream* out) { *out << e.pdf << " over " << e.domain; }
};

double normal(mc::Pcg& random) {
  return std::sqrt(-2 * std::log(1 - random.uniform<double>())) * std::cos(2 * pi * random.uniform<double>());
}
std::string uniform_ball(mc::Pcg& random, int dim, double inner = 0) {
  for (;;) {
    std::array<double, 3> p{};
    double square = 0;
    for (int k = 0; k < dim; ++k) {
      p[static_cast<std::size_t>(k)] = 2 * random.uniform<double>() - 1;
      square += p[static_cast<std::size_t>(k)] * p[static_cast<std::size_t>(k)];
    }
    if (square > 1 || square < inner * inner) continue;
    return fmt::format("{:.6f}", fmt::join(p.begin(), p.begin() + dim, ","));
  }
}

const std::vector<Expression> expression_help = {
    {"line", "x=-inf:inf", "exp(-x*x/2)/sqrt(2*_pi)", "exp(-x*x/2.4)/sqrt(2.4*_pi)",
     [](mc::Pcg& r) { return fmt::format("{:.6g}", normal(r)); }},
    {"half_line", "x=0:inf", "exp(-x)", "2*exp(-2*x)",
     [](mc::Pcg& r) { return fmt::format("{:.6g}", -std::log(1 - r.uniform<double>())); }},
    {"plane", "x=-inf:inf,y=-inf:inf", "exp(-(x*x+y*y)/2)/(2*_pi)", "exp(-(x*x+y*y-x*y)/1.5)/(2*_pi)*2/sqrt(3)",
     [](mc::Pcg& r) { return fmt::format("{:.6g},{:.6g}", normal(r), normal(r)); }},
    {"space", "x=-inf:inf,y=-inf:inf,z=-inf:inf", "exp(-(x*x+y*y+z*z)/2)/(2*_pi)^1.5",
     "exp(-(x*x+y*y+z*z)/2.4)/(2.4*_pi)^1.5",
     [](mc::Pcg& r) { return fmt::format("{:.6g},{:.6g},{:.6g}", normal(r), normal(r), normal(r)); }},
    {"disk", "disk", "1/_pi", "2*(x*x+y*y)/_pi", [](mc::Pcg& r) { return uniform_ball(r, 2); }},
    {"annulus", "annulus=0.5", "1/(0.75*_pi)", "(1+x)/(0.75*_pi)", [](mc::Pcg& r) { return uniform_ball(r, 2, 0.5); }},
    {"ball", "ball", "0.75/_pi", "0.75/_pi*(1+z/2)", [](mc::Pcg& r) { return uniform_ball(r, 3); }},
    {"triangle", "triangle", "2", "6*x",
     [](mc::Pcg& r) {
       double x = r.uniform<double>(), y = r.uniform<double>();
       if (x + y > 1) {
         x = 1 - x;
         y = 1 - y;
       }
       return fmt::format("{:.6f},{:.6f}", x, y);
     }},
    {"hemisphere", "hemisphere", "z/_pi", "1/(2*_pi)", cosine},
    {"sphere_and_interval", "sphere,t=0:2", "(z>0 ? z/_pi : 0)*t/2", "(z>0 ? z/_pi : 0)/2",
     [](mc::Pcg& r) {
       std::string w = cosine(r);
       std::replace(w.begin(), w.end(), ' ', ',');
       return fmt::format("{},{:.6f}", w, 2 * std::sqrt(r.uniform<double>()));
     }},
    {"discrete", "discrete=4", "(i+1)/10", "0.25",
     [](mc::Pcg& r) {
       const double u = 10 * r.uniform<double>();
       return fmt::format("{}", u < 1 ? 0 : u < 3 ? 1 : u < 6 ? 2 : 3);
     }},
};

struct ByExpression : SamplesFile, testing::WithParamInterface<Expression> {};

TEST_P(ByExpression, CorrectPassesAndWrongFails) {
  ValidateCommandOptions o = options(samples(GetParam().draw), "");
  o.domain = GetParam().domain;
  o.pdf = GetParam().pdf;
  const Output right = run(o);
  EXPECT_EQ(right.code, carlo::exit_ok) << right.text;
  o.pdf = std::string("0.7*(") + GetParam().pdf + ")"; // a probability above 1 would be refused
  EXPECT_EQ(run(o).code, carlo::exit_failed);
  o.unnormalized = true;
  EXPECT_EQ(run(o).code, carlo::exit_ok);
  o.unnormalized = false;
  o.pdf = GetParam().wrong;
  EXPECT_EQ(run(o).code, carlo::exit_failed);
}

INSTANTIATE_TEST_SUITE_P(SamplesFile, ByExpression, testing::ValuesIn(expression_help),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_F(SamplesFile, InvalidDomainsAndExpressions_AreOneLineErrors) {
  const std::string file = samples(ramp);
  const auto with = [&](const std::string& domain, const std::string& pdf) {
    ValidateCommandOptions o = options(file, "");
    o.domain = domain;
    o.pdf = pdf;
    return refusal(o);
  };
  EXPECT_THAT(with("dick", "1"), HasSubstr("did you mean 'disk'?"));
  EXPECT_THAT(with("x=0:1,x=0:1", "1"), HasSubstr("'x' is bounded twice"));
  EXPECT_THAT(with("x=1:0,y=0:1", "1"), HasSubstr("lo < hi is needed"));
  EXPECT_THAT(with("x=0:1", "1"), HasSubstr("s.csv: 2 columns; 1 is needed on x in [0, 1]"));
  EXPECT_THAT(with("sphere", "1"), HasSubstr("2 columns; 3 are needed on the unit sphere"));
  EXPECT_THAT(with("x=0:0.5,y=0:1", "1"), HasSubstr("is not in x in [0, 0.5], y in [0, 1]; "));
  EXPECT_THAT(with("x=0:1,y=0:1", "2*q"), HasSubstr("expression '2*q', position"));
  EXPECT_THAT(with("annulus=2", "1"), HasSubstr("needs a radius in (0, 1)"));
  EXPECT_THAT(with("discrete=0", "1"), HasSubstr("1 to 2^24 outcomes"));
  EXPECT_THAT(with("disk", ""), HasSubstr("needs a density to compare the samples with: --pdf-file or --pdf"));
}

} // namespace

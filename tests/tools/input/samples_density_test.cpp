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

std::string draw_triangle(mc::Pcg& r) {
  double x = r.uniform<double>(), y = r.uniform<double>();
  if (x + y > 1) {
    x = 1 - x;
    y = 1 - y;
  }
  return fmt::format("{:.6f},{:.6f}", x, y);
}

std::string draw_sphere_and_interval(mc::Pcg& r) {
  std::string w = cosine(r);
  std::replace(w.begin(), w.end(), ' ', ',');
  return fmt::format("{},{:.6f}", w, 2 * std::sqrt(r.uniform<double>()));
}

std::string draw_discrete(mc::Pcg& r) {
  const double u = 10 * r.uniform<double>();
  return fmt::format("{}", u < 1 ? 0 : u < 3 ? 1 : u < 6 ? 2 : 3);
}

std::string draw_four_dimensions(mc::Pcg& r) {
  const double x = r.uniform<double>(), root = std::sqrt(r.uniform<double>());
  const double y = r.uniform<double>() < x ? root : 1 - root;
  return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}", x, y, r.uniform<double>(), r.uniform<double>());
}

std::string draw_six_dimensions(mc::Pcg& r) {
  std::array<double, 6> x{};
  for (double& one : x) one = normal(r);
  return fmt::format("{:.6g}", fmt::join(x, ","));
}

std::string draw_rotation(mc::Pcg& r) {
  std::array<double, 4> q{normal(r), normal(r), normal(r), normal(r)};
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  for (double& one : q) one /= length;
  return fmt::format("{:.6f}", fmt::join(q, ","));
}

std::string draw_poisson(mc::Pcg& r) {
  int k = 0;
  for (double product = r.uniform<double>(); product > std::exp(-3.0); product *= r.uniform<double>()) ++k;
  return fmt::format("{}", k);
}

std::string draw_two_sided_geometric(mc::Pcg& r) {
  const auto geometric = [&] { return static_cast<int>(std::log2(1 / (1 - r.uniform<double>()))); };
  const int k = geometric();
  return fmt::format("{}", k - geometric());
}

std::string draw_points_and_outcomes(mc::Pcg& r) {
  const double u = r.uniform<double>();
  return u < 0.6 ? fmt::format("-1,{:.6f}", std::sqrt(r.uniform<double>())) : u < 0.9 ? "0,0" : "1,0.5";
}

const std::vector<Expression> expressions = {
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
    {"triangle", "triangle", "2", "6*x", draw_triangle},
    {"hemisphere", "hemisphere", "z/_pi", "1/(2*_pi)", cosine},
    {"sphere_and_interval", "sphere,t=0:2", "(z>0 ? z/_pi : 0)*t/2", "(z>0 ? z/_pi : 0)/2", draw_sphere_and_interval},
    {"discrete", "discrete=4", "(i+1)/10", "0.25", draw_discrete},
    {"four_dimensions", "x=0:1,y=0:1,z=0:1,w=0:1", "2*(x*y+(1-x)*(1-y))", "1", draw_four_dimensions},
    {"six_dimensions", "a=-inf:inf,b=-inf:inf,c=-inf:inf,d=-inf:inf,e=-inf:inf,f=-inf:inf",
     "exp(-(a*a+b*b+c*c+d*d+e*e+f*f)/2)/(2*_pi)^3",
     "exp(-(b*b+c*c+d*d+e*e+(a*a+f*f-0.4*a*f)/0.96)/2)/(2*_pi)^3/sqrt(0.96)", draw_six_dimensions},
    {"rotation", "rotation", "1/_pi^2", "(0.8+0.8*w*w)/_pi^2", draw_rotation},
    {"poisson", "discrete=0:inf", "exp(-3)*3^i/gamma(i+1)", "exp(-3.2)*3.2^i/gamma(i+1)", draw_poisson},
    {"two_sided_geometric", "discrete=-inf:inf", "0.5^abs(i)/3", "0.4^abs(i)*3/7", draw_two_sided_geometric},
    {"points_and_outcomes", "outcome=2,x=0:1", "outcome<0 ? 0.6*2*x : outcome<1 ? 0.3 : 0.1",
     "outcome<0 ? 0.6*2*x : outcome<1 ? 0.27 : 0.13", draw_points_and_outcomes},
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

INSTANTIATE_TEST_SUITE_P(SamplesFile, ByExpression, testing::ValuesIn(expressions),
                         [](const auto& one) { return std::string(one.param.name); });

// Logarithms beyond the range of double, up to a constant.
TEST_F(SamplesFile, LogDensity_Unnormalized) {
  ValidateCommandOptions o = options(samples([](mc::Pcg& r) { return fmt::format("{:.6g}", normal(r)); }), "");
  o.domain = "x=-inf:inf";
  o.log_density = o.unnormalized = true;
  o.pdf = "-x*x/2-5000";
  EXPECT_EQ(run(o).code, carlo::exit_ok);
  o.pdf = "-x*x/2.2-5000";
  EXPECT_EQ(run(o).code, carlo::exit_failed);
  o.unnormalized = false;
  o.pdf = "-x*x/2-log(2*_pi)/2";
  EXPECT_EQ(run(o).code, carlo::exit_ok);
}

// The Metropolis algorithm with normal steps, on a normal density.
std::function<std::string(mc::Pcg&)> metropolis(double step) {
  return [x = 0.0, step](mc::Pcg& r) mutable {
    const double next = x + step * normal(r);
    if (r.uniform<double>() < std::exp((x * x - next * next) / 2)) x = next;
    return fmt::format("{:.6g}", x);
  };
}

TEST_F(SamplesFile, MarkovChain_PassesWhenThinned) {
  ValidateCommandOptions o = options(samples(metropolis(2.4), "s.csv", 200'000), "");
  o.domain = "x=-inf:inf";
  o.pdf = "exp(-x*x/2)/sqrt(2*_pi)";
  EXPECT_THAT(run(o).text, HasSubstr("--thin auto keeps independent rows of a Markov chain"));
  o.thin = "auto";
  const Output thinned = run(o);
  EXPECT_EQ(thinned.code, carlo::exit_ok) << thinned.text;
  EXPECT_THAT(thinned.text, HasSubstr("s.csv: autocorrelation time "));
  o.pdf = "exp(-x*x/2.4)/sqrt(2.4*_pi)";
  EXPECT_EQ(run(o).code, carlo::exit_failed);
  o.thin = "500";
  EXPECT_THAT(refusal(o), HasSubstr("leaves 400, and 2000 are needed: 5 times as many rows"));
  o.thin = "some";
  EXPECT_THAT(refusal(o), HasSubstr("--thin 'some' must be auto or a whole number of rows"));
}

TEST_F(SamplesFile, SumThatDoesNotConverge_IsRefused) {
  ValidateCommandOptions o =
      options(samples([](mc::Pcg& r) { return fmt::format("{}", int(1 / r.uniform<double>())); }), "");
  o.domain = "discrete=1:inf";
  o.pdf = "1/i^1.1";
  o.unnormalized = true;
  EXPECT_THAT(refusal(o), HasSubstr("does not converge within"));
}

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
  EXPECT_THAT(with("discrete=0.5:3", "1"), HasSubstr("0.5 is no whole number"));
  EXPECT_THAT(with("outcome=2", "1"), HasSubstr("'outcome=2' has no points; discrete=N has outcomes alone"));
  EXPECT_THAT(with("a=0:1,b=0:1,c=0:1,d=0:1,e=0:1,f=0:1,g=0:1", "1"), HasSubstr("at most 6 columns"));
  EXPECT_THAT(with("disk", ""), HasSubstr("needs a density to compare the samples with: --pdf-file or --pdf"));
}

} // namespace

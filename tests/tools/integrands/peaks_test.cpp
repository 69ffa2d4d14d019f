// Named peaks: the density, and integrals that uniform points get wrong.

#include <integrands/expression_integral.h>
#include <integrands/peaks.h>
#include <support/files.h>
#include <tools/run_carlo.h>

#include <mc/core/types.h>
#include <mc/estimate/integrate.h>
#include <mc/random/pcg.h>

#include <gmock/gmock.h>

#include <cmath>

namespace {

using carlo::ImportanceDensity, carlo::JointIntegrand, carlo::parse_bounds, carlo::parse_expression, carlo::PeakMixture;
using support::error_of, support::run_carlo;
using testing::HasSubstr;

mc::Integral integrated(const std::string& expression, const std::string& box, const std::vector<std::string>& peaks,
                        std::uint64_t seed = 1, double rel_error = 1e-3) {
  const JointIntegrand f = importance_sampled(carlo::joined({parse_expression(expression, {.domain = box})}),
                                              PeakMixture(peaks, parse_bounds(box)).density());
  mc::IntegrateOptions o;
  o.method = mc::Method::rqmc;
  o.rel_error = rel_error;
  o.seed = seed;
  return mc::integrate_unit(mc::BatchIntegrand{f.f}, f.dim(), o);
}

// The mean of 1 / density over the samples is the volume of the cube; samples lie inside.
TEST(Peaks, DensityIntegratesToOne) {
  const struct {
    const char* box;
    std::vector<std::string> peaks;
  } cases[] = {{"x=0:1,y=0:1", {"x=0.3,y=0.6 width 0.01"}},
               {"x=0:1,y=-4:1", {"x=0 width 1e-12", "x=1,y=-4 width 0.5,1e-3"}},
               {"x=-inf:inf,y=0:inf", {"x=100,y=3 width 0.1"}},
               {"x=-inf:-2", {"x=-7 width 1e-3", "x=-2 width 10"}},
               {"x=0:1", {"x=_pi/4 width 1e6"}}};
  for (const auto& c : cases) {
    const ImportanceDensity d = PeakMixture(c.peaks, parse_bounds(c.box)).density();
    const std::size_t dim = static_cast<std::size_t>(d.uniforms) - 1, count = 100'000;
    mc::Pcg random(7);
    std::vector<double> u(count * (dim + 1)), v(count * dim), densities(count);
    for (double& one : u) one = random.uniform<double>();
    d.draw(u, v, densities);
    double sum = 0;
    for (const double density : densities) {
      ASSERT_GE(density, 0.5);
      sum += 1 / density;
    }
    for (const double one : v) ASSERT_TRUE(one > 0 && one < 1) << c.box << " " << one;
    EXPECT_NEAR(sum / double(count), 1, 0.02) << c.box; // 6 standard errors: 1 / density is at most 2
  }
}

// Closed forms; the truth lies within the interval in at least 88 of 100 runs (fewer for 1.5e-3 of the
// choices of seeds).
TEST(Peaks, IntervalsContainTheTruth) {
  const struct {
    const char *expression, *box, *peak;
    double truth;
  } cases[] = {{"1+1000*exp(-((x-.3)^2+(y-.6)^2)*1e5)", "x=0:1,y=0:1", "x=0.3,y=0.6 width 0.01",
                1 + 1000 * mc::pi<double> / 1e5},
               {"1+1000*exp(-((x-.3)^2+(y-.6)^2)*1e5)", "x=0:1,y=0:1", "x=0.3,y=0.6 width 0.001",
                1 + 1000 * mc::pi<double> / 1e5},
               {"x+1e6*exp(-1e12*(x-0.3)^2)", "x=0:1", "x=0.3 width 1e-6", 0.5 + std::sqrt(mc::pi<double>)},
               {"x+1e6*exp(-1e12*(x-0.3)^2)", "x=0:1", "x=0.3 width 1e-5", 0.5 + std::sqrt(mc::pi<double>)},
               {"exp(-x*x/2)+1e4*exp(-1e8*(x-5)^2)", "x=-inf:inf", "x=5 width 1e-4",
                std::sqrt(2 * mc::pi<double>) + std::sqrt(mc::pi<double>)},
               {"1", "x=0:2,y=0:3", "x=1,y=1 width 0.1", 6}};
  for (const auto& c : cases) {
    int held = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const mc::Integral r = integrated(c.expression, c.box, {c.peak}, seed);
      held += r.interval.lo <= c.truth && c.truth <= r.interval.hi;
    }
    EXPECT_GE(held, 88) << c.expression << " " << c.peak;
  }
}

TEST(Peaks, SeveralPeaksShareThePoints) {
  const mc::Integral r = integrated("1e3*exp(-1e6*((x-.2)^2+(y-.2)^2))+1e3*exp(-1e6*((x-.8)^2+(y-.7)^2))",
                                    "x=0:1,y=0:1", {"x=0.2,y=0.2 width 1e-3", "x=0.8,y=0.7 width 1e-3"});
  EXPECT_EQ(r.stop, mc::StopReason::converged);
  EXPECT_NEAR(r.estimate.value, 2 * mc::pi<double> / 1e3, 5 * r.estimate.std_error);
}

TEST(Peaks, BadPlaceIsRefused) {
  const auto refusal = [](const std::string& peak, const char* box = "x=0:1,y=0:1") {
    return error_of([&] { PeakMixture({peak}, parse_bounds(box)); });
  };
  EXPECT_EQ(refusal("x=0.3,y=0.6 width 0.01"), "");
  EXPECT_EQ(refusal(" x = 1/3 , y=_pi/4 width 1e-3, 1e-2"), "");
  EXPECT_THAT(refusal("x=0.3"), HasSubstr("--peak 'x=0.3': it is not of the form \"x=0.3,y=0.6 width 0.01\""));
  EXPECT_THAT(refusal("z=0.3 width 1"), HasSubstr("there is no variable 'z'; the variables are x, y"));
  EXPECT_THAT(refusal("x=2 width 1"), HasSubstr("x = 2 lies outside of its bounds 0 and 1"));
  EXPECT_THAT(refusal("x=0.3 width 0"), HasSubstr("the width 0 of x must be above 0"));
  EXPECT_THAT(refusal("x=0.3 width -1"), HasSubstr("must be above 0"));
  EXPECT_THAT(refusal("x=0.3 width one"), HasSubstr("one"));
  EXPECT_THAT(refusal("x=0.3 width 1/0"), HasSubstr("'1/0' is inf; a finite number is needed"));
  EXPECT_THAT(refusal("x=0.3,x=0.4 width 1"), HasSubstr("it names 'x' twice"));
  EXPECT_THAT(refusal("x=0.3,y=0.4 width 1,2,3"), HasSubstr("3 widths of 2 variables"));
  EXPECT_THAT(refusal("x=0.3 width 1e-17"), HasSubstr("which doubles resolve at 0.3; shift x to 0 there"));
  EXPECT_THAT(refusal("x=1e6 width 1e-6", "x=0:inf"), HasSubstr("which doubles resolve at 1e+06"));
  EXPECT_EQ(refusal("x=0 width 1e-30"), "");
}

TEST(Peaks, CommandLine_FindsWhatUniformPointsMiss) {
  const auto r = run_carlo("integrate 'x+1e6*exp(-1e12*(x-0.3)^2)' -d x=0:1 --peak 'x=0.3 width 1e-6'");
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, HasSubstr("= 2.27"));
  EXPECT_EQ(run_carlo("integrate x -d x=0:1 --peak 'x=2 width 1'").exit_code, 2);
  EXPECT_THAT(run_carlo("integrate x -d x=0:1 --peak 'x=.2 width 1' --histogram x=4").output,
              HasSubstr("--histogram and --quantiles need uniform points; leave out --peak"));
}

} // namespace

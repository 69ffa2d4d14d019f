#include <integrate/histogram.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <cmath>

namespace {

using support::error_of;
using testing::HasSubstr;

// Bins and their integrals, by rqmc.
struct Parts {
  std::vector<carlo::HistogramBin> bins;
  mc::VectorIntegral r;
};
Parts parts(const std::string& option, const std::string& expression, const carlo::ExpressionContext& context) {
  const carlo::IntegrandSet set = carlo::find_integrands({expression}, context);
  const carlo::Histogram h = carlo::make_histogram(option, set, 1);
  return {h.bins, carlo::integrate(h, set.dim(), {.rel_error = 1e-4, .max_calls = 50'000})};
}

double sum(const mc::VectorIntegral& r) {
  double all = 0;
  for (std::size_t k = 1; k < r.outputs.size(); ++k) all += r.outputs[k].estimate.value;
  return all;
}

// The radius in a disk: rings of area pi (hi^2 - lo^2).
TEST(Histogram, OfAnObservableHasTheRings) {
  const Parts p = parts("r=0:1:5", "1", {.domain = "x=-1:1,y=-1:1", .conditions = {"r<1"}, .lets = {"r=hypot(x,y)"}});
  ASSERT_EQ(p.bins.size(), 7u);
  EXPECT_EQ(p.bins[0].name, "r < 0");
  EXPECT_EQ(p.bins[6].name, "r >= 1");
  for (std::size_t k = 1; k < 6; ++k) {
    const double area = mc::pi<double> * (mc::sqr(p.bins[k].hi) - mc::sqr(p.bins[k].lo));
    EXPECT_NEAR(p.r.outputs[1 + k].estimate.value, area, 5 * p.r.outputs[1 + k].estimate.std_error) << k;
  }
  EXPECT_NEAR(sum(p.r), p.r.outputs[0].estimate.value, 1e-12);
}

TEST(Histogram, OfAnExpressionFindsItsRange) {
  const Parts p = parts("x+y=4", "x*y", {.domain = "x=0:1,y=0:1"});
  ASSERT_EQ(p.bins.size(), 6u);
  EXPECT_GT(p.bins[1].lo, 0);
  EXPECT_LT(p.bins[4].hi, 2);
  EXPECT_NEAR(sum(p.r), p.r.outputs[0].estimate.value, 1e-12);
}

TEST(Histogram, OfASummedVariableCountsItsTerms) {
  const Parts p = parts("k=0.5:3.5:3", "k*x", {.domain = "x=0:1,k=1..3"});
  for (std::size_t k = 1; k <= 3; ++k) EXPECT_NEAR(p.r.outputs[1 + k].estimate.value, double(k) / 2, 1e-3);
}

TEST(Histogram, OfANormalVariableHasBinsOfEqualProbability) {
  const Parts p = parts("z=4", "1", {.domain = "z=normal(1,2)"});
  EXPECT_EQ(p.bins[1].hi, 1);
  for (std::size_t k = 1; k <= 4; ++k) EXPECT_NEAR(p.r.outputs[k].estimate.value, 0.25, 1e-3);
}

TEST(Histogram, OfANamedIntegrandFollowsTheCube) {
  const Parts p = parts("u0=0:0.5:2", "pi", {});
  ASSERT_EQ(p.bins.size(), 4u);
  EXPECT_EQ(p.bins[1].hi, 0.25);
  EXPECT_NEAR(sum(p.r), p.r.outputs[0].estimate.value, 1e-12);
  EXPECT_EQ(parts("value=3", "pi", {}).bins.size(), 3u);
}

TEST(Histogram, BadInput_IsRefused) {
  const auto refused = [](const std::string& option, const std::string& expression = "x") {
    return error_of([&] { parts(option, expression, {.domain = "x=0:1"}); });
  };
  EXPECT_THAT(refused("x"), HasSubstr("must be AXIS=BINS"));
  EXPECT_THAT(refused("x=1"), HasSubstr("between 2 and 1000"));
  EXPECT_THAT(refused("x=0:1"), HasSubstr("must be AXIS=BINS or AXIS=LO:HI:BINS"));
  EXPECT_THAT(refused("x=1:0:5"), HasSubstr("LO < HI"));
  EXPECT_THAT(refused("x=a:1:5"), HasSubstr("'a' is not a number"));
  EXPECT_THAT(refused("y=5"), HasSubstr("--histogram: expression 'y', position 0: unknown name 'y'; use one of x"));
  EXPECT_THAT(refused("x*0=5"), HasSubstr("had no two values"));
  EXPECT_THAT(error_of([] { parts("u7=5", "pi", {}); }), HasSubstr("there is no variable 'u7'"));
}

} // namespace

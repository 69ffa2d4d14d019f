// Every domain that a text can describe: its points, the round trip through its chart, and its measure.

#include <input/parsed_domain.h>

#include <mc/random/pcg.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <numbers>

namespace {

using carlo::parse_domain, carlo::ParsedDomain, carlo::Rounding;
using support::error_of;
using testing::HasSubstr;

struct Named {
  const char* text;
  int dim;
  std::size_t columns;
  double measure; ///< infinite: not tested
  mc::PointArray outside;
};

using std::numbers::pi;
constexpr double infinity = HUGE_VAL;

void PrintTo(const Named& named, std::ostream* out) { *out << named.text; }

class EveryDomain : public testing::TestWithParam<Named> {};

TEST_P(EveryDomain, ChartRoundTrips) {
  const Named& named = GetParam();
  for (const Rounding rounding : {Rounding::printed, Rounding::doubles, Rounding::floats}) {
    const ParsedDomain d = parse_domain(named.text, carlo::unknown_quartiles, rounding);
    EXPECT_EQ(d.chart.dim, named.dim);
    EXPECT_EQ(d.columns.size(), named.columns);
    EXPECT_EQ(d.chart.axes.size(), static_cast<std::size_t>(named.dim));
    EXPECT_FALSE(d.chart.contains(named.outside));
    EXPECT_FALSE(d.chart.contains({NAN, NAN, NAN, NAN}));
    mc::Pcg random(5);
    double measure = 0;
    for (int i = 0; i < 1000; ++i) {
      mc::AnyDomain::Coordinates v{};
      for (std::size_t k = 0; k < static_cast<std::size_t>(named.dim); ++k) v[k] = random.uniform<double>();
      const mc::AnyDomain::DomainPoint at = d.chart.from_unit(v);
      measure += at.jacobian / 1000;
      EXPECT_TRUE(rounding == Rounding::floats || d.chart.contains(at.x)) << named.text;
      const mc::AnyDomain::Coordinates back = d.chart.to_unit(at.x);
      for (std::size_t k = 0; k < v.size(); ++k) EXPECT_NEAR(back[k], v[k], 1e-12) << named.text;
    }
    // The charts of bounded domains have constant Jacobians, except for the triangle.
    if (std::isfinite(named.measure)) {
      EXPECT_NEAR(measure, named.measure, 0.1 * named.measure) << named.text;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    ParsedDomain, EveryDomain,
    testing::Values(Named{"x=-1:3", 1, 1, 4, {3.1}}, Named{"x=2:inf", 1, 1, infinity, {1.9}},
                    Named{"x=-inf:2", 1, 1, infinity, {2.1}}, Named{"x=-inf:inf", 1, 1, infinity, {infinity}},
                    Named{"x=-inf:inf,y=-inf:inf,z=-inf:inf", 3, 3, infinity, {0, 0, infinity}},
                    Named{"disk", 2, 2, pi, {1, 0.1}}, Named{"annulus=0.5", 2, 2, 0.75 * pi, {0.3, 0.3}},
                    Named{"triangle", 2, 2, 0.5, {0.6, 0.5}}, Named{"ball", 3, 3, 4 * pi / 3, {1, 0.1, 0}},
                    Named{"sphere", 2, 3, 4 * pi, {1, 0.1, 0}}, Named{"hemisphere", 2, 3, 2 * pi, {0, 0, -1}},
                    Named{"sphere,t=0:2", 3, 4, 8 * pi, {0, 0, 1, 2.1}},
                    Named{"t=0:2,sphere", 3, 4, 8 * pi, {2.1, 0, 0, 1}},
                    Named{"rotation", 3, 4, pi* pi, {0.6, 0.8, 0, 0.1}},
                    Named{"rotation,a=0:2,b=-1:1", 5, 6, 4 * pi* pi, {0, 0, 0, 1, 1, 2}},
                    Named{"a=0:1,b=0:1,c=0:1,d=0:1,e=0:1,f=0:3", 6, 6, 3, {0, 0, 0, 0, 0, 4}}));

TEST(ParsedDomain, PrintedPoints_MayBeRounded) {
  const mc::PointArray w{0.6, 0.8, 1e-6};
  EXPECT_TRUE(parse_domain("sphere").chart.contains({0.600005, 0.8, 0}));
  EXPECT_FALSE(parse_domain("sphere", carlo::unknown_quartiles, Rounding::floats).chart.contains({0.600005, 0.8, 0}));
  EXPECT_TRUE(parse_domain("sphere", carlo::unknown_quartiles, Rounding::floats).chart.contains(w));
  EXPECT_TRUE(parse_domain("x=0:0.1", carlo::unknown_quartiles, Rounding::floats).chart.contains({0.1f}));
  EXPECT_FALSE(parse_domain("x=0:0.1", carlo::unknown_quartiles, Rounding::doubles).chart.contains({0.1f}));
}

TEST(ParsedDomain, Outcomes_AreIntegers) {
  const ParsedDomain d = parse_domain("discrete=3");
  EXPECT_EQ(d.outcomes.count(), 3);
  EXPECT_EQ(d.chart.dim, 0);
  const auto contains = [&](double k) { return d.contains(&k); };
  EXPECT_TRUE(contains(2));
  EXPECT_FALSE(contains(3));
  EXPECT_FALSE(contains(0.5));
  EXPECT_FALSE(contains(NAN));
  EXPECT_EQ(parse_domain("discrete=-3:4").outcomes.count(), 8);
}

TEST(ParsedDomain, PointsAndOutcomes_HaveAFirstColumn) {
  const ParsedDomain d = parse_domain("outcome=2,x=0:3");
  EXPECT_TRUE(d.is_mixed());
  EXPECT_EQ(d.columns, (std::vector<std::string>{"outcome", "x"}));
  const std::array<double, 2> point{-1, 2.5}, outcome{1, 99}, none{2, 0}, outside{-1, 4};
  EXPECT_EQ(d.outcome_of(point.data()), -1);
  EXPECT_EQ(d.outcome_of(outcome.data()), 1);
  EXPECT_EQ(d.point_of(point.data())[0], 2.5);
  EXPECT_EQ(d.row_of(mc::PointArray{2.5}), (std::vector<double>{-1, 2.5}));
  EXPECT_EQ(d.row_of(1), (std::vector<double>{1, 0}));
  EXPECT_TRUE(d.contains(point.data()) && d.contains(outcome.data()));
  EXPECT_FALSE(d.contains(none.data()) || d.contains(outside.data()));
}

TEST(ParsedDomain, WhiteSpace_IsIgnored) {
  EXPECT_EQ(parse_domain(" t = 0 : 1,\n\tdisk \r\n").text, parse_domain("t=0:1,disk").text);
  EXPECT_EQ(parse_domain("discrete = 3\n").outcomes.count(), 3);
}

TEST(ParsedDomain, InvalidText_IsOneLineError) {
  const auto refused = [](const char* text) { return error_of([&] { parse_domain(text); }); };
  EXPECT_THAT(refused(""), HasSubstr("'' is not of the form name=lo:hi"));
  EXPECT_THAT(refused("sphere,rotation"), HasSubstr("5 dimensions in 7 columns"));
  EXPECT_THAT(refused("disk,x=0:1"), HasSubstr("'x' is bounded twice"));
  EXPECT_THAT(refused("x=0:nan"), HasSubstr("'nan' in 'x=0:nan' is not a number"));
  EXPECT_THAT(refused("x=0:1,discrete=3"), HasSubstr("'discrete=3' stands alone"));
}

TEST(ParsedDomain, Breaks_AreInAxisUnits) {
  const auto breaks = [](const char* domain, const char* text) {
    return carlo::parse_breaks(text, parse_domain(domain).chart);
  };
  EXPECT_EQ(breaks("x=0:4,y=-1:1", "x=1,3,y=0")[0], (std::vector<double>{0.25, 0.75}));
  EXPECT_EQ(breaks("x=0:4,y=-1:1", "x=1,3,y=0")[1], (std::vector<double>{0.5}));
  EXPECT_EQ(breaks("x=0:1", "x=0:1:0.25")[0], (std::vector<double>{0.25, 0.5, 0.75}));
  EXPECT_NEAR(breaks("disk", "r=0.5")[0][0], 0.25, 1e-15);
  EXPECT_NEAR(breaks("hemisphere", "theta=60,phi=90")[0][0], 0.5, 1e-15);
  EXPECT_NEAR(breaks("hemisphere", "theta=60,phi=90")[1][0], 0.25, 1e-15);
  EXPECT_NEAR(breaks("x=-inf:5", "x=4")[0][0], parse_domain("x=-inf:5").chart.to_unit({4})[0], 1e-12);
  EXPECT_NEAR(breaks("x=-inf:inf", "x=-3")[0][0], parse_domain("x=-inf:inf").chart.to_unit({-3})[0], 1e-12);
  const auto refused = [&](const char* text) { return error_of([&] { breaks("disk", text); }); };
  EXPECT_THAT(refused("x=1"), HasSubstr("--breaks: 'x' is no axis of the domain; it has r, phi"));
  EXPECT_THAT(refused("r=2"), HasSubstr("--breaks: a break of r at 2 lies outside of the domain"));
  EXPECT_THAT(refused("r"), HasSubstr("--breaks: 'r' in 'r' is not of the form name=number"));
}

TEST(ParsedDomain, Quartiles_IgnoreNonFinite) {
  EXPECT_EQ(carlo::quartiles_of({4, NAN, 1, 2, 3, HUGE_VAL}), (std::array<double, 3>{2, 3, 4}));
  EXPECT_EQ(carlo::quartiles_of({NAN}), carlo::unknown_quartiles(0));
}

} // namespace

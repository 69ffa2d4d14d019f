#include <integrands/variable_bounds.h>

#include <mc/core/error.h>

#include <gmock/gmock.h>

#include <cmath>
#include <map>

namespace {

// The slope equals the derivative dx/du, and x increases from lo to hi.
TEST(VariableBounds, MapIsMonotoneAndHasItsDerivative) {
  for (const char* box : {"x=-2:3", "x=1:inf", "x=-inf:-1", "x=-inf:inf"}) {
    const carlo::VariableBounds side = carlo::parse_bounds(box)[0];
    EXPECT_EQ(carlo::map_to_bounds(side, 0).x, side.lo) << box;
    for (double u = 0.01; u < 0.995; u += 0.01) {
      const double h = 1e-6, rise = carlo::map_to_bounds(side, u + h).x - carlo::map_to_bounds(side, u - h).x;
      EXPECT_NEAR(carlo::map_to_bounds(side, u).slope / (rise / (2 * h)), 1, 1e-6) << box << " at " << u;
    }
    const double last = carlo::map_to_bounds(side, 1 - 0x1p-53).x;
    EXPECT_TRUE(std::isfinite(last)) << box;
    EXPECT_TRUE(std::isfinite(side.hi) ? std::abs(last - side.hi) < 1e-14 : last > 1e14) << box;
  }
}

TEST(VariableBounds, AcceptBlanks) {
  const std::vector<carlo::VariableBounds> bounds = carlo::parse_bounds(" x = 0 : 1,\ty= -inf :2\r\n");
  ASSERT_EQ(bounds.size(), 2u);
  EXPECT_EQ(bounds[0].name, "x");
  EXPECT_EQ(bounds[0].hi, 1);
  EXPECT_EQ(bounds[1].name, "y");
  EXPECT_EQ(bounds[1].lo, -HUGE_VAL);
}

TEST(VariableBounds, SplitDomainReadsEveryKind) {
  using Kind = carlo::VariableText::Kind;
  const std::vector<carlo::VariableText> v =
      carlo::split_domain("x=0:max(1, 2), y = if(x<1,x,2) : inf ,z=normal, w=normal( x, max(1,y) ),k=1 .. n");
  ASSERT_EQ(v.size(), 5u);
  const Kind kinds[] = {Kind::interval, Kind::interval, Kind::normal, Kind::normal, Kind::integers};
  const char* parts[][3] = {
      {"x", "0", "max(1, 2)"}, {"y", "if(x<1,x,2)", "inf"}, {"z", "0", "1"}, {"w", "x", "max(1,y)"}, {"k", "1", "n"}};
  for (std::size_t i = 0; i < v.size(); ++i) {
    EXPECT_EQ(v[i].kind, kinds[i]);
    EXPECT_EQ((std::vector{v[i].name, v[i].first, v[i].second}),
              (std::vector<std::string>{parts[i][0], parts[i][1], parts[i][2]}));
  }
  EXPECT_TRUE(carlo::is_domain("y=0:1"));
  for (const char* text : {"y", "y==0", "x*y", "", "y<1?0:1"}) EXPECT_FALSE(carlo::is_domain(text)) << text;
}

// The weights are inverse probabilities: each integer gets its share of the cube.
TEST(VariableBounds, IntegersHaveTheirProbabilities) {
  const double inf = HUGE_VAL;
  const std::pair<double, double> ranges[] = {{-2, 3}, {1, inf}, {-inf, -1}, {-inf, inf}};
  for (const auto& [lo, hi] : ranges) {
    constexpr int n = 1 << 20;
    std::map<double, std::pair<int, double>> counts;
    for (int i = 0; i < n; ++i) {
      const carlo::MappedPoint at = carlo::map_to_integers(lo, hi, (i + 0.5) / n);
      EXPECT_TRUE(at.x >= lo && at.x <= hi && at.x == std::floor(at.x));
      ++counts[at.x].first;
      counts[at.x].second = at.slope;
    }
    for (const auto& [k, count] : counts)
      if (std::abs(k) < 50) {
        EXPECT_NEAR(count.first / double(n), 1 / count.second, 2.0 / n) << k;
      }
    EXPECT_GE(counts.size(), 6u);
  }
}

std::string message(const std::string& box) {
  try {
    carlo::parse_bounds(box);
  } catch (const mc::Error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(VariableBounds, AcceptConstantExpressions) {
  const std::vector<carlo::VariableBounds> bounds =
      carlo::parse_bounds("phi=-_pi: 2*_pi ,y=1/4:sqrt(2),z=-inf:(1+2)^2");
  ASSERT_EQ(bounds.size(), 3u);
  EXPECT_EQ(bounds[0].lo, -M_PI);
  EXPECT_EQ(bounds[0].hi, 2 * M_PI);
  EXPECT_EQ(bounds[1].lo, 0.25);
  EXPECT_EQ(bounds[1].hi, std::sqrt(2.0));
  EXPECT_EQ(bounds[2].lo, -HUGE_VAL);
  EXPECT_EQ(bounds[2].hi, 9);
  const std::string none = " is not a number, inf, -inf or a constant expression: ";
  EXPECT_EQ(message("x=0:2*pi"), "--domain: '2*pi' in 'x=0:2*pi'" + none + "expression '2*pi', position 2: pi is _pi");
  EXPECT_EQ(message("x=0:1,y=0:2*x"), "--domain: '2*x' in 'y=0:2*x'" + none +
                                          "expression '2*x', position 2: unknown name 'x'; use one of _e, _pi");
  for (const std::string bad : {"1/0", "0/0", "-1/0"})
    EXPECT_THAT(message("x=0:" + bad), testing::HasSubstr("not a number, inf or -inf")) << bad;
  for (const std::string bad : {"", "nan", "1e999", "one", "1,2"})
    EXPECT_THAT(message("x=0:" + bad), testing::StartsWith("--domain: '")) << bad;
}

// No point of the open cube is mapped to a bound, where an integrand may be infinite.
TEST(VariableBounds, OpenCubeIsMappedStrictlyInside) {
  constexpr double first = 0x1p-54, last = 1 - 0x1p-53;
  for (const auto& [lo, hi] :
       {std::pair(0.0, 1.0), {1.0, 2.0}, {-1.0, 0.0}, {-3.0, -1.0}, {1e6, 1e6 + 1}, {0.1, 1e300}})
    for (const double u : {first, 0x1p-25, 0.5, 1 - 0x1p-24, last}) {
      const double x = carlo::map_to_bounds(lo, hi, u).x;
      EXPECT_TRUE(lo < x && x < hi) << lo << " " << hi << " " << u;
    }
  for (const double u : {first, 0.5, last}) {
    EXPECT_GT(carlo::map_to_bounds(7, HUGE_VAL, u).x, 7);
    EXPECT_LT(carlo::map_to_bounds(-HUGE_VAL, 7, u).x, 7);
    EXPECT_TRUE(std::isfinite(carlo::map_to_bounds(-HUGE_VAL, HUGE_VAL, u).x));
  }
  EXPECT_EQ(carlo::map_to_bounds(1, 2, 0).x, 1);
  EXPECT_EQ(carlo::map_to_bounds(1, 2, 1).x, 2);
}

TEST(VariableBounds, RejectInvalidVariableNames) {
  for (const std::string name : {"3x", "x y", "\u00e9", "x-1", "x\ty"})
    EXPECT_EQ(message("a=0:1," + name + "=0:1"),
              "--domain: '" + name + "' is no name of a variable: a letter or _, then letters, digits and _");
  for (const std::string name : {"_pi", "_e", "sin", "if", "not", "and", "or"})
    EXPECT_EQ(message(name + "=0:1"),
              "--domain: '" + name + "' is no name of a variable: it means something in expressions; choose another");
  for (const std::string name : {"x", "X_1", "_", "sine", "pi", "e"}) EXPECT_EQ(message(name + "=0:1"), "accepted");
}

} // namespace

#include <render/film/filter.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace {

using namespace render;

/// Mean, variance, largest |x| and covariance of the first axis, by the midpoint rule.
struct Axis {
  double mean = 0, variance = 0, reach = 0, covariance = 0;
};
Axis axis(const Filter& filter, int n = 400) {
  Axis a;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec2 p = filter.sample(Vec2((Float(i) + Float(0.5)) / Float(n), (Float(j) + Float(0.5)) / Float(n)));
      a.mean += double(p[0]) / (n * n);
      a.variance += double(p[0] * p[0]) / (n * n);
      a.covariance += double(p[0] * p[1]) / (n * n);
      a.reach = std::max(a.reach, double(std::abs(p[0])));
    }
  return a;
}

TEST(Filter, VariancesAreThoseOfTheirShapes) {
  struct Row {
    const char* name;
    Filter filter;
    double variance, reach, tolerance;
  };
  for (const Row& row : {Row{"box", BoxFilter{Float(0.5)}, 1 / 12.0, 0.5, 1e-4},
                         {"wide box", BoxFilter{2}, 4 / 3.0, 2, 1e-4},
                         // The sample is a square root at the ends, so the midpoint rule has the error O(n^-1.5).
                         {"tent", TentFilter{1}, 1 / 6.0, 1, 5e-4},
                         // The midpoint rule cuts the tail of the logarithm: 2e-3 of the variance at n = 400.
                         {"gaussian", GaussianFilter{Float(0.75)}, 0.5625, 4, 2e-3},
                         {"smallpt", SubpixelTentFilter{2, Float(0.5)}, 0.25 / 6 + 0.0625, 0.75, 5e-4}}) {
    const Axis a = axis(row.filter);
    EXPECT_NEAR(a.mean, 0, 1e-5) << row.name;
    EXPECT_NEAR(a.covariance, 0, 1e-5) << row.name;
    EXPECT_NEAR(a.variance / row.variance, 1, row.tolerance) << row.name;
    EXPECT_LE(a.reach, row.reach) << row.name;
  }
}

TEST(Filter, RefusesNonsense) {
  for (const Float bad : {Float(0), Float(-1), mc::infinity<Float>, std::numeric_limits<Float>::quiet_NaN()}) {
    EXPECT_THROW(BoxFilter{bad}, mc::Error);
    EXPECT_THROW(TentFilter{bad}, mc::Error);
    EXPECT_THROW(GaussianFilter{bad}, mc::Error);
    EXPECT_THROW(SubpixelTentFilter(2, bad), mc::Error);
  }
  EXPECT_THROW(SubpixelTentFilter(0), mc::Error);
}

TEST(Filter, FiniteAtTheEdgesOfTheUnitSquare) {
  for (const Filter& filter :
       {Filter(BoxFilter{}), Filter(TentFilter{}), Filter(GaussianFilter{}), Filter(SubpixelTentFilter{})})
    for (const Float a : {Float(0), Float(0.5), mc::one_minus_epsilon<Float>})
      for (const Float b : {Float(0), Float(0.5), mc::one_minus_epsilon<Float>})
        EXPECT_TRUE(filter.sample(Vec2(a, b)).allFinite()) << a << ", " << b;
}

struct SharedRow {
  const char* name;
  Filter filter;
  int reach;
  double noise_area; ///< In closed form.
};

// Noise area of smallpt's filter. Its profile is the mean of two tents of half width r = 1/2 at distance r. Their
// overlap is the cubic B-spline over r, 2/3 at 0 and 1/6 at r. So the integral of the squared profile is (2/3 + 1/6) /
// (2 r).
const std::array shared = {SharedRow{"box", BoxFilter(), 0, 1},
                           SharedRow{"wide box", BoxFilter(Float(1.5)), 1, 9},
                           SharedRow{"tent", TentFilter(), 1, 2.25},
                           SharedRow{"wide tent", TentFilter(Float(2.25)), 2, mc::sqr(1.5 * 2.25)},
                           SharedRow{"gaussian", GaussianFilter(), 2, mc::pi<double>},
                           SharedRow{"wide gaussian", GaussianFilter(1), 5, 4 * mc::pi<double>},
                           SharedRow{"smallpt", SubpixelTentFilter(), 1, 1.44}};

TEST(SplatFilter, ReachAndWeightsMatchFilter) {
  for (const SharedRow& row : shared) {
    const SplatFilter filter(row.filter);
    EXPECT_EQ(filter.reach(), row.reach) << row.name;
    EXPECT_NEAR(filter.noise_area() / row.noise_area, 1, 5e-4) << row.name;
    EXPECT_EQ(filter.is_wide(), row.noise_area > 1) << row.name;
  }
  EXPECT_FALSE(SplatFilter(BoxFilter(Float(0.2))).is_wide());
  EXPECT_THROW(SplatFilter(TentFilter(65)), mc::Error);
  EXPECT_THROW(SplatFilter(GaussianFilter(Float(1e6))), mc::Error);
}

// The product of the profiles is the density, and squared weights are the mean squared profiles, pixel by pixel.
TEST(SplatFilter, HasTheProfileOfItsFilter) {
  for (const SharedRow& row : shared) {
    const SplatFilter filter(row.filter);
    std::vector<double> x(filter.side()), y = x;
    const auto at = [&](int pixels) {
      const int place = pixels + filter.reach();
      return static_cast<std::size_t>(place);
    };
    double sum = 0;
    for (const double dx : {-0.5, -0.2, 0.0, 0.31})
      for (const double dy : {-0.45, 0.0, 0.49}) {
        filter.profile(dx, x);
        filter.profile(dy, y);
        for (int j = -filter.reach(); j <= filter.reach(); ++j)
          for (int i = -filter.reach(); i <= filter.reach(); ++i) {
            const double product = x[at(i)] * y[at(j)];
            const Vec2 p(Float(dx - i), Float(dy - j));
            EXPECT_NEAR(product, double(row.filter.pdf(p)), 1e-5) << row.name << " " << p.transpose();
          }
      }
    for (int j = -filter.reach(); j <= filter.reach(); ++j)
      for (int i = -filter.reach(); i <= filter.reach(); ++i) sum += filter.squared_weight(i, j);
    EXPECT_NEAR(sum * filter.noise_area(), 1, 1e-12) << row.name;
    EXPECT_NEAR(filter.squared_weight(filter.reach(), 0), filter.squared_weight(-filter.reach(), 0), 1e-4) << row.name;
  }
}

} // namespace

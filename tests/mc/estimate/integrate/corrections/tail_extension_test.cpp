#include <mc/estimate/integrate/corrections/tail_extension.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using mc::detail::tail_contribution;
constexpr double infinity = std::numeric_limits<double>::infinity();

mc::Tail tail(double shape, double largest) {
  mc::Tail t;
  t.fit.shape = shape;
  t.fit.largest_excess = largest;
  t.fit.values = 225; // a margin of .1
  return t;
}

// Beyond Y a Pareto tail has the mean excess Y xi / (1 - xi).
TEST(TailExtension, IsTheMeanExcessBeyondTheLargestValue) {
  EXPECT_NEAR(tail_contribution(tail(0.4, 300), 1000, infinity), 0.3, 1e-12);
  EXPECT_NEAR(tail_contribution(tail(0.4, 300), 1000, 0.1), 0.1, 1e-12); // the replicates differ by less
  EXPECT_EQ(tail_contribution(tail(-0.5, 300), 1000, infinity), 0);
  EXPECT_EQ(tail_contribution({}, 1000, infinity), 0);
}

TEST(TailExtension, ShapeIsCapped) { EXPECT_NEAR(tail_contribution(tail(3, 1), 1, infinity), 9, 1e-12); }

TEST(TailExtension, ContributionsArePooled) {
  const std::vector<double> points = {64, 128, 256, 512};
  std::vector<double> falling;
  for (const double n : points) falling.push_back(std::pow(n, -0.3));
  EXPECT_NEAR(mc::detail::pooled_contribution(points, falling, 0.7), falling.back(), 1e-12);
  const std::vector<double> halving = {8, 4, 2, 1}; // no value exceeded the largest
  EXPECT_GT(mc::detail::pooled_contribution(points, halving, 0.7), 1.9);
  EXPECT_EQ(mc::detail::pooled_contribution(points, std::vector<double>(4, 0.0), 0.7), 0);
}

} // namespace

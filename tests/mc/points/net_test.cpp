#include "point_lists.h"

#include <mc/points/net.h>
#include <mc/sampler/independent.h>
#include <mc/sampler/padded_sobol_4d.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#include <gtest/gtest.h>

namespace {

using mc::net_quality;

TEST(NetQuality, MatchesKnownNets) {
  const std::vector<double> net = test::hammersley(0), two = test::points_of(mc::Sobol(1), 1024, 2),
                            four = test::points_of(mc::PaddedSobol4D(1), 256, 4);
  EXPECT_EQ(net_quality({net, 2}), 0);
  EXPECT_EQ(net_quality({two, 2}), 0);
  ASSERT_TRUE(net_quality({four, 4}).has_value());
  EXPECT_LE(*net_quality({four, 4}), 3); // the documented quality of PaddedSobol4D
}

// Four points at the centres of the quarters: each half contains two, and each quarter of an axis two or none.
TEST(NetQuality, OfAGrid) {
  const std::vector<double> grid = {.25, .25, .25, .75, .75, .25, .75, .75};
  EXPECT_EQ(net_quality({grid, 2}), 1);
}

TEST(NetQuality, NotANet_ReturnsNothing) {
  const std::vector<double> jittered = test::points_of(mc::Stratified(256, 3, 2), 256, 2),
                            random = test::points_of(mc::Independent{3}, 64, 2), same(64, 0.5);
  EXPECT_GT(net_quality({jittered, 2}), 0);
  EXPECT_GT(net_quality({random, 2}), 1);
  EXPECT_EQ(net_quality({same, 2}), 5); // all points are equal
  EXPECT_FALSE(net_quality({test::scattered(48, 2), 2}).has_value());
  EXPECT_FALSE(net_quality({random, 2}, 10).has_value()) << "not enough work";
}

} // namespace

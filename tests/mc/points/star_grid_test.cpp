#include "point_lists.h"

#include <mc/points/star_grid.h>
#include <mc/sampler/independent.h>

#include <gtest/gtest.h>

namespace {

TEST(StarGrid, StoresRanksOfPoints) {
  const std::vector<double> x = {0.5, 0, 0.25, 0.75, 0.5, 0.75};
  const mc::StarGrid grid({x, 2});
  EXPECT_EQ(grid.axis(0), (std::vector<double>{0, 0.25, 0.5, 1}));
  EXPECT_EQ(grid.axis(1), (std::vector<double>{0, 0.75, 1}));
  for (std::size_t i = 0; i < grid.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(grid.axis(k)[grid.ranks(i)[k]], x[2 * i + k]);
  EXPECT_EQ(grid.order(0)[0], 1u);
  EXPECT_EQ(grid.order(1)[0], 0u);
}

// The ascent never exceeds the true value. For small sets, many starts nearly always find it.
TEST(StarAscent, IsALowerBoundAndOftenExact) {
  int found = 0;
  constexpr std::uint64_t sets = 60;
  for (std::uint64_t seed = 0; seed < sets; ++seed) {
    const auto dim = static_cast<std::uint32_t>(1 + seed % 3);
    const std::vector<double> x = test::points_of(mc::Independent{seed}, 20, dim);
    const double truth = test::star_by_all_boxes({x, dim}), ascent = mc::star_ascent(mc::StarGrid({x, dim}), 64);
    EXPECT_LE(ascent, truth + 1e-14);
    found += ascent >= truth - 1e-14;
  }
  EXPECT_GE(found, 54);
}

} // namespace

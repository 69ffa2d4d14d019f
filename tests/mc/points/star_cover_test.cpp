#include "point_lists.h"

#include <mc/points/star_cover.h>
#include <mc/sampler/sobol.h>

#include <gtest/gtest.h>

namespace {

constexpr std::uint64_t plenty = 1'000'000'000;

struct Case {
  std::vector<double> x = test::points_of(mc::Sobol(4), 30, 3);
  mc::StarGrid grid{{x, 3}};
  double truth = test::star_by_all_boxes({x, 3});
};

TEST(StarCover, BoundBelowTheDiscrepancy_FindsTheWorstBox) {
  const Case c;
  for (const double bound : {0.0, 0.5 * c.truth, 0.999 * c.truth}) {
    mc::StarCover cover{0, bound, plenty};
    EXPECT_TRUE(cover.run(c.grid));
    EXPECT_NEAR(cover.lower, c.truth, 1e-14);
  }
}

TEST(StarCover, BoundAboveTheDiscrepancy_TakesLessWork) {
  const Case c;
  mc::StarCover exact{c.truth, c.truth, plenty}, coarse{0, 3 * c.truth, plenty};
  EXPECT_TRUE(exact.run(c.grid));
  EXPECT_TRUE(coarse.run(c.grid));
  EXPECT_LE(coarse.lower, c.truth + 1e-14);
  EXPECT_GT(coarse.work, exact.work);
}

TEST(StarCover, TooLittleWork_ReturnsFalse) {
  const Case c;
  mc::StarCover cover{0, 0, 100};
  EXPECT_FALSE(cover.run(c.grid));
  EXPECT_LE(cover.lower, c.truth + 1e-14);
}

} // namespace

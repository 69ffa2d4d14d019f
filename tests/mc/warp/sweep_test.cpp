// Checks the bounds of every warp against 50 digits, at random parameters over their whole legal range. bench_sweep
// does the same with thousands of parameters.
#include "../../../bench/mc/warp/sweep/sweep.h"

#include <gtest/gtest.h>

namespace {

class Sweep : public testing::TestWithParam<std::vector<sweep::Row> (*)(const sweep::Effort&)> {};

TEST_P(Sweep, BoundsHoldOverTheWholeRange) {
  for (const sweep::Row& row : GetParam()({.trials = 60, .points = 12, .seed = 3})) {
    EXPECT_LT(row.refused, row.tried) << row.name;
    for (const sweep::Law* law : {&row.edges, &row.sample, &row.pdf, &row.invert, &row.monotone})
      EXPECT_EQ(law->broken, 0u) << row.name << ": " << law->worst_case;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Families, Sweep, testing::Values(sweep::intervals, sweep::planes, sweep::spheres, sweep::lobes, sweep::lights),
    [](const auto& family) {
      return fmt::format("{}", std::array{"Intervals", "Planes", "Spheres", "Lobes", "Lights"}[family.index]);
    });

} // namespace

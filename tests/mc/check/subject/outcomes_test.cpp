#include <mc/check/subject/outcomes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using mc::Outcomes;

TEST(Outcomes, FiniteRange_IsListed) {
  const Outcomes o(-3, 4);
  EXPECT_TRUE(o.any());
  EXPECT_FALSE(o.has_rest());
  EXPECT_EQ(o.count(), 8);
  EXPECT_EQ(o.index(-3), 0);
  EXPECT_EQ(o.index(4), 7);
  for (const double k : {-4.0, 5.0, 0.5, HUGE_VAL, double(NAN)}) EXPECT_EQ(o.index(k), -1) << k;
  EXPECT_FALSE(Outcomes().any());
  EXPECT_EQ(Outcomes().count(), 0);
}

TEST(Outcomes, InfiniteRange_HasARest) {
  Outcomes all(-HUGE_VAL, HUGE_VAL);
  all.list({7, -4, 2, NAN});
  EXPECT_EQ(all.count(), 13);
  EXPECT_EQ(all.index(-4), 0);
  EXPECT_EQ(all.index(7), 11);
  EXPECT_EQ(all.index(8), 12);
  EXPECT_EQ(all.index(-1e9), 12);
  EXPECT_EQ(all.index(0.5), -1);
  Outcomes natural(0, HUGE_VAL);
  natural.list({3, 9});
  EXPECT_EQ(natural.listed(), 10);
  EXPECT_EQ(natural.index(-1), -1) << "no outcome, and not the rest";
}

// At most 2^20 are listed, near a finite end or around the median.
TEST(Outcomes, WideRanges) {
  Outcomes below(-HUGE_VAL, 0), above(0, HUGE_VAL), both(-HUGE_VAL, HUGE_VAL), far(0, HUGE_VAL);
  below.list({-1e9, -5, 0});
  EXPECT_EQ(below.index(0), (1 << 20) - 1);
  above.list({0, 5, 1e9});
  EXPECT_EQ(above.index(0), 0);
  EXPECT_EQ(above.listed(), 1 << 20);
  both.list({-1e9, 5, 1e9});
  EXPECT_EQ(both.index(5), 1 << 19);
  far.list({1e9, 1e9 + 4, 1e9 + 7});
  EXPECT_EQ(far.index(1e9), 0);
  EXPECT_EQ(far.listed(), 8);
  for (const Outcomes& o : {below, above, both, far}) EXPECT_LE(o.count(), (1 << 20) + 1);
}

TEST(Outcomes, Rest_IsTheRestOfOne) {
  Outcomes o(0, HUGE_VAL);
  o.list({0, 1});
  std::vector<double> p{0.5, 0.25}, much{0.75, 0.5};
  o.add_rest(p);
  o.add_rest(much);
  EXPECT_EQ(p, (std::vector<double>{0.5, 0.25, 0.25}));
  EXPECT_EQ(much.back(), 0);
}

} // namespace

#include <mc/estimate/integrate/corrections/tuning.h>

#include <gtest/gtest.h>

namespace {

TEST(Tuning, FitsTheValuesThatAreKept) {
  const mc::detail::Tuning t;
  EXPECT_LT(t.tail.most, mc::Extremes::capacity); // the threshold is one more
  EXPECT_LT(t.tail.least, t.tail.most);
  EXPECT_LE(t.pooled_lengths, t.rate_lengths);
}

} // namespace

#include <mc/estimate/diagnostics/sampled_values.h>

#include <gtest/gtest.h>

namespace {

TEST(SampledValues, MergeAddsBothKinds) {
  mc::SampledValues a, b;
  const double one[] = {1, 2}, two[] = {3};
  a.averaged.add(one);
  b.averaged.add(two);
  b.integrand.add(one);
  a.merge(b);
  EXPECT_EQ(a.averaged.count(), 3u);
  EXPECT_EQ(a.integrand.count(), 2u);
  EXPECT_EQ(a.for_more_values().averaged.count(), 0u);
}

} // namespace

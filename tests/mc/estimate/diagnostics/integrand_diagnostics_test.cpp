#include <mc/estimate/diagnostics/integrand_diagnostics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using mc::detail::IntegrandDiagnostics;

TEST(IntegrandDiagnostics, MergeEqualsAddingAllValues) {
  const std::vector<double> low{-1, 0, 2}, high{5, 3}, all{-1, 0, 2, 5, 3};
  IntegrandDiagnostics merged, other, whole;
  merged.values.add(low);
  merged.add_to_range(low);
  other.values.add(high);
  other.add_to_range(high);
  other.infinite_count = 2;
  other.infinite_volume = 0.5;
  merged.merge(other);
  whole.values.add(all);
  EXPECT_EQ(merged.values.count(), whole.values.count());
  EXPECT_EQ(merged.values.hi(), whole.values.hi());
  EXPECT_EQ(merged.lo, -1);
  EXPECT_EQ(merged.hi, 5);
  EXPECT_EQ(merged.infinite_count, 2u);
  EXPECT_EQ(merged.infinite_volume, 0.5);
}

TEST(IntegrandDiagnostics, EqualValuesAreConstant) {
  IntegrandDiagnostics d;
  d.values.add(std::vector{3.0, 3.0});
  EXPECT_TRUE(d.constant());
  d.values.add(std::vector{4.0});
  EXPECT_FALSE(d.constant());
}

TEST(IntegrandDiagnostics, AnInfiniteValueMakesTheVarianceInfinite) {
  IntegrandDiagnostics d;
  d.values.add(std::vector{1.0, 2.0});
  EXPECT_FALSE(d.infinite_variance());
  d.infinite_count = 1;
  EXPECT_TRUE(d.infinite_variance());
}

TEST(IntegrandDiagnostics, DecisiveTailIndexIsThatOfTheTailWithInfiniteVariance) {
  std::vector<double> values;
  for (int i = 1; i <= 20'000; ++i) values.push_back(std::pow(i / 20'001.0, -1.0));
  IntegrandDiagnostics d;
  d.values.add(values);
  EXPECT_TRUE(d.infinite_variance());
  EXPECT_NEAR(d.decisive_tail_index(), 1, 0.5);
}

} // namespace

#include <mc/estimate/diagnostics/extremes.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

std::vector<double> values_of(std::size_t n) {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < n; ++i) values.push_back(std::tan(3 * mc::hash_uniform<double>(1, i)));
  return values;
}

TEST(Extremes, KeepsTheLargestAndSmallestInOrder) {
  std::vector<double> values = values_of(5000);
  mc::Extremes e;
  e.add(values);
  std::sort(values.begin(), values.end());
  const std::vector<double> smallest = e.smallest(100), largest = e.largest(1000);
  EXPECT_EQ(smallest, std::vector<double>(values.begin(), values.begin() + 100));
  ASSERT_EQ(largest.size(), mc::Extremes::capacity);
  EXPECT_TRUE(std::equal(largest.begin(), largest.end(), values.rbegin()));
  EXPECT_EQ(e.lo(), values.front());
  EXPECT_EQ(e.hi(), values.back());
  EXPECT_EQ(e.count(), 5000u);
}

// Parts that know what earlier parts have kept give the same result as one object.
TEST(Extremes, MergedPartsEqualTheWhole) {
  const std::vector<double> values = values_of(20'000);
  mc::Extremes whole, parts;
  whole.add(values);
  for (std::size_t i = 0; i < values.size(); i += 700) {
    mc::Extremes part = parts.for_more_values();
    part.add(std::span(values).subspan(i, std::min<std::size_t>(700, values.size() - i)));
    parts.merge(part);
  }
  EXPECT_EQ(parts.count(), whole.count());
  EXPECT_EQ(parts.hi(), whole.hi());
  EXPECT_EQ(parts.lo(), whole.lo());
  EXPECT_EQ(parts.largest(256), whole.largest(256));
  EXPECT_EQ(parts.smallest(256), whole.smallest(256));
  EXPECT_NEAR(parts.mean_size(), whole.mean_size(), 1e-9 * whole.mean_size());
}

TEST(Extremes, CountsZerosAndSkipsWhatIsNotFinite) {
  mc::Extremes e;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double values[] = {0, -1, infinity, 2, std::nan(""), 0, -infinity};
  e.add(values);
  EXPECT_EQ(e.count(), 4u);
  EXPECT_EQ(e.zeros(), 2u);
  EXPECT_EQ(e.mean_size(), 0.75);
  EXPECT_EQ(mc::Extremes().mean_size(), 0);
  EXPECT_EQ(e.hi(), 2);
  EXPECT_EQ(e.lo(), -1);
  EXPECT_EQ(mc::Extremes().hi(), 0);
  EXPECT_TRUE(mc::Extremes().largest(3).empty());
}

TEST(Extremes, SumsOfHugeValuesDoNotOverflow) {
  mc::Extremes e;
  const std::vector<double> huge(10, 1e308);
  e.add(huge);
  EXPECT_EQ(e.count(), 10u);
  EXPECT_NEAR(e.mean_size(), 1e308, 1e294);
}

} // namespace

#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace {

std::vector<double> uniforms(std::size_t n, double offset) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = offset + mc::hash_uniform<double>(7, i);
  return x;
}

TEST(Moments, OneToFive) {
  mc::Moments m;
  for (const double x : {1.0, 2.0, 3.0, 4.0, 5.0}) m.add(x);
  EXPECT_DOUBLE_EQ(m.mean(), 3);
  EXPECT_DOUBLE_EQ(m.variance(), 2.5);
  EXPECT_DOUBLE_EQ(m.std_error(), std::sqrt(0.5));
  EXPECT_EQ(m.estimate().dof, 4);
}

// Sums of squares would lose the variance 1/12 next to 1e18.
TEST(Moments, SurviveCancellation) {
  const std::vector<double> small = uniforms(4096, 0), large = uniforms(4096, 1e9);
  mc::Moments one_by_one, whole;
  for (const double x : large) one_by_one.add(x);
  whole.add(large, 0);
  mc::Moments truth;
  truth.add(small, 0);
  // The offset itself rounds each value by at most 2^-24.
  EXPECT_LE(std::abs(one_by_one.variance() / truth.variance() - 1), 1e-6);
  EXPECT_LE(std::abs(whole.variance() / truth.variance() - 1), 1e-6);
  EXPECT_LE(std::abs(whole.mean() - 1e9 - truth.mean()), 3e-7);
}

TEST(Moments, MergeIsTheSameAsAdding) {
  const std::vector<double> x = uniforms(1000, 3);
  mc::Moments all, merged, blocks;
  for (const double v : x) all.add(v);
  for (std::size_t begin = 0; begin < x.size(); begin += 170) {
    const auto part = std::span(x).subspan(begin, std::min<std::size_t>(170, x.size() - begin));
    mc::Moments m;
    for (const double v : part) m.add(v);
    merged.merge(m);
    blocks.add(part, begin);
  }
  merged.merge({});
  for (const mc::Moments& m : {merged, blocks}) {
    EXPECT_EQ(m.count(), all.count());
    EXPECT_LE(std::abs(m.mean() - all.mean()), 1e-14 * all.mean());
    EXPECT_LE(std::abs(m.variance() - all.variance()), 1e-12 * all.variance());
  }
}

TEST(Moments, NonFiniteValuesAreCountedAndNamed) {
  std::vector<double> x = uniforms(100, 0);
  x[37] = std::numeric_limits<double>::quiet_NaN();
  x[61] = std::numeric_limits<double>::infinity();
  mc::Moments m;
  m.add(x, 1000);
  EXPECT_EQ(m.non_finite_count(), 2u);
  EXPECT_EQ(m.first_non_finite(), 1037u);
  EXPECT_EQ(m.count(), 98u);
  EXPECT_THROW(m.estimate(), mc::Error);
  mc::Moments clean;
  clean.add(1);
  clean.merge(m);
  EXPECT_EQ(clean.first_non_finite(), 1037u);
}

TEST(Moments, HugeValuesDoNotOverflowTheBlockSum) {
  const std::vector<double> x(16, 1e308);
  mc::Moments m;
  m.add(x, 0);
  EXPECT_EQ(m.non_finite_count(), 0u);
  EXPECT_DOUBLE_EQ(m.mean(), 1e308);
}

TEST(Moments, OneValueHasNoError) {
  mc::Moments m;
  m.add(1);
  EXPECT_THROW(m.estimate(), mc::Error);
}

TEST(Moments, MergeIntoEmpty_LargeNumbers_DoesNotOverflow) {
  const std::vector<double> large(3, 1e160);
  mc::Moments block, merged, one_by_one;
  block.add(large, 0);
  for (const double x : large) one_by_one.add(x);
  merged.merge(one_by_one);
  for (const mc::Moments* m : {&block, &merged}) {
    EXPECT_EQ(m->mean(), 1e160);
    EXPECT_EQ(m->variance(), 0);
  }
}

} // namespace

#include <mc/sampler/independent.h>

#include "nets.h"

#include <gtest/gtest.h>

namespace {

TEST(Independent, UniformOverSeedsAndIndices) {
  EXPECT_LE(test::seed_moments([](std::uint64_t s) { return mc::Independent{s}; }, 0xffffffff, 12), 5);
  const auto f = [](double x, double y) { return x * y; };
  // The sd of x y is sqrt(7/144). The RMS of 200 errors lies within 20 % of it, at 4 sd.
  const double rms = test::rms_error([](std::uint64_t s) { return mc::Independent{s}; }, 1024, 200, 0, 0.25, f);
  EXPECT_NEAR(rms * std::sqrt(1024.0) / std::sqrt(7.0 / 144), 1, 0.2);
}

TEST(SampleStream, AdvancesThroughTheDimensions) {
  mc::SampleStream<double, mc::Independent> stream({5}, 9, 2);
  EXPECT_EQ(stream.next(), (mc::coordinate<double>(mc::Independent{5}, 9, 2)));
  EXPECT_EQ((stream.next<3>()), (mc::point<double, 3>(mc::Independent{5}, 9, 3)));
  EXPECT_EQ(stream.dim(), 6u);
  stream.skip_to(100);
  EXPECT_EQ(stream.next(), (mc::coordinate<double>(mc::Independent{5}, 9, 100)));
}

} // namespace

#include <mc/check/laws/bsdf/bsdf_law.h>

#include <gtest/gtest.h>

namespace {

mc::Channels grey(double f) {
  mc::Channels c;
  c.count = 1;
  c.value[0] = f;
  return c;
}

TEST(BsdfLaw, Throughput_IsWeightOrFCosOverPdf) {
  mc::AnyBsdf::Sample s;
  s.wi = {0, 0, 0.5};
  s.pdf = 2;
  s.f = grey(4);
  EXPECT_EQ(throughput(s, {})[0], 1);
  EXPECT_EQ(throughput(s, {.cosine = false})[0], 2);
  s.f = {5, {4, 4, 4, 4, 8}};
  EXPECT_EQ(throughput(s, {})[3], 1);
  EXPECT_EQ(throughput(s, {})[4], 2) << "of the fifth channel too";
  s.weight = grey(3);
  EXPECT_EQ(throughput(s, {})[2], 3) << "a stated weight counts";
  s.weight.count = 0;
  s.pdf = 0;
  EXPECT_EQ(throughput(s, {})[0], 0);
}

TEST(BsdfLaw, RelativeDifference_OverChannels_IsLargest) {
  EXPECT_EQ(mc::relative_difference(0, 0), 0);
  EXPECT_EQ(mc::relative_difference(3, 2), 0.5);
  EXPECT_EQ(mc::relative_difference(1, 0), HUGE_VAL);
  EXPECT_EQ(mc::relative_difference(grey(3), grey(2)), 0.5);
  EXPECT_EQ(mc::relative_difference(grey(2), mc::Channels{2, {2, 1}}), 1) << "grey against a colour";
}

TEST(BsdfLaw, SquaredIndex_BelowSurface_IsEtaSquared) {
  EXPECT_EQ(mc::squared_index({0, 0, 1}, {.eta = 1.5}), 1);
  EXPECT_EQ(mc::squared_index({0, 0, -1}, {.eta = 1.5}), 2.25);
}

} // namespace

// A user's own test suite against the installed package.

#include <mc/random/pcg.h>
#include <mc/warp/hemisphere.h>

#include <gtest/gtest.h>

TEST(Consumer, SamplesACosineHemisphere) {
  mc::Pcg random(1);
  const mc::CosineHemisphere<float> warp;
  double cosine = 0;
  for (int i = 0; i < 10000; ++i) cosine += warp.sample(random.point<float, 2>()).z();
  EXPECT_NEAR(cosine / 10000, 2.0 / 3, 0.01); // 4 standard errors: variance 1/2 - 4/9
}

#include <render/film/accumulate.h>

#include <mc/random/pcg.h>

#include "support/files.h"

namespace {

using namespace render;

// Means of normal-like samples with their variances. The average has the accuracy of all samples together, and its
// variance is as stated. The bound is 5 standard deviations of 4000 chi-squares.
TEST(Accumulate, CountsBySamples) {
  mc::Pcg random(1);
  const int pixels = 4000, n = 4, m = 12;
  Image a(pixels, 1), b(pixels, 1);
  for (auto* image : {&a, &b}) {
    const int samples = image == &a ? n : m;
    image->estimates = 4;
    for (auto& p : image->pixels) {
      double sum = 0;
      for (int i = 0; i < samples; ++i) sum += random.uniform<double>();
      p.setConstant(Float(sum / samples));
      image->variance.push_back(Spectrum::Constant(Float(1 / (12.0 * samples))));
    }
  }
  const Image both = accumulate(a, n, b, m);
  double squares = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    EXPECT_NEAR(both.pixels[i][0], (n * a.pixels[i][0] + m * b.pixels[i][0]) / (n + m), 1e-6);
    EXPECT_NEAR(both.variance[i][1], 1 / (12.0 * (n + m)), 1e-7);
    squares += mc::sqr(double(both.pixels[i][2]) - 0.5) / double(both.variance[i][2]);
  }
  EXPECT_NEAR(squares / pixels, 1, 5 * std::sqrt(2.0 / pixels));
  EXPECT_EQ(both.estimates, 8u);
}

TEST(Accumulate, MissingVariance_GivesNoVariance) {
  Image a(2, 1), b(2, 1);
  a.variance.assign(2, Spectrum::Ones());
  a.metadata["carlo.seed"] = "1";
  b.metadata["carlo.seed"] = "2";
  const Image both = accumulate(a, 1, b, 1);
  EXPECT_TRUE(both.variance.empty());
  EXPECT_EQ(both.metadata.at("carlo.seed"), "2");
}

TEST(Accumulate, RefusesNonsense) {
  EXPECT_THAT(support::error_of([] { accumulate(Image(2, 1), 1, Image(1, 2), 1); }),
              testing::HasSubstr("a picture of 2x1 cannot go on as one of 1x2"));
  for (const double bad : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(accumulate(Image(1, 1), bad, Image(1, 1), 1), mc::Error);
}

} // namespace

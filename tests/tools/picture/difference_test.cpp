#include <picture/difference.h>

#include <mc/core/error.h>
#include <mc/random/hash.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

namespace {

using carlo::test_difference;

// Pixels of mean `value` with uniform noise, whose variance is stated.
render::Image noisy(double value, std::uint64_t seed) {
  render::Image image(40, 24);
  image.estimates = 2;
  const double width = 0.1;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      image.pixels[i][c] = render::Float(value + width * (mc::hash_uniform<double>(seed, i, std::uint64_t(c)) - 0.5));
  image.variance.assign(image.pixels.size(), render::Spectrum::Constant(render::Float(width * width / 12)));
  return image;
}

TEST(Difference, EqualMeansAgree_ShiftedOnesDiffer) {
  int rejected = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    rejected += test_difference(noisy(1, 2 * seed), noisy(1, 2 * seed + 1), 0).family_p() < 0.05;
  EXPECT_LE(rejected, 8);
  const auto shifted = test_difference(noisy(1, 1), noisy(1.02, 2), 0);
  EXPECT_LT(shifted.block.p, 1e-6);
  EXPECT_LT(shifted.family_p(), 1e-4);
  EXPECT_GT(test_difference(noisy(1, 1), noisy(1.02, 2), 0.05).family_p(), 0.01);
}

TEST(Difference, FamilyOfBothKindsOfTests) {
  const auto tests = test_difference(noisy(1, 1), noisy(1, 2), 0);
  EXPECT_EQ(tests.tests, 3 * (40 * 24 + 3 * 2));
  EXPECT_GE(tests.family_p(), std::min(tests.pixel.p, tests.block.p));
  EXPECT_LE(tests.family_p(), 1);
}

TEST(Difference, MetricsOfKnownPictures) {
  render::Image a(2, 1), b(2, 1);
  a.pixels = {render::Spectrum(1, 2, 3), render::Spectrum(0, 0, 0)};
  b.pixels = {render::Spectrum(1, 1, 1), render::Spectrum(0, 0, 0)};
  const std::vector<carlo::Metric> m = carlo::difference_metrics(a, b);
  ASSERT_EQ(m.size(), 6u);
  EXPECT_DOUBLE_EQ(m[0].value, 5.0 / 6);
  EXPECT_DOUBLE_EQ(m[2].value, 0.5);
  EXPECT_DOUBLE_EQ(m[4].value, 2);
  EXPECT_DOUBLE_EQ(m[5].value, 2);
}

TEST(Difference, PicturesThatCannotBeCompared_AreRefused) {
  render::Image a = noisy(1, 1), b = noisy(1, 2), narrow(2, 2);
  EXPECT_NO_THROW(carlo::require_comparable("a", a, "b", b));
  EXPECT_THROW(carlo::require_comparable("a", a, "b", narrow), mc::Error);
  b.pixels[7][1] = std::numeric_limits<render::Float>::quiet_NaN();
  EXPECT_THROW(carlo::require_comparable("a", a, "b", b), mc::Error);
  EXPECT_NO_THROW(carlo::require_variance("a", a));
  a.variance[3][0] = -1;
  EXPECT_THROW(carlo::require_variance("a", a), mc::Error);
}

} // namespace

#include <render/film/sample_statistics.h>

#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace {

using namespace render;

Eigen::Array3d grey(double x) { return Eigen::Array3d::Constant(x); }

// Statistics of samples that arrive in groups of this size.
SampleStatistics statistics_of(const std::vector<Eigen::Array3d>& samples, std::size_t group) {
  SampleStatistics all;
  for (std::size_t i = 0; i < samples.size();) {
    SampleSums sums;
    for (std::size_t k = 0; k < group && i < samples.size(); ++k) sums.add(samples[i++]);
    all.add(sums);
  }
  return all;
}

// Samples of any scale and relative spread, in groups of any size, against moments in double precision.
TEST(SampleStatistics, AgreeWithMoments) {
  mc::Pcg random(4);
  for (const double scale : {1e-30, 1.0, 1e30})
    for (const double spread : {1e-3, 0.5, 10.0})
      for (const std::size_t group : {1, 3, 64, 1000}) {
        std::vector<Eigen::Array3d> samples;
        std::array<mc::Moments, 3> moments;
        mc::Moments luminances;
        double largest = 0;
        for (int i = 0; i < 1000; ++i) {
          Eigen::Array3d sample;
          for (int channel = 0; channel < 3; ++channel) {
            sample[channel] = double(static_cast<float>(scale * std::exp(spread * random.uniform<double>())));
            moments[std::size_t(channel)].add(sample[channel]);
          }
          samples.push_back(sample);
          luminances.add(luminance(sample));
          largest = std::max(largest, luminance(sample));
        }
        const SampleStatistics all = statistics_of(samples, group);
        EXPECT_EQ(all.count, 1000u);
        const double of_luminance = 0x1p-24 * luminances.mean() / std::sqrt(luminances.variance());
        EXPECT_NEAR(mc::sqr(double(all.deviation)) / (luminances.variance() * 0.999), 1, 1e-5 + 6 * of_luminance);
        EXPECT_FLOAT_EQ(all.largest, static_cast<float>(largest));
        for (int channel = 0; channel < 3; ++channel) {
          const mc::Moments& exact = moments[std::size_t(channel)];
          EXPECT_NEAR(double(all.channel_means[channel]) / exact.mean(), 1, 3e-6);
          // The mean rounds to 24 bits with each group.
          const double rounding = 0x1p-24 * exact.mean() / std::sqrt(exact.variance());
          EXPECT_NEAR(all.variance_of_mean()[channel] / (exact.variance() / 1000), 1, 1e-5 + 4 * rounding) << spread;
        }
      }
}

// Equal samples have no spread, in spite of the rounding of their sums.
TEST(SampleStatistics, EqualSamples_HaveNoSpread) {
  for (const double value : {0.0, 0.1, 1 / 3.0, 1e-30, 1e30})
    for (const std::size_t group : {1, 7, 1000}) {
      const auto equal =
          statistics_of(std::vector<Eigen::Array3d>(1000, grey(double(static_cast<float>(value)))), group);
      EXPECT_TRUE((equal.jump() == 0).all()) << value;
      EXPECT_LE(equal.variance_of_mean().maxCoeff(), 1e-18 * mc::sqr(value)) << value;
      EXPECT_EQ(equal.effective_sample_count(), mc::infinity<double>) << value;
    }
}

// Two values, a slope, a rare sample among others, and equal samples.
TEST(SampleStatistics, JumpIsZeroOnSlopes) {
  mc::Pcg random(8);
  for (std::size_t n = 2; n < 200; ++n) {
    std::vector<Eigen::Array3d> two, slope, rare;
    for (std::size_t i = 0; i < n; ++i) {
      const double u = random.uniform<double>(), even = (double(i) + 0.5) / double(n);
      two.push_back(i % 7 == 1 ? Eigen::Array3d(3, 0.5, 1e-20) : Eigen::Array3d(1, 0.25, 0));
      slope.emplace_back(even, 1 - 2e-9 * even, 1e20 * mc::sqr(even));
      rare.push_back(i == n / 2 ? Eigen::Array3d(-1, 2, 50) : Eigen::Array3d(0.3, 0.6, 1) * u);
    }
    for (const std::size_t group : {std::size_t(5), n}) {
      const Eigen::Array3d edge = statistics_of(two, group).jump() / Eigen::Array3d(2, 0.25, 1e-20);
      EXPECT_LE((edge - 1).abs().maxCoeff(), 1e-6) << n;
      if (n < 20) continue; // a few values are not spread evenly
      const SampleStatistics far = statistics_of(rare, group), on_slope = statistics_of(slope, group);
      const Eigen::Array3d range = (far.channel_largest - far.channel_smallest).cast<double>();
      EXPECT_LE((far.jump() / range - 1).abs().maxCoeff(), 1e-6) << n;
      EXPECT_NEAR(on_slope.jump()[0], std::sqrt(double(n) - 1) / double(n), 1e-4);
      EXPECT_EQ(on_slope.jump()[1], 0); // equal up to rounding
      EXPECT_LE(on_slope.jump()[2], 0.37e20);
    }
  }
}

// A jump of a hundredth, of one sample among 2e7: the mean rounds to the value of the others.
TEST(SampleStatistics, RareSampleBelowTheRoundingOfTheMean_IsAJump) {
  SampleStatistics all;
  SampleSums many;
  many.count = 20'000'000;
  many.sum = many.channel_sums[0] = 2e9;
  many.squares = 2e11;
  many.largest = 100;
  many.channel_sums.setConstant(2e9);
  many.channel_squares.setConstant(2e11);
  many.channel_largest.setConstant(100);
  many.channel_smallest.setConstant(100);
  all.add(many);
  EXPECT_TRUE((all.jump() == 0).all());
  SampleSums one;
  one.add(grey(101));
  all.add(one);
  EXPECT_TRUE(all.jump().isApprox(grey(1), 1e-5)) << all.jump();
  EXPECT_NEAR(all.effective_sample_count(), 1, 1e-3);
}

// One of two equal light path contributions does not dominate a pixel, whatever the rounding of their luminance.
TEST(LightSums, EqualContributions_ShareThePixel) {
  mc::Pcg random(2);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Array3d value(random.uniform<double>(), random.uniform<double>(), random.uniform<double>());
    LightSums light;
    light.add(value);
    EXPECT_LT(light.squares, 2 * mc::sqr(double(light.largest)));
    light.add(value);
    EXPECT_GE(light.squares, 2 * mc::sqr(double(light.largest)));
  }
}

} // namespace

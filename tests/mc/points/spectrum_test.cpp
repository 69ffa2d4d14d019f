#include "point_lists.h"

#include <mc/core/error.h>
#include <mc/points/spectrum.h>
#include <mc/random/hash.h>
#include <mc/sampler/independent.h>
#include <mc/sampler/stratified.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

TEST(Spectrum, OfOnePointIsOne) {
  const std::vector<double> x = {0.3, 0.7};
  for (const double power : mc::radial_power_spectrum({x, 2}, 20)) EXPECT_NEAR(power, 1, 1e-12);
}

// The power of a 4x4 grid is 16 where both frequencies are multiples of 4, and 0 elsewhere. Ring 4 contains the 32
// frequencies with round(|f|) = 4, among them (+-4, 0) and (0, +-4).
TEST(Spectrum, OfAGridIsItsDual) {
  std::vector<double> x;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) x.insert(x.end(), {j / 4.0, i / 4.0});
  const std::vector<double> power = mc::radial_power_spectrum({x, 2}, 5);
  int in_ring = 0;
  for (int a = -5; a <= 5; ++a)
    for (int b = -5; b <= 5; ++b) in_ring += std::lround(std::hypot(a, b)) == 4;
  EXPECT_NEAR(power[3], 4 * 16.0 / in_ring, 1e-12);
  for (const std::size_t k : {0u, 1u, 2u, 4u}) EXPECT_NEAR(power[k], 0, 1e-12);
}

// Means of 300 sets. A ring of c frequencies, c / 2 of them independent, has a relative standard error of about sqrt(2
// / (300 c)). The bound is five of these.
TEST(Spectrum, ExpectationsOfRandomAndJitteredPoints) {
  constexpr int rings = 12, sets = 300;
  std::vector<double> random(rings, 0.0), jittered(rings, 0.0);
  for (std::uint64_t seed = 0; seed < sets; ++seed) {
    const std::vector<double> x = test::points_of(mc::Independent{mc::hash(1, seed)}, 64, 2),
                              y = test::points_of(mc::Stratified(64, mc::hash(2, seed), 2), 64, 2);
    const auto a = mc::radial_power_spectrum({x, 2}, rings), b = mc::radial_power_spectrum({y, 2}, rings);
    for (std::size_t k = 0; k < rings; ++k) {
      random[k] += a[k] / sets;
      jittered[k] += b[k] / sets;
    }
  }
  const std::vector<double> expected = mc::jittered_radial_spectrum(8, rings);
  for (std::size_t k = 0; k < rings; ++k) {
    const double relative = 5 * std::sqrt(2 / (sets * 6.0 * static_cast<double>(k + 1)));
    EXPECT_NEAR(random[k], 1, relative);
    EXPECT_NEAR(jittered[k], expected[k], relative * expected[k]) << k + 1;
  }
}

// For jittered points in three dimensions, the cell width determines the spectrum of the first two axes.
TEST(Spectrum, OfJitteredPointsInSpace) {
  constexpr int rings = 8, sets = 300;
  std::vector<double> mean(rings, 0.0);
  for (std::uint64_t seed = 0; seed < sets; ++seed) {
    const auto power =
        mc::radial_power_spectrum({test::points_of(mc::Stratified(64, mc::hash(3, seed), 3), 64, 3), 3}, rings);
    for (std::size_t k = 0; k < rings; ++k) mean[k] += power[k] / sets;
  }
  const std::vector<double> expected = mc::jittered_radial_spectrum(4, rings);
  for (std::size_t k = 0; k < rings; ++k)
    EXPECT_NEAR(mean[k], expected[k], 5 * std::sqrt(2 / (sets * 6.0 * static_cast<double>(k + 1))) * expected[k]) << k;
}

TEST(Spectrum, RejectsOneDimension) {
  const std::vector<double> x = {0.3, 0.7};
  EXPECT_THROW(mc::radial_power_spectrum({x, 1}, 4), mc::Error);
  EXPECT_THROW(mc::radial_power_spectrum({x, 2}, 0), mc::Error);
}

} // namespace

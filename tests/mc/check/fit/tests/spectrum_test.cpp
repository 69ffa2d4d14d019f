#include <mc/check/fit/tests/spectrum.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <numbers>

namespace {

using mc::Pcg;
constexpr double pi = std::numbers::pi;

TEST(FourierTransform, EqualsDirectSum) {
  Pcg random(1);
  std::vector<std::complex<float>> x(81 * 3), before;
  for (auto& c : x)
    c = {static_cast<float>(random.uniform<double>() - 0.5), static_cast<float>(random.uniform<double>())};
  before = x;
  mc::fourier_transform(&x[1], 81, 3);
  for (std::size_t k = 0; k < 81; ++k) {
    std::complex<double> sum = 0;
    for (std::size_t j = 0; j < 81; ++j)
      sum += std::complex<double>(before[3 * j + 1]) * std::polar(1.0, -2 * pi * static_cast<double>(j * k) / 81);
    EXPECT_NEAR(std::abs(std::complex<double>(x[3 * k + 1]) - sum), 0, 1e-5) << k;
  }
  for (std::size_t j = 0; j < 81; ++j) EXPECT_EQ(x[3 * j], before[3 * j]);
}

TEST(FourierTransform, RealRows_EqualComplexTransform) {
  Pcg random(2);
  for (const std::size_t rows : {1u, 2u, 5u}) {
    std::vector<float> x(27 * rows);
    for (float& v : x) v = random.uniform<float>() - 0.5f;
    std::vector<std::complex<float>> full(x.begin(), x.end());
    mc::fourier_transform(full.data(), 27, 1, rows, 27);
    const std::vector<std::complex<float>> half = mc::fourier_transform(x, 27);
    ASSERT_EQ(half.size(), 14 * rows);
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t k = 0; k < 14; ++k) EXPECT_NEAR(std::abs(half[14 * r + k] - full[27 * r + k]), 0, 1e-5);
  }
}

// Tests samples of the unit square, given by `point` from random numbers, against a uniform expectation.
template <class F> bool fails(std::uint64_t seed, int n, double alpha, F point) {
  Pcg random(seed);
  mc::SpectrumTest grid(2, n, 0);
  grid.expect_uniform();
  mc::WeightedCounts all;
  for (int i = 0; i < n; ++i) {
    grid.add_sample(point(random), 1);
    all.add_sample(1, 0);
  }
  bool failed = false;
  for (const mc::Check& c : grid.test(all, 1, alpha, "the square")) failed = failed || c.verdict == mc::Verdict::fail;
  return failed;
}

// 200 runs at 10 %: at most 36 with probability 0.9997. The expectation is exact, or estimated from random points.
TEST(SpectrumTest, CorrectSamples_RejectedAtMostAtAlpha) {
  int known = 0, estimated = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    known += fails(seed, 4000, 0.1, [](Pcg& r) {
      return mc::Subject::Coordinates{r.uniform<double>(), r.uniform<double>(), 0};
    });
    // An uneven density, with fewer random points than samples.
    Pcg random(seed, 5);
    mc::SpectrumTest grid(2, 4000, 0);
    const auto point = [&] {
      return mc::Subject::Coordinates{mc::sqr(random.uniform<double>()), random.uniform<double>(), 0};
    };
    mc::WeightedCounts all;
    for (int i = 0; i < 4000; ++i) {
      grid.add_sample(point(), 1);
      all.add_sample(1, 0);
    }
    for (int i = 0; i < 1300; ++i) {
      grid.add_expected(point(), 1);
      all.add_expected(1);
    }
    bool failed = false;
    for (const mc::Check& c : grid.test(all, 1, 0.1, "")) failed = failed || c.verdict == mc::Verdict::fail;
    estimated += failed;
  }
  EXPECT_LE(known, 36);
  EXPECT_GE(known, 4);
  EXPECT_LE(estimated, 36);
}

TEST(SpectrumTest, WavesAndLatticesOfAnyDirection_Fail) {
  const auto uniform = [](Pcg& r) { return r.uniform<double>(); };
  const double a = 0.1;
  EXPECT_TRUE(fails(1, 200'000, 1e-3, [&](Pcg& r) {
    for (;;) {
      const double x = uniform(r), y = uniform(r);
      if (uniform(r) * (1 + a) < 1 + a * std::cos(2 * pi * (37.3 * x - 81.7 * y)))
        return mc::Subject::Coordinates{x, y, 0};
    }
  })) << "a slanted wave";
  EXPECT_TRUE(fails(2, 50'000, 1e-3, [&](Pcg& r) {
    const double u = uniform(r);
    return mc::Subject::Coordinates{(std::floor(128 * uniform(r)) + u) / 128, (std::floor(128 * uniform(r)) + u) / 128,
                                    0};
  })) << "one offset for both axes";
  EXPECT_TRUE(fails(3, 50'000, 1e-3, [&](Pcg& r) {
    const double y = uniform(r), x = std::floor(256 * uniform(r)) / 256 + y;
    return mc::Subject::Coordinates{x - std::floor(x), y, 0};
  })) << "eight bits, sheared";
  // Bins of a width of 1/1024 contain one lattice point each, and see nothing.
  EXPECT_TRUE(fails(5, 400'000, 1e-3, [&](Pcg& r) {
    const double y = uniform(r);
    return mc::Subject::Coordinates{(std::floor(1024 * uniform(r)) + y) / 1024, y, 0};
  })) << "ten bits, sheared by a step";
  EXPECT_TRUE(fails(4, 400'000, 1e-3, [&](Pcg& r) {
    for (;;) {
      const double x = uniform(r), y = uniform(r);
      const auto cell = static_cast<std::uint64_t>(x * 61 + 0.4) * 64 + static_cast<std::uint64_t>(y * 61 + 0.7);
      if (uniform(r) * 1.1 < 1 + (mc::mix64(cell) & 1 ? 0.1 : -0.1)) return mc::Subject::Coordinates{x, y, 0};
    }
  })) << "random signs on 61 x 61";
}

// 2^25 samples in one bin and 2^23 in another, as expected: floats would count no further than 2^24.
TEST(SpectrumTest, ManySamplesInABin_AreCounted) {
  const std::vector<std::pair<double, int>> counts = {{0.3, 1 << 25}, {0.7, 1 << 23}};
  constexpr double samples = (1 << 25) + (1 << 23);
  mc::SpectrumTest grid(1, samples, 0);
  mc::WeightedCounts all;
  for (const auto& [v, n] : counts) {
    const mc::Subject::Coordinates at{v};
    for (int i = 0; i < n; ++i) grid.add_sample(at, 1);
    grid.add_expected(at, n);
  }
  for (int i = 0; i < 1000; ++i) {
    all.add_sample(samples / 1000, 0);
    all.add_expected(samples / 1000);
  }
  const std::vector<mc::Check> checks = grid.test(all, 1, 0.01, "");
  ASSERT_FALSE(checks.empty());
  for (const mc::Check& c : checks) EXPECT_EQ(c.verdict, mc::Verdict::pass) << c.name;
}

} // namespace

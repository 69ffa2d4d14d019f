#include <mc/estimate/point_set.h>

#include <mc/core/types.h>
#include <mc/random/permute.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace {

// Every window of the sequence, also across blocks, must have the leading 32 bits of Sobol.
TEST(PointSet, SobolBlocksAreTheSequence) {
  constexpr int dim = 9;
  const mc::Sobol sobol(11);
  for (const std::uint64_t first : {0ull, 1ull, 64ull, 250ull, 4096ull, (1ull << 32) - 300}) {
    std::vector<double> u(300 * dim);
    mc::fill_points(mc::ScrambledSobol{11}, first, dim, u);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const auto bits =
          static_cast<std::uint32_t>(sobol.bits(first + i / dim, static_cast<std::uint32_t>(i % dim)) >> 32);
      EXPECT_EQ(std::floor(std::ldexp(u[i], 32)), bits);
      EXPECT_EQ(std::ldexp(u[i], 52) - std::floor(std::ldexp(u[i], 52)), 0.5);
      EXPECT_GT(u[i], 0);
      EXPECT_LT(u[i], 1);
    }
  }
}

// The bits of two coordinates alternate. The first 2^k points have one in each interval, so each coordinate is a net.
TEST(PointSet, InterlacedBitsAreTwoCoordinatesInTurn) {
  const mc::Sobol sobol(11);
  for (const int dim : {1, 2, 5})
    for (const std::uint64_t first : {0ull, 3ull, 250ull, (1ull << 32) - 300}) {
      const auto n = static_cast<std::size_t>(dim);
      std::vector<double> u(300 * n);
      mc::fill_points(mc::InterlacedSobol{11}, first, dim, u);
      for (std::size_t i = 0; i < u.size(); ++i) {
        const auto bits = static_cast<std::uint64_t>(std::ldexp(u[i], 52));
        EXPECT_EQ(u[i], std::ldexp(static_cast<double>(bits) + 0.5, -52));
        const auto d = static_cast<std::uint32_t>(2 * (i % n));
        for (std::uint32_t k = 0; k < 52; ++k)
          ASSERT_EQ(bits >> (51 - k) & 1, sobol.bits(first + i / n, d + k % 2) >> (63 - k / 2) & 1) << i << " " << k;
      }
    }
  std::vector<double> u(1024);
  std::vector<int> cells(1024);
  mc::fill_points(mc::InterlacedSobol{3}, 0, 1, u);
  for (const double x : u) ++cells[static_cast<std::size_t>(1024 * x)];
  EXPECT_EQ(cells, std::vector<int>(1024, 1));
}

// RMS error of the mean of prod exp(x_d) over 64 seeds, accurate to 9 %.
template <class Set> double rms(int dim, std::size_t n) {
  const double truth = std::pow(std::exp(1.0) - 1, dim);
  double sum = 0;
  std::vector<double> u(static_cast<std::size_t>(dim) * n);
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    mc::fill_points(Set{seed}, 0, dim, u);
    double mean = 0;
    for (std::size_t i = 0; i < u.size(); i += static_cast<std::size_t>(dim)) {
      double product = 1;
      for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) product *= std::exp(u[i + d]);
      mean += product / static_cast<double>(n);
    }
    sum += mc::sqr(mean - truth);
  }
  return std::sqrt(sum / 64);
}
// Exponent over 6 doublings, accurate to sqrt(2) .09 / ln 64 = .03.
template <class Set> double rate(int dim) { return std::log(rms<Set>(dim, 4096) / rms<Set>(dim, 64)) / std::log(64.0); }

TEST(PointSet, InterlacingGainsAnOrderInOneAndTwoDimensionsOnly) {
  EXPECT_NEAR(rate<mc::ScrambledSobol>(1), -1.5, 0.1);
  EXPECT_NEAR(rate<mc::InterlacedSobol>(1), -2.45, 0.1);
  EXPECT_NEAR(rate<mc::ScrambledSobol>(2), -1.45, 0.1);
  EXPECT_LE(rate<mc::InterlacedSobol>(2), -2);
  EXPECT_NEAR(rms<mc::InterlacedSobol>(5, 4096) / rms<mc::ScrambledSobol>(5, 4096), 1, 0.5);
}

TEST(PointSet, DimensionsBeyondSobolAreHashed) {
  constexpr int dim = 1030;
  std::vector<double> u(2 * dim);
  mc::fill_points(mc::ScrambledSobol{5}, 7, dim, u);
  for (const std::uint32_t d : {1024u, 1029u}) EXPECT_EQ(u[dim + d], mc::coordinate<double>(mc::Sobol(5), 8, d));
}

TEST(PointSet, IndependentIsItsSampler) {
  std::vector<double> u(3 * 50);
  mc::fill_points(mc::Independent{4}, 20, 3, u);
  EXPECT_EQ(u[3 * 7 + 2], mc::coordinate<double>(mc::Independent{4}, 27, 2));
}

// Index of the box that contains a point, among `count` boxes; `count` if there is none. Uses integers except for the
// roots. Faces are accurate to 2^-64, and points are at least 2^-52 away from them.
std::uint64_t box_of(std::span<const double> u, std::uint64_t count) {
  std::uint64_t first = 0, left = count, n = count;
  for (std::size_t axis = 0; axis < u.size(); ++axis) {
    const std::size_t axes = u.size() - axis;
    const auto root = static_cast<std::uint64_t>(std::llround(std::pow(left, 1.0 / static_cast<double>(axes))));
    const std::uint64_t strata = axes == 1 ? n : std::max<std::uint64_t>(root, 1);
    const auto start = [&](std::uint64_t i) { return (i * n + strata - 1) / strata; };
    const auto face = [&](std::uint64_t i) { return static_cast<long double>(start(i)) / n; };
    const long double x = u[axis];
    auto i = static_cast<std::uint64_t>(x * strata);
    while (i > 0 && face(i) > x) --i;
    while (i + 1 < strata && face(i + 1) <= x) ++i;
    if (!(face(i) + 0x1p-52 < x && x < face(i + 1) - 0x1p-52)) return count;
    first += start(i);
    n = start(i + 1) - start(i);
    left /= strata;
  }
  return first;
}

// The boxes of the first group of dimensions are in order, the boxes of further groups in the order of their
// permutation.
void expect_boxes(const mc::JitteredBoxes& set, std::uint64_t first, std::size_t points, std::size_t dim) {
  std::vector<double> u(points * dim);
  mc::fill_points(set, first, static_cast<int>(dim), u);
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t d = 0; d < dim; d += 8) {
      const std::span<const double> group(&u[i * dim + d], std::min<std::size_t>(8, dim - d));
      const auto index = static_cast<std::uint32_t>(first + i);
      const std::uint32_t box = d == 0 ? index : mc::permute(index, set.count, mc::hash(~set.seed, d));
      ASSERT_EQ(box_of(group, set.count), box) << set.count << " boxes, " << dim << " dimensions, " << i << ", " << d;
    }
}

TEST(PointSet, EveryJitteredBoxHoldsAPoint) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto count = static_cast<std::uint32_t>(std::exp(8.5 * mc::hash_uniform<double>(seed, 1)));
    expect_boxes({seed, count}, 0, count, 1 + mc::hash(seed, 2) % 20);
  }
}

TEST(PointSet, JitteredBoxesAreExactHoweverMany) {
  for (const std::uint32_t count : {1u << 20, 999'999'937u, 1u << 31, 65535u * 65535u, 0xffffffffu})
    for (const std::size_t dim : {1u, 2u, 3u, 8u, 9u, 11u, 23u})
      for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{count / 3}, std::uint64_t{count - 1000}})
        expect_boxes({count, count}, first, 1000, dim);
}

TEST(PointSet, JitteredBoxesAreTheSameInAnyCut) {
  constexpr std::size_t dim = 19, points = 1500;
  const mc::JitteredBoxes set{7, 2100};
  std::vector<double> whole(points * dim), parts(points * dim);
  mc::fill_points(set, 100, dim, whole);
  for (std::size_t i = 0, n; i < points; i += n) {
    n = std::min<std::size_t>(mc::hash(i) % 400, points - i);
    mc::fill_points(set, 100 + i, dim, {&parts[i * dim], n * dim});
  }
  EXPECT_EQ(whole, parts);
}

// Distribution of points within their box: first and second moments of each coordinate and products of two within 5
// standard deviations. These are 99 tests, a false alarm in 6e-5 of seeds.
TEST(PointSet, JitteredBoxesAreFilledEvenly) {
  constexpr std::size_t dim = 9, n = 200'000;
  std::vector<double> u(dim);
  std::array<double, dim> first{}, second{};
  std::array<std::array<double, dim>, dim> cross{};
  for (std::uint64_t seed = 0; seed < n; ++seed) {
    mc::fill_points(mc::JitteredBoxes{seed, 1}, 0, dim, u);
    for (std::size_t d = 0; d < dim; ++d) {
      first[d] += u[d] - 0.5;
      second[d] += mc::sqr(u[d]) - 1.0 / 3;
      for (std::size_t e = 0; e < d; ++e) cross[d][e] += (u[d] - 0.5) * (u[e] - 0.5);
    }
  }
  const double root = std::sqrt(double(n));
  for (std::size_t d = 0; d < dim; ++d) {
    EXPECT_LE(std::abs(first[d]), 5 * root * std::sqrt(1.0 / 12));
    EXPECT_LE(std::abs(second[d]), 5 * root * std::sqrt(4.0 / 45));
    for (std::size_t e = 0; e < d; ++e) EXPECT_LE(std::abs(cross[d][e]), 5 * root / 12);
  }
}

} // namespace

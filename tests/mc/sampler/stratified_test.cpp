#include <mc/sampler/stratified.h>

#include "nets.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <span>

namespace {

using test::occupancy;
using test::Range;

TEST(Stratified, OnePointPerCellOfAGrid) {
  for (const std::uint32_t side : {1u, 2u, 3u, 10u, 31u})
    for (const std::uint32_t dim : {0u, 2u, 10u}) {
      const mc::Stratified s(side * side, 5);
      EXPECT_EQ(occupancy(s, 0, side * side, dim, side, dim + 1, side), (Range{1, 1})) << side;
      EXPECT_EQ(occupancy(s, 3 * side * side, side * side, dim, side, dim + 1, side), (Range{1, 1})) << "a later set";
    }
  EXPECT_EQ(occupancy(mc::Stratified(27, 1, 3), 0, 27, 0, 3, 1, 3), (Range{3, 3}));
}

TEST(Stratified, OneDimensionalGroupsHaveOnePointPerInterval) {
  for (const std::uint32_t n : {1u, 2u, 7u, 100u, 1021u})
    for (const std::uint32_t dim : {0u, 1u, 2u, 77u})
      EXPECT_EQ(occupancy(mc::Stratified(n, 2, 1), 0, n, dim, n), (Range{1, 1}));
}

// For any count, each stratum contains count / slabs points up to one, in proportion to its width.
TEST(Stratified, AnyCountFillsEveryStratum) {
  for (const std::uint32_t n : {2u, 3u, 5u, 6u, 7u, 12u, 50u, 997u}) {
    const mc::Stratified s(n, 4);
    const auto slabs = static_cast<std::uint32_t>(std::lround(std::sqrt(n)));
    const auto end_of = [&](std::uint32_t k) { return (std::uint64_t{k + 1} * n + slabs - 1) / slabs; };
    std::vector<std::vector<double>> ys(slabs);
    for (std::uint32_t i = 0; i < n; ++i) {
      const double box = mc::coordinate<double>(s, i, 0) * n;
      std::uint32_t slab = 0;
      while (static_cast<double>(end_of(slab)) <= box) ++slab;
      ys[slab].push_back(mc::coordinate<double>(s, i, 1));
    }
    for (std::uint32_t k = 0; k < slabs; ++k) {
      const std::size_t boxes = end_of(k) - (k > 0 ? end_of(k - 1) : 0);
      std::set<std::size_t> rows;
      for (const double y : ys[k]) rows.insert(static_cast<std::size_t>(y * static_cast<double>(boxes)));
      EXPECT_EQ(ys[k].size(), boxes);
      EXPECT_EQ(rows.size(), boxes) << "count " << n << ", slab " << k;
    }
  }
}

TEST(Stratified, AWholePointIsThatOfItsCoordinates) {
  for (const std::uint32_t count : {1u, 2u, 97u, 4096u, 1u << 31})
    for (const std::uint32_t group : {1u, 2u, 3u, 5u, 8u, 40u}) {
      const mc::Stratified s(count, 3, group);
      std::array<double, 19> u;
      for (const std::uint64_t index : {std::uint64_t{0}, std::uint64_t{count - 1}, std::uint64_t{count} + 5}) {
        s.point(index, std::span<double>(u));
        for (std::uint32_t d = 0; d < u.size(); ++d)
          ASSERT_EQ(u[d], mc::coordinate<double>(s, index, d)) << count << ", " << group << ", " << d;
      }
    }
}

// The boundary of the quarter disk crosses about n^1/2 of the cells, so the error is O(n^-3/4): 64 times the points
// give 1/22.6 of it. 200 seeds determine the ratio of RMS errors within 15 % at 2 sd.
TEST(Stratified, SlopeOnTheDiskIsThreeQuarters) {
  const auto make = [](std::uint32_t n) { return [n](std::uint64_t seed) { return mc::Stratified(n, seed); }; };
  const auto f = [](double x, double y) { return x * x + y * y < 1 ? 1.0 : 0.0; };
  const double coarse = test::rms_error(make(64), 64, 200, 0, mc::pi<double> / 4, f),
               fine = test::rms_error(make(4096), 4096, 200, 0, mc::pi<double> / 4, f);
  EXPECT_NEAR(std::log(fine / coarse) / std::log(64.0), -0.75, 0.06);
}

TEST(Stratified, UniformOverSeeds) {
  for (const std::uint32_t n : {1u, 3u, 10u, 0xffffffffu})
    for (const std::uint32_t d : {0u, 1u, 6u})
      for (const std::uint64_t i : {0ull, 1ull, 0xfffffffeull})
        EXPECT_LE(test::seed_moments([n](std::uint64_t seed) { return mc::Stratified(n, seed); }, i, d, 4000), 5)
            << n << " " << d << " " << i;
}

TEST(Stratified, RejectsNonsense) {
  EXPECT_THROW(mc::Stratified(0), mc::Error);
  EXPECT_THROW(mc::Stratified(1, 0, 0), mc::Error);
}

} // namespace

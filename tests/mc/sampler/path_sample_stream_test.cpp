#include <mc/sampler/path_sample_stream.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace {

using namespace mc;

template <class Stream> class PathSampleStreamOf : public testing::Test {};
using Streams = testing::Types<IndependentPathStream<float>, SobolPathStream<float>, StratifiedPathStream<float>>;
TYPED_TEST_SUITE(PathSampleStreamOf, Streams);

TYPED_TEST(PathSampleStreamOf, IsAFunctionOfKeyAndIndex) {
  std::set<float> firsts;
  for (std::uint32_t index = 0; index < 16; ++index) {
    const typename TypeParam::Points points(7, 16), others(8, 16);
    TypeParam a(points, index), b(points, index), other(others, index);
    int same = 0;
    for (int i = 0; i < 40; ++i) {
      const Vec2<float> u = a.next2();
      EXPECT_EQ(u, b.next2());
      same += u == other.next2();
      EXPECT_TRUE((u.array() >= 0).all() && (u.array() < 1).all());
      if (i == 0) firsts.insert(u[0]);
      const float x = a.next();
      EXPECT_EQ(x, b.next());
      EXPECT_TRUE(x >= 0 && x < 1);
    }
    EXPECT_LE(same, 1) << "another key gives the same numbers";
  }
  EXPECT_EQ(firsts.size(), 16u);
}

// Single numbers between pairs must not affect the pairs: each of the first pairs fills the 4 x 4 cells.
template <class Stream> void fills_cells() {
  for (std::uint32_t pair = 0; pair < Stream::pairs; ++pair) {
    std::set<int> cells;
    for (std::uint32_t index = 0; index < 16; ++index) {
      const typename Stream::Points points(99, 16);
      Stream stream(points, index);
      Vec2<float> u = stream.next2();
      for (std::uint32_t k = 0; k < pair; ++k) {
        if (index % 2) stream.next();
        u = stream.next2();
      }
      cells.insert(int(4 * u[0]) * 4 + int(4 * u[1]));
    }
    EXPECT_EQ(cells.size(), 16u) << "pair " << pair;
  }
}
// The two branches of 8 paths must fill the 4 x 4 cells of their first pair and share no numbers.
template <class Stream> void branches_fill_cells(std::uint32_t count = 8) {
  const typename Stream::Points points(99, count);
  std::set<int> cells;
  std::set<float> singles;
  for (std::uint32_t index = 0; index < 8; ++index) {
    Stream stream(points, index);
    stream.next2();
    for (std::uint32_t i = 0; i < 2; ++i) {
      Stream branch = stream.branch(i, 2);
      const Vec2<float> u = branch.next2();
      cells.insert(int(4 * u[0]) * 4 + int(4 * u[1]));
      singles.insert(branch.next());
    }
    singles.insert(stream.next());
  }
  EXPECT_EQ(cells.size(), 16u);
  EXPECT_EQ(singles.size(), 24u);
}
TEST(PathSampleStreamPairs, BranchesOfSobolFillCells) { branches_fill_cells<SobolPathStream<float>>(); }
TEST(PathSampleStreamPairs, BranchesOfStratifiedFillCells) { branches_fill_cells<StratifiedPathStream<float>>(); }
// The first walks share one set for any count of the set.
TEST(PathSampleStreamPairs, BranchesOfLongSobolFillCells) { branches_fill_cells<SobolPathStream<float>>(1u << 31); }
TEST(PathSampleStreamPairs, SobolFillsCells) { fills_cells<SobolPathStream<float>>(); }
TEST(PathSampleStreamPairs, StratifiedFillsCells) { fills_cells<StratifiedPathStream<float>>(); }

// Branches use independent numbers if the point set would be too large for indices.
TEST(PathSampleStreamPairs, BranchesBeyondAllCountsAreIndependent) {
  const mc::StratifiedPairs points(1, 70'000);
  const StratifiedPathStream<float> stream(points, 69'999);
  double sum = 0;
  mc::Vec2<float> last{-1, -1};
  for (std::uint32_t i = 0; i < 256; ++i) {
    StratifiedPathStream<float> branch = stream.branch(i, 256).branch(3, 256);
    const mc::Vec2<float> u = branch.next2();
    EXPECT_TRUE(u.minCoeff() >= 0 && u.maxCoeff() < 1);
    EXPECT_NE(u, last);
    last = u;
    sum += static_cast<double>(u.x());
  }
  EXPECT_NEAR(sum / 256, 0.5, 5 / std::sqrt(12 * 256.0));
}

// The last valid index is a point of the sequence, the next one is not.
TEST(PathSampleStreamPairs, SobolBranchesToTheLastIndex) {
  const mc::SobolPairs points(1, 1);
  constexpr std::uint32_t half = 1u << 31;
  EXPECT_EQ(SobolPathStream<float>(points, half - 1).branch(1, 2).next2(), points.pair<float>(2 * half - 1, 0, 2));
  EXPECT_NE(SobolPathStream<float>(points, half).branch(0, 2).next2(), points.pair<float>(0, 0, 2));
}

} // namespace

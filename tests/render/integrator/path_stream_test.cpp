#include <render/integrator/path_stream.h>

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace render;

template <class Stream> class PathStream : public testing::Test {};
using Streams = testing::Types<IndependentStream, SobolStream, StratifiedStream>;
TYPED_TEST_SUITE(PathStream, Streams);

TYPED_TEST(PathStream, IsAFunctionOfKeyAndIndex) {
  std::set<Float> firsts;
  for (std::uint32_t index = 0; index < 16; ++index) {
    TypeParam a(7, 16, index), b(7, 16, index), other(8, 16, index);
    int same = 0;
    for (int i = 0; i < 40; ++i) {
      const Vec2 u = a.next2();
      EXPECT_EQ(u, b.next2());
      same += u == other.next2();
      EXPECT_TRUE((u.array() >= 0).all() && (u.array() < 1).all());
      if (i == 0) firsts.insert(u[0]);
      const Float x = a.next();
      EXPECT_EQ(x, b.next());
      EXPECT_TRUE(x >= 0 && x < 1);
    }
    EXPECT_LE(same, 1) << "another key gives the same numbers";
  }
  EXPECT_EQ(firsts.size(), 16u);
}

// Single numbers between pairs do not disturb the pairs: every one of the first pairs fills the 4 x 4 cells.
template <class Stream> void fills_cells() {
  for (std::uint32_t pair = 0; pair < Stream::pairs; ++pair) {
    std::set<int> cells;
    for (std::uint32_t index = 0; index < 16; ++index) {
      Stream stream(99, 16, index);
      Vec2 u = stream.next2();
      for (std::uint32_t k = 0; k < pair; ++k) {
        if (index % 2) stream.next();
        u = stream.next2();
      }
      cells.insert(int(4 * u[0]) * 4 + int(4 * u[1]));
    }
    EXPECT_EQ(cells.size(), 16u) << "pair " << pair;
  }
}
TEST(PathStreamPairs, SobolFillsCells) { fills_cells<SobolStream>(); }
TEST(PathStreamPairs, StratifiedFillsCells) { fills_cells<StratifiedStream>(); }

} // namespace

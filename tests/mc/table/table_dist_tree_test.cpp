#include <mc/random/uniform.h>
#include <mc/table/table_dist_tree.h>
#include <mc/warp/concept.h>

#include <gtest/gtest.h>

namespace {

template <class S> class TableDistTreeTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TableDistTreeTest, Scalars);

static_assert(mc::InvertibleWarp<mc::TableDistTree<float, 2>> && mc::InvertibleWarp<mc::TableDistTree<double, 5>>);

// A ridge along the diagonal; 0 far from it.
template <class S, int N> mc::TableDistTree<S, N> ridge(std::size_t leaves) {
  return mc::TableDistTree<S, N>::from_function(
      [](const mc::Vec<double, N>& x) {
        const double off = (x.array() - x.mean()).matrix().norm();
        return off < 0.2 ? std::exp(-20 * off) : 0.0;
      },
      leaves);
}

TYPED_TEST(TableDistTreeTest, PointsStayInBoxesOfPositiveWeight) {
  using S = TypeParam;
  const auto table = ridge<S, 3>(500);
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    mc::Vec3<S> u;
    for (int d = 0; d < 3; ++d) {
      const S ends[] = {0, mc::one_minus_epsilon<S>, mc::hash_uniform<S>(i, d), S(0.5)};
      u[d] = ends[mc::hash(i, 10 + d) % 4];
    }
    const mc::Vec3<S> x = table.sample(u);
    ASSERT_TRUE(table.domain().contains(x));
    ASSERT_EQ(table.tree().leaf_of_x(x), table.tree().leaf_of_u(u));
    ASSERT_GT(table.pdf(x), 0);
    // About four halvings along an axis: the density of a box magnifies the rounding of x by at most this bound.
    ASSERT_LE((table.invert(x) - u).cwiseAbs().maxCoeff(), 200 * std::numeric_limits<S>::epsilon());
  }
  EXPECT_EQ(table.pdf({S(1.1), S(0.5), S(0.5)}), 0);
}

TEST(TableDistTree, EmptyBoxesHaveNoDensity) {
  const auto table = mc::TableDistTree<double, 2>::from_function(
      [](const mc::Vec2<double>& x) { return x[0] > 0.5 && x[1] > 0.25 ? 1.0 : 0.0; }, 100);
  EXPECT_EQ(table.pdf({0.25, 0.5}), 0);
  EXPECT_NEAR(table.pdf({0.75, 0.5}), 1 / (0.5 * 0.75), 1e-9);
}

TEST(TableDistTree, BreaksAreItsPlanes) {
  constexpr std::uint32_t leaf = mc::BoxTreeNode::leaf;
  const std::vector<mc::BoxTreeNode> nodes = {{1, 0.6}, {0, 0.3}, {leaf, 1}, {leaf, 2}, {0, 0.3}, {leaf, 3}, {leaf, 4}};
  const mc::TableDistTree<double, 2> table(nodes);
  EXPECT_EQ(table.breaks()[0], std::vector{0.3});
  EXPECT_EQ(table.breaks()[1], std::vector{0.6});
  EXPECT_NEAR(table.pdf({0.1, 0.1}), 0.1 / (0.3 * 0.6), 1e-14);
  EXPECT_NEAR(table.pdf({0.9, 0.9}), 0.4 / (0.7 * 0.4), 1e-14);
  EXPECT_EQ((table.cast<float>().pdf({0.9f, 0.9f})), static_cast<float>(table.pdf({0.9, 0.9})));
}

TEST(TableDistTree, RejectsTreesOfOtherDimensions) {
  EXPECT_THROW((mc::TableDistTree<double, 3>(mc::BoxTree(2))), mc::Error);
}

} // namespace

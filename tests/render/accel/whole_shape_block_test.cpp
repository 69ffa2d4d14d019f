#include <render/accel/whole_shape_block.h>

#include <render/shape/disk.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

struct Block : WholeShapeBlock<Disk> {
  using WholeShapeBlock::nearest, WholeShapeBlock::set_shape;
};

TEST(WholeShapeBlock, NearestOfTheLanesThatAreHit) {
  Block block;
  EightDoubles t{};
  for (std::uint32_t lane = 0; lane < 8; ++lane) {
    block.set_shape(lane, 10 + int(lane));
    t[lane] = 8 - double(lane);
  }
  Float t_max = 100;
  Hit hit;
  EXPECT_FALSE(block.nearest<false>(0, t, t_max, hit));
  EXPECT_EQ(t_max, 100);
  EXPECT_TRUE(block.nearest<true>(0b00101010, t, t_max, hit));
  EXPECT_EQ(t_max, 100) << "only whether there is a hit";
  EXPECT_TRUE(block.nearest<false>(0b00101010, t, t_max, hit));
  EXPECT_EQ(hit.shape, 15);
  EXPECT_EQ(hit.t, 3);
  EXPECT_EQ(t_max, 3);
}

TEST(WholeShapeBlock, AShapeIsOnePrimitiveWithinItsBounds) {
  const Disk disk(Transform::scale({2, 1, 1}));
  Block::Primitive found[1];
  ASSERT_EQ(Block::size(disk), 1u);
  ASSERT_EQ(Block::collect(disk, 7, 0, 1, found), found + 1);
  EXPECT_EQ(found[0].shape, 7);
  EXPECT_LE(found[0].bounds().lo[0], -2);
  EXPECT_GE(found[0].bounds().hi[0], 2);
}

} // namespace

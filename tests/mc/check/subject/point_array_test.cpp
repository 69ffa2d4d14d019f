#include <mc/check/subject/point_array.h>

#include <gtest/gtest.h>

namespace {

TEST(PointArray, RoundTrip_AnyPointType) {
  using namespace mc::detail;
  EXPECT_EQ(to_array<double>(0.5f), (mc::PointArray{0.5}));
  EXPECT_EQ(to_array<double>(mc::Vec2<float>(0.5f, 2)), (mc::PointArray{0.5, 2}));
  EXPECT_EQ((to_point<mc::Vec3<float>>(mc::PointArray{1, 2, 0.1})), mc::Vec3<float>(1, 2, 0.1f));
  EXPECT_EQ(to_point<float>(mc::PointArray{0.1}), 0.1f);
}

TEST(PointArray, Format_HasRequestedDigits) {
  EXPECT_EQ(mc::format_numbers(std::array{0.25}, 17), "0.25");
  EXPECT_EQ(mc::format_numbers(std::array{0.25, 0.1}, 17), "(0.25, 0.10000000000000001)");
  EXPECT_EQ(mc::detail::format_point(mc::Vec2<float>(0.1f, 1)), "(0.100000001, 1)");
  EXPECT_EQ(mc::detail::format_point(0.5), "0.5");
}

} // namespace

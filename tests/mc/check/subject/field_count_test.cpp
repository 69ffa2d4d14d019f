#include <mc/check/subject/field_count.h>

#include <mc/core/types.h>

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace {

struct None {};
struct Three {
  mc::Vec3<float> wi;
  float pdf;
  bool delta;
};
struct Many {
  mc::Vec3<double> wi;
  Eigen::Array3d f;
  Eigen::Array<float, 8, 1> weight;
  std::optional<double> eta;
  std::string name = "x";
  double pdf = 0;
};
struct Derived : Three {
  double more;
};
struct NoAggregate {
  explicit NoAggregate(int) {}
  int a = 0, b = 0;
};

TEST(FieldCount, CountsMembersOfAggregates) {
  EXPECT_EQ(mc::detail::field_count<None>(), 0);
  EXPECT_EQ(mc::detail::field_count<Three>(), 3);
  EXPECT_EQ(mc::detail::field_count<Many>(), 6);
  EXPECT_EQ(mc::detail::field_count<Derived>(), 2) << "a base class counts as one";
  EXPECT_EQ(mc::detail::field_count<NoAggregate>(), 0);
  EXPECT_EQ(mc::detail::field_count<double>(), 0);
}

} // namespace

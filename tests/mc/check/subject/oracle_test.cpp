#include <mc/check/subject/oracle.h>

#include <gtest/gtest.h>

namespace {

TEST(Oracle, FiftyDigits) {
  const mc::Oracle root = sqrt(mc::Oracle(2));
  EXPECT_LE(abs(mc::Oracle(root * root - 2)), mc::Oracle("1e-49"));
  EXPECT_LE(abs(mc::Oracle(mc::pi<mc::Oracle> - mc::Oracle("3.14159265358979323846264338327950288419716939937510"))),
            mc::Oracle("1e-48"));
  static_assert(mc::Real<mc::Oracle>);
}

TEST(Oracle, IsAPlainNumberToEigen) {
  const mc::Vec3<mc::Oracle> v(1, 2, 2);
  EXPECT_EQ(v.norm(), 3);
}

} // namespace

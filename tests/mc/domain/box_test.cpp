#include <mc/domain/box.h>

#include <gmock/gmock.h>

#include "support/domain_laws.h"
#include "support/files.h"

namespace {

TEST(Box, Chart) {
  support::expect_domain_laws(mc::Square<float>(), 1);
  support::expect_domain_laws(mc::Square<double>({-3, 2}, {5, 2.5}), 8);
  support::expect_domain_laws(mc::Box<double, 3>({0, 0, 0}, {1, 2, 3}), 2);
}

TEST(Box, DynamicTakesItsDimensionFromTheBounds) {
  using Dynamic = mc::Box<double, Eigen::Dynamic>;
  const Dynamic box(Eigen::VectorXd::Constant(5, -1), Eigen::VectorXd::Constant(5, 1));
  EXPECT_EQ(box.dimension(), 5);
  EXPECT_EQ(box.jacobian(Eigen::VectorXd::Constant(5, 0.5)), 32);
}

TEST(Box, RefusesNonsense) {
  EXPECT_EQ(support::error_of([] {
              mc::Square<double>({0, 1}, {1, 1});
            }),
            "Box: side 1 is [1, 1]; finite bounds with lo < hi are needed");
  EXPECT_THAT(support::error_of([] {
                mc::Square<double>({0, NAN}, {1, 1});
              }),
              testing::HasSubstr("side 1 is [nan, 1]"));
  using Dynamic = mc::Box<double, Eigen::Dynamic>;
  EXPECT_THAT(support::error_of([] { Dynamic(Eigen::VectorXd(), Eigen::VectorXd()); }),
              testing::HasSubstr("at least 1"));
}

} // namespace

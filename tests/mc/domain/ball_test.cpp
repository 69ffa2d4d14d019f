#include <mc/domain/ball.h>
#include <support/domain_laws.h>

namespace mc {
namespace {

TEST(Ball, ChartGoesThereAndBack) {
  static_assert(Domain<Ball<float>>);
  support::expect_domain_laws(Ball<float>{}, 8);
  support::expect_domain_laws(Ball<double>{}, 8);
}

TEST(Ball, Membership) {
  EXPECT_TRUE(Ball<double>{}.contains({0, 0, 0}));
  EXPECT_TRUE(Ball<double>{}.contains({0, -1, 0}));
  EXPECT_FALSE(Ball<double>{}.contains({0.6, 0.6, 0.6}));
  EXPECT_FALSE(Ball<double>{}.contains({0, 0, double(NAN)}));
}

TEST(Ball, TheCentreHasCoordinates) { EXPECT_EQ(Ball<double>{}.to_unit({0, 0, 0}), Vec3<double>(0, 0, 0)); }

} // namespace
} // namespace mc

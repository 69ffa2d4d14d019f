#include <mc/domain/unit_quaternions.h>
#include <support/domain_laws.h>

namespace mc {
namespace {

TEST(UnitQuaternions, ChartGoesThereAndBack) {
  static_assert(Domain<UnitQuaternions<float>>);
  support::expect_domain_laws(UnitQuaternions<float>{}, 8);
  support::expect_domain_laws(UnitQuaternions<double>{}, 8);
}

TEST(UnitQuaternions, OppositeQuaternionsAreOneRotation) {
  const UnitQuaternions<double> d;
  Pcg random(4);
  for (int i = 0; i < 100; ++i) {
    const Vec<double, 4> q = d.from_unit(random.point<double, 3>());
    EXPECT_EQ(d.to_unit(q), d.to_unit(-q));
  }
  EXPECT_EQ(d.to_unit({0, 0, 0, -1}), d.to_unit({0, 0, 0, 1}));
}

TEST(UnitQuaternions, Membership) {
  EXPECT_TRUE(UnitQuaternions<double>{}.contains({0.5, -0.5, 0.5, -0.5}));
  EXPECT_FALSE(UnitQuaternions<double>{}.contains({0.5, 0.5, 0.5, 0}));
  EXPECT_FALSE(UnitQuaternions<double>{}.contains({0, 0, 1, double(NAN)}));
}

} // namespace
} // namespace mc

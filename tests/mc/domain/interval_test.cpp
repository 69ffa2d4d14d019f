#include <mc/domain/box.h>
#include <mc/domain/interval.h>
#include <mc/random/pcg.h>

#include "support/domain_laws.h"
#include "support/files.h"

namespace {

TEST(Interval, Chart) {
  support::expect_domain_laws(mc::Interval<float>(), 1);
  support::expect_domain_laws(mc::Interval<double>(-2, 6), 2);
}

TEST(HalfLine, Chart) {
  support::expect_domain_laws(mc::HalfLine<float>(0, 2), 4);
  support::expect_domain_laws(mc::HalfLine<double>(0, -3), 4);
}

TEST(RealLine, Chart) {
  support::expect_domain_laws(mc::RealLine<float>(0, 1), 4);
  support::expect_domain_laws(mc::RealLine<double>(0, 1e-3), 4);
}

// For large |x|, v keeps its relative precision near 0 and 1 - v its absolute precision near 1.
TEST(RealLine, TailsDoNotCancel) {
  const mc::RealLine<double> line;
  EXPECT_NEAR(line.to_unit(-1e8) * 2e8, 1, 1e-7);
  EXPECT_NEAR((1 - line.to_unit(1e8)) * 2e8, 1, 1e-7);
  EXPECT_EQ(line.to_unit(0), 0.5);
}

// 1 - v is rounded before the product with lo, which without clamping would move some points below lo.
TEST(Interval, NoPointIsRoundedOutOfIt) {
  mc::Pcg random(1);
  for (int i = 0; i < 20'000; ++i) {
    const double lo = 2 * random.uniform<double>() - 1, hi = lo + 100 * random.uniform<double>() + 1e-6;
    const double v = 1e-15 * random.uniform<double>();
    const mc::Interval<double> interval(lo, hi);
    ASSERT_TRUE(interval.contains(interval.from_unit(v))) << lo << " " << hi << " " << v;
    ASSERT_TRUE(interval.contains(interval.from_unit(1 - v))) << lo << " " << hi << " " << v;
    const mc::Square<double> box({lo, 0}, {hi, 1});
    ASSERT_TRUE(box.contains(box.from_unit({v, 0.5}))) << lo << " " << hi << " " << v;
  }
}

TEST(Interval, RefusesNonsense) {
  EXPECT_EQ(support::error_of([] { mc::Interval<double>(1, 1); }),
            "Interval: [1, 1] needs finite bounds and a finite width, with lo < hi");
  EXPECT_NE(support::error_of([] { mc::Interval<double>(0, INFINITY); }), "");
  EXPECT_NE(support::error_of([] { mc::Interval<double>(NAN, 1); }), "");
  EXPECT_NE(support::error_of([] { mc::HalfLine<double>(0, 0); }), "");
  EXPECT_NE(support::error_of([] { mc::RealLine<double>(0, -1); }), "");
  EXPECT_FALSE(mc::Interval<double>().contains(NAN));
  EXPECT_FALSE(mc::RealLine<double>().contains(INFINITY));
}

} // namespace

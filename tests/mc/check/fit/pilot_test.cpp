#include <mc/check/fit/pilot.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/interval.h>

#include <gtest/gtest.h>

namespace {

TEST(Pilot, IsAnEighthWithinBounds) {
  EXPECT_EQ(mc::pilot_samples(2000), 1000u);
  EXPECT_EQ(mc::pilot_samples(1'000'000), 125'000u);
  EXPECT_EQ(mc::pilot_samples(100'000'000), 1u << 20);
}

TEST(Pilot, RanksAreSharesOfItsPoints) {
  const mc::Subject s = make_subject(
      "square", mc::Interval<double>(0, 1), [](mc::Pcg& r) { return mc::sqr(r.uniform<double>()); },
      [](double x) { return 0.5 / std::sqrt(x); });
  const mc::Pilot pilot = draw_pilot(s, 7, 80'000);
  ASSERT_EQ(pilot.points.size(), 10'000u);
  EXPECT_EQ(pilot.rank(0, 0), 0);
  EXPECT_EQ(pilot.rank(0, 2), 1);
  EXPECT_NEAR(pilot.rank(0, 0.25), 0.5, 0.025); // 5 standard deviations
}

} // namespace

#include <mc/check/fit/pilot.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/interval.h>

#include <gtest/gtest.h>

namespace {

TEST(Pilot, Size_IsEighthWithinBounds) {
  EXPECT_EQ(mc::pilot_samples(2000), 1000u);
  EXPECT_EQ(mc::pilot_samples(1'000'000), 125'000u);
  EXPECT_EQ(mc::pilot_samples(100'000'000), 1u << 20);
}

TEST(Pilot, Rank_IsShareOfPointsBelow) {
  const mc::Subject s = make_subject(
      "square", mc::Interval<double>(0, 1), [](mc::Pcg& r) { return mc::sqr(r.uniform<double>()); },
      [](double x) { return 0.5 / std::sqrt(x); });
  const mc::Pilot pilot = draw_pilot(s, 7, 80'000);
  ASSERT_EQ(pilot.points.size(), 10'000u);
  EXPECT_EQ(pilot.rank(0, 0), 0);
  EXPECT_EQ(pilot.rank(0, 2), 1);
  EXPECT_NEAR(pilot.rank(0, 0.25), 0.5, 0.025); // 5 standard deviations
}

TEST(Pilot, Nearest_ReturnsClosestPointsOnAxis) {
  mc::Pcg random(5);
  mc::Pilot pilot;
  for (int i = 0; i < 500; ++i) pilot.points.push_back({std::floor(100 * random.uniform<double>()) / 100, 0, 0});
  for (const auto& p : pilot.points) pilot.sorted[0].push_back(p[0]);
  std::sort(pilot.sorted[0].begin(), pilot.sorted[0].end());
  for (const double v : {-1.0, 0.0, 0.314, 0.5, 0.999, 2.0}) {
    std::vector<double> distances, found;
    for (const auto& p : pilot.points) distances.push_back(std::abs(p[0] - v));
    std::sort(distances.begin(), distances.end());
    for (const std::uint32_t i : pilot.nearest(0, v, 16)) found.push_back(std::abs(pilot.points[i][0] - v));
    ASSERT_EQ(found.size(), 16u);
    // Points at the same position are interchangeable, so only the distance of the farthest point is compared.
    EXPECT_LE(*std::max_element(found.begin(), found.end()), distances[15] + 1e-12) << v;
  }
}

} // namespace

#include <mc/check/fit/expected/stratified_reference.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/box.h>
#include <mc/domain/interval.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using mc::Pcg;

struct Estimated {
  mc::StratifiedReference::CellMasses masses;
  double least_weight = 1;
};

Estimated estimate(const mc::Subject& s, std::uint64_t seed, std::size_t most = 1 << 22) {
  const mc::Pilot pilot = draw_pilot(s, seed, 80'000);
  mc::StratifiedReference reference(s, pilot, {s, pilot, 6}, seed + 1);
  Estimated e{reference.integrate(s, {.samples = 8e4, .min_points = 1 << 12, .max_points = most}, seed + 2)};
  for (std::size_t i = 0; i < pilot.points.size(); ++i)
    e.least_weight = std::min(e.least_weight, reference.find_stratum(pilot.points[i]).weight(pilot.densities[i]));
  return e;
}

// The mass of a smooth density is far more accurate than its counts, and no sample is capped.
TEST(StratifiedReference, SmoothDensity_HasSmallError) {
  const mc::Subject s = make_subject(
      "linear", mc::Interval<double>(0, 1), [](Pcg& r) { return std::sqrt(r.uniform<double>()); },
      [](double x) { return 2 * x; });
  const Estimated e = estimate(s, 3);
  EXPECT_EQ(e.least_weight, 1);
  EXPECT_NEAR(e.masses.total.value, 1, 5 * std::sqrt(e.masses.total.worst_case_variance()));
  EXPECT_LE(e.masses.total.variance, 1e-9);
  EXPECT_FALSE(e.masses.invalid_point);
}

// With breaks the integral of a rough table is exact. Without breaks the stated error holds: 64 cells are within 5
// standard deviations, and the sum of their squares is within the 1e-4 quantile of chi-square of 64.
TEST(StratifiedReference, RandomTexels_StatedVarianceCoversError) {
  mc::Pcg random(11);
  std::vector<double> texels(317);
  double sum = 0;
  for (double& t : texels) sum += t = mc::sqr(mc::sqr(random.uniform<double>()));
  const auto pdf = [=](double x) { return texels[static_cast<std::size_t>(317 * x)] / sum * 317; };
  mc::Subject s = make_subject(
      "texels", mc::Interval<double>(0, 1),
      [=](Pcg& r) {
        for (;;)
          if (const double x = r.uniform<double>(); r.uniform<double>() * 317 / sum < pdf(x)) return x;
      },
      pdf);
  const Estimated rough = estimate(s, 5, 1 << 13);
  for (int i = 1; i < 317; ++i) s.breaks[0].push_back(i / 317.0);
  const Estimated exact = estimate(s, 5);
  EXPECT_NEAR(exact.masses.total.value, 1, 1e-12);
  EXPECT_LE(exact.masses.total.variance, 1e-28);
  double square = 0;
  for (std::size_t i = 0; i < 64; ++i) {
    const double off = rough.masses.cells[i].value - exact.masses.cells[i].value;
    const double z = off / std::sqrt(rough.masses.cells[i].worst_case_variance());
    EXPECT_LE(std::abs(z), 5) << i;
    square += z * z;
  }
  EXPECT_LE(square, 115);
}

// A lobe with few samples gets strata small enough to resolve it.
TEST(StratifiedReference, NarrowLobe_IsStratifiedAroundPilot) {
  const double k = 5e-3, s0 = 1e-9, at = 0.3141592;
  const mc::Subject s = make_subject(
      "lobe", mc::Interval<double>(0, 1),
      [=](Pcg& r) { return r.uniform<double>() < k ? at + s0 * r.uniform<double>() : r.uniform<double>(); },
      [=](double x) { return 1 - k + (x >= at && x < at + s0 ? k / s0 : 0.0); });
  const Estimated e = estimate(s, 7);
  EXPECT_NEAR(e.masses.total.value, 1, 5 * std::sqrt(e.masses.total.worst_case_variance()));
  EXPECT_LE(e.masses.total.variance, 1e-6);
}

// A sample has a small weight if its density far exceeds the cap.
TEST(StratifiedReference, Weight_AboveCap_IsReduced) {
  mc::Subject s = make_subject(
      "flat", mc::Interval<double>(0, 1), [](Pcg& r) { return r.uniform<double>(); }, [](double) { return 1.0; });
  const mc::Pilot pilot = draw_pilot(s, 3, 80'000);
  const mc::StratifiedReference reference(s, pilot, {s, pilot, 6}, 1);
  EXPECT_EQ(reference.find_stratum({0.5, 0, 0}).weight(1), 1);
  EXPECT_EQ(reference.find_stratum({0.5, 0, 0}).weight(3), 1);
  EXPECT_LT(reference.find_stratum({0.5, 0, 0}).weight(1e6), 1e-3);
}

TEST(StratifiedReference, NonFiniteDensity_KeepsFirstPoint) {
  const mc::Subject s = make_subject(
      "NaN", mc::Interval<double>(0, 1), [](Pcg& r) { return r.uniform<double>(); },
      [](double x) { return x > 0.9 ? std::nan("") : 1.0; });
  const Estimated e = estimate(s, 3);
  ASSERT_TRUE(e.masses.invalid_point);
  EXPECT_GT((*e.masses.invalid_point)[0], 0.9);
}

// A cut inside a lobe of 300 float steps moves about one step of samples. In double the effect is negligible.
TEST(PilotCells, RoundingShares_ArePositiveOnlyForNarrowLobes) {
  const auto largest = [](double width, double epsilon) {
    mc::Subject s = make_subject(
        "box", mc::Interval<double>(0, 1), [=](Pcg& r) { return 0.6 + width * r.uniform<double>(); },
        [=](double x) { return x >= 0.6 && x <= 0.6 + width ? 1 / width : 0.0; });
    s.epsilon = epsilon;
    s.resolution = [=](const mc::Subject::Coordinates& v, int) { return epsilon * v[0]; };
    const mc::Pilot pilot = draw_pilot(s, 1, 80'000);
    const std::vector<double> shares = mc::PilotCells(s, pilot, 4).rounding_shares(s, pilot);
    return *std::max_element(shares.begin(), shares.end());
  };
  constexpr double step = 0x1p-24;
  EXPECT_GT(largest(300 * step, 2 * step), 1 / 300.0);
  EXPECT_LT(largest(300 * step, 2 * step), 10 / 300.0);
  EXPECT_LT(largest(1, 2 * step), 1e-3);
  EXPECT_EQ(largest(300 * step, 4 * 0x1p-53), 0);
}

} // namespace

#include <mc/check/fit/explanations/coarse_axes.h>

#include <mc/check/random_subjects.h>

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>
#include <mc/domain/box.h>
#include <mc/domain/disk.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using checker_bench::narrow_lobe;
using mc::Verdict;

std::vector<mc::CoarseAxis> coarse_axes(const mc::Subject& s) { return find_coarse_axes(s, draw_pilot(s, 1, 200'000)); }

// Samples crowd within some tens of steps below x = 1; y has the density 1 of `power` = 1.
mc::Subject crowded(double power) {
  constexpr double width = 1e-14;
  return make_subject(
      "crowded", mc::Box<double, 2>(),
      [=](mc::Pcg& r) {
        const double x = 1 + width * std::log1p(-r.uniform<double>());
        return mc::Vec2<double>(std::max(x, 0.0), std::pow(r.uniform<double>(), power));
      },
      [](const mc::Vec2<double>& p) { return std::exp((p.x() - 1) / width) / width; });
}

TEST(CoarseAxes, FewStepsWide_AreNamed) {
  const std::vector<mc::CoarseAxis> coarse = coarse_axes(crowded(1));
  ASSERT_EQ(coarse.size(), 1u);
  EXPECT_EQ(coarse[0].axis, 0u);
  EXPECT_EQ(coarse[0].finding.fault, mc::Fault::rounding);
  EXPECT_TRUE(coarse_axes(narrow_lobe(false, true, 1e-9)).empty());
}

// A clamped radius: the points of the ring differ by rounding, and the density claims nothing for it.
TEST(CoarseAxes, RingOfWrongSamples_IsNoRoundingAndFails) {
  const mc::Subject ring = make_subject(
      "ring", mc::Disk<double>(),
      [](mc::Pcg& r) {
        const double radius = std::min(std::sqrt(r.uniform<double>()), 0.8), phi = 6.2831853 * r.uniform<double>();
        return mc::Vec2<double>(radius * std::cos(phi), radius * std::sin(phi));
      },
      [](const mc::Vec2<double>&) { return 1 / mc::pi<double>; });
  EXPECT_TRUE(coarse_axes(ring).empty());
  EXPECT_EQ(check_subject(ring, {.samples = 100'000}).verdict(), Verdict::fail);
}

// Rounding along x excuses no fault along y.
TEST(CoarseAxes, FaultAlongAnotherAxis_Fails) {
  const mc::Report right = check_subject(crowded(1), {.samples = 100'000}),
                   wrong = check_subject(crowded(1.2), {.samples = 100'000});
  EXPECT_NE(right.verdict(), Verdict::fail) << right.to_string();
  EXPECT_EQ(wrong.verdict(), Verdict::fail) << wrong.to_string();
}

} // namespace

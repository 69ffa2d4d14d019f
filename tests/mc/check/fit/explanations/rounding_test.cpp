#include <mc/check/fit/explanations/rounding.h>

#include <mc/check/random_subjects.h>

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>
#include <mc/domain/interval.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using mc::Fault, mc::Verdict;

// The test of a mass, for the lobe of width 1.1e-5 with cosines of this scalar.
mc::Check mass_test(bool in_float, double value) {
  mc::Subject lobe = checker_bench::narrow_lobe(in_float, false, 1.1e-5);
  lobe.resolution = [=](const mc::Subject::Coordinates&, int axis) {
    if (axis > 0) return 0.0;
    return in_float ? 0x1p-25 : 0x1p-54;
  };
  mc::ClaimedMass mass;
  mass.value = value;
  mass.error = 1e-3;
  mc::Check test{"mass", Verdict::fail, {}, 0, std::abs(value - 1), mass.error, Fault::mass, {}};
  explain_mass_by_rounding(lobe, draw_pilot(lobe, 1, 10'000), mass, test);
  return test;
}

// The density in float changes by about .4 % between neighbouring points.
TEST(Rounding, WrongMassWithinIt_IsInconclusive) {
  EXPECT_EQ(mass_test(true, 0.997).verdict, Verdict::inconclusive);
  EXPECT_EQ(mass_test(true, 0.997).fault, Fault::rounding);
  EXPECT_EQ(mass_test(true, 0.95).verdict, Verdict::fail);
  EXPECT_EQ(mass_test(true, 0.95).fault, Fault::mass);
  EXPECT_EQ(mass_test(false, 0.997).verdict, Verdict::fail);
}

// Rounding at a pole excuses no wrong factor, although the density of a tenth of the samples changes much there.
TEST(Rounding, WrongFactorWithAPole_Fails) {
  const double a = 0.06;
  const mc::Subject pole = make_subject(
      "pole", mc::Interval<double>(0, 1), [=](mc::Pcg& r) { return 1 - std::pow(r.uniform<double>(), 1 / a); },
      [=](double x) { return 1.05 * a * std::pow(1 - x, a - 1); });
  const mc::Report r = check_subject(pole, {.samples = 100'000});
  EXPECT_EQ(r.verdict(), Verdict::fail) << r.to_string();
}

} // namespace

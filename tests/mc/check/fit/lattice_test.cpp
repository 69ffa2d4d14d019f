#include <mc/check/fit/lattice.h>

#include <mc/check/random_subjects.h>

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>
#include <mc/domain/interval.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using checker_bench::narrow_lobe;
using mc::Fault, mc::Verdict;

// Samples of an exponential density of this width, rounded to multiples of `step`.
mc::Subject on_lattice(double width, double step) {
  return make_subject(
      "lattice", mc::Interval<double>(0, 1),
      [=](mc::Pcg& r) { return std::min(1.0, step * std::floor(-width * std::log1p(-r.uniform<double>()) / step)); },
      [=](double x) { return std::exp(-x / width) / width; });
}

TEST(Lattice, Step_IsMeasured) {
  for (const double steps : {30.0, 1e3, 1e5, 1e7}) {
    const double width = 1e-6, step = width / steps;
    const mc::Subject s = on_lattice(width, step);
    EXPECT_NEAR(lattice_step(s, draw_pilot(s, 1, 1'000'000), 0) / step, 1, 0.2) << steps;
  }
  const mc::Subject fine = on_lattice(1e-6, 1e-30);
  EXPECT_EQ(lattice_step(fine, draw_pilot(fine, 1, 1'000'000), 0), 0);
}

// Steps of 2^-52 are rounding; steps of 1e-6 are a fault of the sampler.
TEST(Lattice, OnlyStepsOfRounding_ArePartOfTheResolution) {
  const mc::Subject rounded = on_lattice(1e-10, 0x1p-52), coarse = on_lattice(1e-3, 1e-6);
  const auto resolution = [](const mc::Subject& s) {
    return with_lattices(s, draw_pilot(s, 1, 1'000'000)).resolution({1e-3, 0, 0}, 0);
  };
  EXPECT_NEAR(resolution(rounded) / 0x1p-52, 1, 0.2);
  EXPECT_LT(resolution(coarse), 1e-15);
}

// Lobes by formulas that cancel, as wide as many steps of the cosine. Each fails by chance with probability 1e-3.
TEST(Lattice, LobesWiderThanTheirSteps_Pass) {
  for (const double width : {1e-9, 1e-11, 1e-13}) {
    const mc::Report r = check_subject(narrow_lobe(false, true, width), {.samples = 200'000});
    EXPECT_EQ(r.verdict(), Verdict::pass) << r.to_string();
  }
  for (const double width : {0.25, 0.01, 1e-4}) {
    const mc::Report r = check_subject(narrow_lobe(true, false, width), {.samples = 200'000});
    EXPECT_EQ(r.verdict(), Verdict::pass) << r.to_string();
  }
}

TEST(Lattice, LobesOfFewSteps_DoNotPassAndRoundingIsNamed) {
  const mc::Report in_float = check_subject(narrow_lobe(true, false, 1e-6), {.samples = 200'000});
  EXPECT_FALSE(in_float.passed());
  EXPECT_THAT(in_float.to_string(mc::ReportText::full), testing::HasSubstr("cos theta has steps of"));
  const mc::Report in_double = check_subject(narrow_lobe(false, true, 1e-15), {.samples = 200'000});
  EXPECT_FALSE(in_double.passed());
  EXPECT_THAT(in_double.to_string(mc::ReportText::full),
              testing::AllOf(testing::HasSubstr("cos theta has steps of"), testing::Not(testing::HasSubstr("float"))));
}

// A wrong width, and a quarter of the samples at one angle.
TEST(Lattice, WrongLobes_Fail) {
  const mc::Subject lobe = narrow_lobe(false, true, 1e-9), wider = narrow_lobe(false, true, 1.05e-9);
  mc::Subject wrong = lobe, atom = lobe;
  wrong.draw = [&](std::uint64_t seed, std::size_t n, std::vector<mc::Subject::Draw>& out) {
    wider.draw(seed, n, out);
    for (mc::Subject::Draw& d : out) d.density = -1;
  };
  EXPECT_EQ(check_subject(wrong, {.samples = 200'000}).fault(), Fault::shape);
  atom.draw = [&](std::uint64_t seed, std::size_t n, std::vector<mc::Subject::Draw>& out) {
    lobe.draw(seed, n, out);
    for (std::size_t i = 0; i < out.size(); i += 3) {
      out[i].v[0] = 0.7e-9;
      out[i].density = -1;
    }
  };
  EXPECT_EQ(check_subject(atom, {.samples = 200'000}).verdict(), Verdict::fail);
}

} // namespace

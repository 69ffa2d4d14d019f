#include <mc/check/fit/unresolved_ends.h>

#include <mc/check/random_subjects.h>

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>
#include <mc/domain/interval.h>
#include <mc/domain/sphere.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using checker_bench::beta_subject, checker_bench::dirichlet_subject;
using mc::Fault, mc::Verdict;

mc::Subject power(double lo, double hi, double a) {
  return make_subject(
      "power", mc::Interval<double>(lo, hi), [=](mc::Pcg& r) { return hi - (hi - lo) * r.uniform<double>(); },
      [=](double x) { return a / (hi - lo) * std::pow((hi - x) / (hi - lo), a - 1); });
}

// The mass between 1 - 2^-46 and 1 of the density a (1 - x)^(a - 1) is 2^(-46 a); the layer is narrower.
TEST(UnresolvedEnds, PoleAtOne_HasTheMassOfItsLayer) {
  for (const double a : {0.05, 0.2, 0.5, 0.9})
    for (const double lo : {0.0, -3.0}) {
      const mc::Subject s = average_unresolved_ends(power(lo, 1, a));
      double layer = 0x1p-60;
      while (s.density({1 - 2 * layer, 0, 0}) == s.density({1 - 0x1p-53, 0, 0}) && layer < 0x1p-30) layer *= 2;
      layer *= 2;
      EXPECT_GT(layer, 0x1p-50);
      EXPECT_LT(layer, 0x1p-45);
      EXPECT_NEAR(layer * s.density({1 - 0x1p-53, 0, 0}) / std::pow(layer, a), 1, 0.1) << a << " " << lo;
      EXPECT_TRUE(std::isfinite(s.density({1, 0, 0})));
      EXPECT_EQ(s.density({0.5, 0, 0}), power(lo, 1, a).density({0.5, 0, 0}));
    }
}

TEST(UnresolvedEnds, OtherDensities_AreUnchanged) {
  const mc::Subject deep = make_subject(
      "deep", mc::Interval<double>(0, 1), [](mc::Pcg& r) { return std::pow(r.uniform<double>(), 5); },
      [](double x) { return 0.2 * std::pow(x, -0.8); });
  for (const double v : {1e-300, 1e-30, 1e-16, 1e-10})
    EXPECT_EQ(average_unresolved_ends(deep).density({v, 0, 0}), deep.density({v, 0, 0}));
  for (const double a : {1.0, 2.0, 5.0})
    for (const double v : {1 - 0x1p-53, 1 - 0x1p-50, 1.0})
      EXPECT_EQ(average_unresolved_ends(power(0, 1, a)).density({v, 0, 0}), power(0, 1, a).density({v, 0, 0}));
}

// A narrow lobe of unit vectors that are exactly the pole has no azimuth.
TEST(UnresolvedEnds, AzimuthAtPole_IsRandom) {
  const mc::Subject s = average_unresolved_ends(make_subject(
      "pole", mc::Sphere<double>(), [](mc::Pcg&) { return mc::Vec3<double>(0, 0, 1); },
      [](const mc::Vec3<double>&) { return 1.0; }));
  std::vector<mc::Subject::Draw> draws;
  s.draw(1, 100, draws);
  double sum = 0;
  for (const mc::Subject::Draw& d : draws) sum += d.v[1];
  EXPECT_NEAR(sum / 100, 0.5, 0.2);
}

// Between 5 % and 0.02 % of the samples are rounded to 1. A tenth of a percent of correct subjects fails by chance.
TEST(UnresolvedEnds, BetaAndDirichletWithPoles_PassAndWrongOnesFail) {
  for (const std::uint64_t seed : {1u, 7u}) {
    const mc::SubjectOptions options{.samples = 200'000, .seed = seed, .open_interval = true};
    for (const auto& [a, b] : {std::pair{0.2, 0.2}, {0.1, 0.1}, {2.0, 0.1}, {0.05, 0.3}, {0.5, 0.5}}) {
      const mc::Report right = check_subject(beta_subject(a, b, a, b), options);
      EXPECT_EQ(right.verdict(), Verdict::pass) << right.to_string();
      const mc::Report wrong = check_subject(beta_subject(a, b, a, b * 1.05), options);
      EXPECT_EQ(wrong.verdict(), Verdict::fail) << wrong.to_string();
      EXPECT_TRUE(wrong.fault() == Fault::shape || wrong.fault() == Fault::local) << wrong.to_string();
    }
    for (const std::array<double, 3>& a :
         {std::array{0.3, 0.5, 0.2}, {0.5, 0.2, 0.3}, {0.2, 0.3, 0.5}, {1.0, 2.0, 0.3}, {0.1, 0.1, 0.1}}) {
      const mc::Report right = check_subject(dirichlet_subject(a, a), options);
      EXPECT_EQ(right.verdict(), Verdict::pass) << right.to_string();
    }
  }
}

// A density that is 0 at the pole itself gives its many samples an infinite weight.
TEST(UnresolvedEnds, ZeroPdfOnAPole_Fails) {
  mc::Subject s = beta_subject(0.2, 0.1, 0.2, 0.1);
  const auto draw = s.draw;
  s.draw = [draw](std::uint64_t seed, std::size_t n, std::vector<mc::Subject::Draw>& out) {
    const std::size_t first = out.size();
    draw(seed, n, out);
    for (std::size_t i = first; i < out.size(); ++i)
      if (out[i].kind == mc::Subject::Draw::Kind::point && out[i].v[0] >= 1) {
        out[i].density = 0;
        out[i].pdf_positive = false;
      }
  };
  const mc::Report r = check_subject(s, {.samples = 100'000, .open_interval = true});
  EXPECT_EQ(r.fault(), Fault::zero_pdf) << r.to_string();
}

TEST(UnresolvedEnds, SamplesOnPoles_AreWarning) {
  const mc::Report r = check_subject(beta_subject(0.2, 0.2, 0.2, 0.2), {.samples = 100'000});
  ASSERT_TRUE(r.passed() && r.warning()) << r.to_string();
  EXPECT_EQ(r.warning()->fault, Fault::measure_zero);
  EXPECT_NE(r.to_string().find("pass (boundary of measure zero)"), std::string::npos) << r.to_string();
}

// The flank of a lobe falls like a pole, but its top is flat.
TEST(UnresolvedEnds, SmoothLobe_IsNotAveraged) {
  for (double width = 3e-5; width < 1e-2; width *= 2) {
    mc::Subject lobe = checker_bench::narrow_lobe(false, false, width);
    lobe.resolution = [](const mc::Subject::Coordinates&, int) { return 0x1p-24; }; // as of a float
    const mc::Subject averaged = average_unresolved_ends(lobe);
    for (double distance = 0x1p-23; distance < 0x1p-16; distance *= 1.5)
      for (const double v : {distance, 1 - distance})
        EXPECT_EQ(averaged.density({v, 0.3, 0}), lobe.density({v, 0.3, 0})) << width << " " << v;
  }
}

} // namespace

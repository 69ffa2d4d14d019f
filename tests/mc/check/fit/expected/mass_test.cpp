#include <mc/check/fit/expected/mass.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/interval.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using mc::Pcg, mc::Verdict;

mc::Subject flat(double height) {
  return make_subject(
      "flat", mc::Interval<double>(0, 1), [](Pcg& r) { return r.uniform<double>(); },
      [height](double) { return height; });
}

// The mass if no density exceeds the caps: capped and uncapped integrals are equal.
mc::ClaimedMass claimed(const mc::Subject& s, const mc::CubatureResult& c, const mc::EstimatedMass& points,
                        const mc::SampleWeights& samples) {
  return claimed_mass(s, c, points, points, samples);
}

mc::SampleWeights plain(double n) { return {.draws = n, .points = n, .sum = n, .squares = n, .total_points = n}; }

TEST(Mass, CubatureAgreesWithReference_IsUsed) {
  const mc::Subject s = flat(1);
  const mc::Pilot pilot = draw_pilot(s, 1, 100'000);
  const mc::CubatureResult c = integrate_density(s, pilot, {s, pilot, 6}, 1e5, 100'000);
  EXPECT_NEAR(c.total.value, 1, 1e-12);
  const mc::ClaimedMass m = claimed(s, c, {.value = 1, .variance = 1e-12, .variance_square = 1e-30}, plain(1e5));
  EXPECT_TRUE(m.by_cubature);
  EXPECT_EQ(test_mass(s, m, 0.02, 0.01).verdict, Verdict::pass);
}

TEST(Mass, WrongNormalization_Fails) {
  const mc::Subject s = flat(1.001);
  const mc::Pilot pilot = draw_pilot(s, 1, 100'000);
  const mc::CubatureResult c = integrate_density(s, pilot, {s, pilot, 6}, 1e5, 100'000);
  const mc::ClaimedMass m = claimed(s, c, {.value = 1.001, .variance = 1e-12, .variance_square = 1e-30}, plain(1e5));
  EXPECT_TRUE(m.by_cubature);
  EXPECT_EQ(test_mass(s, m, 0.02, 0.01).verdict, Verdict::fail);
}

// The reference contains mass that the cubature missed, so the samples decide.
TEST(Mass, CubatureContradictsSamples_IsNotUsed) {
  const mc::Subject s = flat(1);
  mc::CubatureResult c;
  c.total = {0.999, 1e-15};
  const mc::ClaimedMass m = claimed(s, c, {.value = 1, .variance = 1e-10, .variance_square = 1e-23}, plain(1e5));
  EXPECT_FALSE(m.by_cubature);
  EXPECT_EQ(m.value, 1);
  EXPECT_EQ(test_mass(s, m, 0.02, 0.01).verdict, Verdict::pass);
  const mc::ClaimedMass off = claimed(s, c, {.value = 1.001, .variance = 1e-10, .variance_square = 1e-23}, plain(1e5));
  EXPECT_EQ(test_mass(s, off, 0.02, 0.01).verdict, Verdict::fail);
}

// A tenth of the draws is clipped to almost nothing; the mass that they represent is added.
TEST(Mass, ClippedDensity_IsEstimatedFromSamples) {
  const mc::Subject s = flat(1);
  mc::CubatureResult c;
  c.total = {0.9, 1e-15};
  mc::SampleWeights w{.draws = 1e5, .points = 1e5, .sum = 9e4, .squares = 9e4, .total_points = 1e5};
  const mc::ClaimedMass m = claimed(s, c, {.value = 0.9, .variance = 1e-10, .variance_square = 1e-23}, w);
  EXPECT_NEAR(m.estimated, 1, 1e-12);
  EXPECT_FALSE(m.by_cubature);
  EXPECT_EQ(test_mass(s, m, 0.02, 0.01).verdict, Verdict::pass);
}

// A cubature that is off by 1 to 8 standard deviations of the estimate, but claims to be exact. A correct density fails
// with probability at most 1e-3 for any of these errors. For 4000 runs each, at most 13 fail with probability 0.999.
TEST(Mass, OverconfidentCubature_CorrectDensityPasses) {
  const mc::Subject s = flat(1);
  const double sigma = 1e-3;
  Pcg random(1);
  for (double off = 1; off <= 8; off += 0.5) {
    int failed = 0;
    for (int run = 0; run < 4000; ++run) {
      const double normal = std::sqrt(-2 * std::log1p(-random.uniform<double>())) *
                            std::cos(2 * mc::pi<double> * random.uniform<double>());
      mc::CubatureResult c;
      c.total = {1 - off * sigma, 1e-15};
      const mc::EstimatedMass reference{.value = 1 + sigma * normal, .variance = mc::sqr(sigma)};
      failed += test_mass(s, claimed(s, c, reference, plain(1e6)), 0.02, 0.001).verdict == Verdict::fail;
    }
    EXPECT_LE(failed, 13) << off;
  }
}

TEST(Mass, DiscreteOutcomes_AddUp) {
  mc::Subject s;
  s.atoms = {0.25, 0.75};
  const mc::ClaimedMass m = claimed(s, {}, {}, plain(1e5));
  EXPECT_EQ(m.value, 1);
  EXPECT_LE(m.error, 1e-15);
  s.atoms = {0.25, 0.74};
  EXPECT_EQ(test_mass(s, claimed(s, {}, {}, plain(1e5)), 0.02, 0.01).verdict, Verdict::fail);
}

// If the weights of the samples contradict mass 1 but the random points confirm it, the samples are wrong.
TEST(Mass, SamplesMissDensity_IsFaultOfShape) {
  mc::Subject s;
  s.dim = 2;
  mc::ClaimedMass m;
  m.by_cubature = false;
  m.value = 0.97;
  m.estimated_error = 1e-3;
  m.z = 30;
  m.from_points = 1.02;
  m.from_points_error = 0.01;
  const mc::Check shape = test_mass(s, m, 0.02, 0.01);
  EXPECT_EQ(shape.verdict, Verdict::fail);
  EXPECT_EQ(shape.fault, mc::Fault::shape);
  EXPECT_NE(shape.detail.find("from random points it integrates to 1.02 +- 0.01"), std::string::npos) << shape.detail;
  m.from_points = 0.95;
  EXPECT_EQ(test_mass(s, m, 0.02, 0.01).fault, mc::Fault::mass);
  m.from_points_error = 0.1;
  EXPECT_EQ(test_mass(s, m, 0.02, 0.01).fault, mc::Fault::mass) << "random points do not know either";
}

// Uniform outcomes with probabilities 1/n in double, a table normalised by a sum with rounding errors, and two wrong
// tables.
TEST(Mass, DiscreteOutcomes_RoundingOfTheirSumIsConceded) {
  const auto verdict = [](std::size_t n, double scale) {
    mc::Subject s;
    s.mass_tolerance = 64 * s.epsilon;
    s.atoms.assign(n, scale / static_cast<double>(n));
    return test_mass(s, claimed_mass(s, {}, {}, {}, {}), 0.02, 0.01);
  };
  for (const std::size_t n : {1, 7, 2000, 10'000, 1'000'000, 10'000'000}) {
    EXPECT_EQ(verdict(n, 1).verdict, Verdict::pass) << n;
    EXPECT_EQ(verdict(n, 1 + 0.5 * static_cast<double>(n) * 0x1p-52).verdict, Verdict::pass) << n;
    const mc::Check wrong = verdict(n, 1.001);
    EXPECT_EQ(wrong.verdict, Verdict::fail) << n;
    EXPECT_NE(wrong.detail.find("probabilities add up to 1 + 0.001"), std::string::npos) << wrong.detail;
  }
  EXPECT_EQ(verdict(100, 1 - 1e-12).verdict, Verdict::fail);
}

} // namespace

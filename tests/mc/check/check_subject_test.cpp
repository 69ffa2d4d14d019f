#include <mc/check/check_subject.h>

#include <mc/check/random_subjects.h>
#include <mc/check/subject/make_subject.h>
#include <mc/core/error.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/domain/sphere.h>
#include <mc/table/table_dist_1d.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/normal.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using V = mc::Vec3<double>;
using mc::Fault, mc::Pcg, mc::Verdict;

V cosine(Pcg& r) { return mc::CosineHemisphere<double>{}.sample(r.point<double, 2>()); }
double cosine_pdf(const V& w) { return w.z() > 0 ? w.z() / mc::pi<double> : 0.0; }

// 300 seeds at alpha = 10 %. KS on cells is conservative, so only the upper bound is strict: Binomial(300, 0.1) stays
// below 48 with probability 0.9995.
TEST(CheckSubject, CorrectDistribution_RejectedAtMostAtAlpha) {
  const mc::Subject s = make_subject("cosine", mc::Hemisphere<double>{}, cosine, cosine_pdf);
  int rejected = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const mc::Report r = check_subject(s, {.samples = 10'000, .seed = seed, .alpha = 0.1});
    EXPECT_NE(r.verdict(), Verdict::inconclusive) << r.to_string();
    rejected += r.verdict() == Verdict::fail;
  }
  EXPECT_LE(rejected, 48);
  EXPECT_GE(rejected, 8);
}

// A normal lobe of unit vectors with a standard deviation of 15 float steps. Cells as narrow as a step would count the
// steps.
TEST(CheckSubject, LobeOfFewFloatSteps_Passes) {
  using F = mc::Vec3<float>;
  const mc::Normal<double> offset(0, 9e-7);
  for (const double azimuth : {0.4, 2.0, 4.0}) {
    const V x(-std::sin(azimuth), std::cos(azimuth), 0);
    const V z = V(std::cos(azimuth), std::sin(azimuth), 0.0175).normalized(), y = mc::cross(z, x);
    const auto sampler = [=](Pcg& r) -> F {
      const double a = offset.sample(r.uniform<double>()), b = offset.sample(r.uniform<double>());
      return (z + a * x + b * y).normalized().cast<float>();
    };
    const auto pdf = [=](const F& w) {
      const V d = w.cast<double>().normalized();
      return d.dot(z) > 0 ? static_cast<float>(offset.pdf(d.dot(x)) * offset.pdf(d.dot(y))) : 0.0f;
    };
    const mc::Report r = check_subject(make_subject("few steps", mc::Sphere<float>{}, sampler, pdf), {});
    EXPECT_EQ(r.verdict(), Verdict::pass) << r.to_string();
  }
}

// A float table with one bright cell of 260 steps that contains half of a million samples. One step at its edge
// contains more samples than the tolerance of a neighbouring bin.
TEST(CheckSubject, BrightCellOfFewFloatSteps_Passes) {
  std::vector<double> weights(64'586, 1);
  weights[54'671] = 64'586;
  const mc::TableDist1D<float> table(weights);
  for (const std::uint64_t seed : {1u, 2u}) {
    const mc::Report r = check_subject(make_subject(
                                           "bright", mc::Interval<float>(), [&](float u) { return table.sample(u); },
                                           [&](float x) { return table.pdf(x); }),
                                       {.seed = seed});
    EXPECT_NE(r.verdict(), Verdict::fail) << r.to_string();
  }
}

// x^(a - 1) on (0, 1). For a = .12, a fortieth of the mass lies below 2^-44, a thousandth below 2^-83 and a millionth
// below 2^-166. The chart must resolve these coordinates near 0.
TEST(CheckSubject, DeepSingularity_Passes) {
  for (const double a : {0.12, 0.3}) {
    const auto sampler = [a](Pcg& r) { return std::pow(r.uniform<double>(), 1 / a); };
    const auto pdf = [a](double x) { return a * std::pow(x, a - 1); };
    const mc::Report right = check_subject(make_subject("power", mc::Interval<double>(0, 1), sampler, pdf), {});
    EXPECT_EQ(right.verdict(), Verdict::pass) << right.to_string();
    // Moves the lowest thousandth of the samples up to `place`.
    const double place = std::pow(1e-3, 1 / a);
    const auto cut = [=](Pcg& r) { return std::max(sampler(r), place * (1 + r.uniform<double>())); };
    const mc::Report wrong = check_subject(make_subject("cut power", mc::Interval<double>(0, 1), cut, pdf), {});
    EXPECT_EQ(wrong.verdict(), Verdict::fail) << wrong.to_string();
  }
}

// 1 / x above 1e-250: two fifths of the samples lie below 2^-500.
TEST(CheckSubject, LogUniformOverAllDoubles_Passes) {
  const double depth = 250 * std::log(10.0);
  const auto check = [depth](double exponent) {
    return check_subject(
        make_subject(
            "1 / x", mc::Interval<double>(1e-250, 1),
            [=](Pcg& r) { return std::clamp(std::exp(-depth * std::pow(r.uniform<double>(), exponent)), 1e-250, 1.0); },
            [=](double x) { return 1 / (x * depth); }),
        {.samples = 100'000, .seed = 2});
  };
  EXPECT_TRUE(check(1).passed()) << check(1).to_string();
  EXPECT_EQ(check(1.05).verdict(), Verdict::fail);
}

// At an end other than 0, points of the chart are rounded onto the end, where the density is infinite.
TEST(CheckSubject, SingularityAtNonzeroEnd_Passes) {
  for (const double lo : {0.0833, 24.7, -670.0}) {
    const mc::Interval<double> interval(lo, lo + 3);
    const auto sampler = [lo](Pcg& r) { return lo + 3 * mc::sqr(std::sin(mc::pi<double> / 2 * r.uniform<double>())); };
    const auto pdf = [lo](double x) { return 1 / (mc::pi<double> * std::sqrt((x - lo) * (lo + 3 - x))); };
    const mc::Report right = check_subject(make_subject("arcsine", interval, sampler, pdf), {.samples = 100'000});
    EXPECT_EQ(right.verdict(), Verdict::pass) << right.to_string();
    const auto half = [lo](double x) { return 0.25 / (std::sqrt(3.0) * std::sqrt(x - lo)); };
    const mc::Report wrong = check_subject(make_subject("half a root", interval, sampler, half), {.samples = 100'000});
    EXPECT_EQ(wrong.verdict(), Verdict::fail) << wrong.to_string();
  }
}

TEST(CheckSubject, SharpLobe_IsTestedAsStrictlyAsCosine) {
  // 1 - z is exponential with mean 1e-10: a lobe of 1e-5 rad.
  const double scale = 1e-10;
  const auto sampler = [scale](Pcg& r) {
    const double t = -scale * std::log1p(-r.uniform<double>()), phi = 2 * mc::pi<double> * r.uniform<double>();
    return mc::spherical_direction<double>(std::sqrt(t * (2 - t)), 1 - t, phi);
  };
  const auto pdf = [scale](const V& w) { return std::exp(-mc::one_minus_z(w) / scale) / (2 * mc::pi<double> * scale); };
  const mc::Report r =
      check_subject(make_subject("lobe", mc::Hemisphere<double>{}, sampler, pdf), {.samples = 200'000});
  EXPECT_TRUE(r.passed()) << r.to_string();
  EXPECT_NEAR(r.mass, 1, 1e-3);
}

TEST(CheckSubject, FailureRate_IsTestedAgainstMissingMass) {
  const auto sampler = [](double p) {
    return [p](Pcg& r) -> std::optional<V> {
      if (r.uniform<double>() < p) return {};
      return cosine(r);
    };
  };
  const auto pdf = [](const V& w) { return 0.9 * cosine_pdf(w); };
  const mc::Hemisphere<double> domain;
  EXPECT_TRUE(check_subject(make_subject("0.1", domain, sampler(0.1), pdf), {.samples = 100'000}).passed());
  const mc::Report wrong = check_subject(make_subject("0.11", domain, sampler(0.11), pdf), {.samples = 100'000});
  EXPECT_EQ(wrong.verdict(), Verdict::fail);
  EXPECT_EQ(wrong.fault(), Fault::failure) << wrong.to_string();
}

// A density that oscillates at scales far below the cells, which the samples do not follow.
TEST(CheckSubject, StructureFinerThanCells_Fails) {
  const auto pdf = [](double x) { return 1 + std::sin(2e7 * x) * (std::fmod(x * 1e8, 1.0) < 0.5 ? 1.0 : 0.7); };
  const mc::Subject s = make_subject(
      "rough", mc::Interval<double>(0, 1), [](Pcg& r) { return r.uniform<double>(); }, pdf);
  EXPECT_EQ(check_subject(s, {.samples = 100'000, .max_evaluations = 100'000}).verdict(), Verdict::fail);
}

TEST(CheckSubject, Report_ContainsWitnesses) {
  const auto sampler = [](Pcg& r) {
    V w = cosine(r);
    if (r.uniform<double>() < 1e-3) w = -w;
    return w;
  };
  const mc::Report r =
      check_subject(make_subject("below", mc::Hemisphere<double>{}, sampler, cosine_pdf), {.samples = 10'000});
  EXPECT_EQ(r.fault(), Fault::outside);
  EXPECT_THAT(r.to_string(), testing::ContainsRegex("domain, at u = .0[^)]*., x = "));
}

// An azimuth of 2 * 3.14 u leaves a gap at the end of the turn. A clamp leaves a gap at an end of u, a skipped interval
// leaves a gap inside. The gaps are narrower than cells, and both the pilot and the samples leave them empty. A correct
// density with the same support passes.
TEST(CheckSubject, GapsInsideAndAtEnds_Fail) {
  const mc::Interval<double> unit(0, 1);
  const auto gap = [&](double lo, double hi, bool claimed) {
    const double width = hi - lo;
    const auto sampler = [=](Pcg& r) {
      const double x = (1 - width) * r.uniform<double>();
      return x < lo ? x : x + width;
    };
    const auto pdf = [=](double x) {
      if (!claimed) return 1.0;
      return x >= lo && x < hi ? 0.0 : 1 / (1 - width);
    };
    return check_subject(make_subject("gap", unit, sampler, pdf), {.samples = 200'000, .seed = 3, .alpha = 1e-3});
  };
  for (const auto& [lo, hi] : {std::pair(0.0, 1e-3), std::pair(0.4, 0.401), std::pair(0.999, 1.0)}) {
    const mc::Report wrong = gap(lo, hi, false), right = gap(lo, hi, true);
    EXPECT_EQ(wrong.verdict(), Verdict::fail) << lo;
    const auto check =
        std::find_if(wrong.checks.begin(), wrong.checks.end(), [](const mc::Check& c) { return c.name == "no gaps"; });
    ASSERT_NE(check, wrong.checks.end());
    EXPECT_EQ(check->verdict, Verdict::fail) << wrong.to_string();
    EXPECT_LE(check->statistic, 20) << "of 200 expected"; // some samples lie at the edges that the pilot determined
    EXPECT_TRUE(right.passed()) << right.to_string();
  }
}

// 800 float steps contain 95 of a million expected samples.
TEST(CheckSubject, GapOfFewHundredFloatSteps_Fails) {
  const auto skip = [](float width) {
    const auto sampler = [width](Pcg& r) {
      for (;;)
        if (const float x = r.uniform<float>(); x < 0.3f || x >= 0.3f + width) return x;
    };
    return check_subject(make_subject("skip", mc::Interval<float>(0, 1), sampler, [](float) { return 1.0f; }), {});
  };
  EXPECT_TRUE(skip(0).passed()) << skip(0).to_string();
  EXPECT_EQ(skip(800 * 0x1p-23f).verdict(), Verdict::fail);
}

// A normal cut at 3.5 sigma lacks 23 of 100000 samples at each end, which chance does not explain. The density falls
// towards the ends, so an extrapolation of the neighbouring samples would expect more.
TEST(CheckSubject, TruncatedTail_IsGap) {
  const mc::Normal<double> normal;
  const auto cut_at = [&](double most) {
    const auto sampler = [=](Pcg& r) {
      double x = normal.sample(r.uniform<double>());
      while (!(std::abs(x) < most)) x = normal.sample(r.uniform<double>());
      return x;
    };
    const auto pdf = [=](double x) { return normal.pdf(x); };
    return check_subject(make_subject("cut", mc::RealLine<double>(0, 1), sampler, pdf),
                         {.samples = 100'000, .seed = 5});
  };
  EXPECT_TRUE(cut_at(9).passed()) << cut_at(9).to_string();
  const mc::Report r = cut_at(3.5);
  EXPECT_EQ(r.verdict(), Verdict::fail);
  EXPECT_THAT(r.to_string(mc::ReportText::full), testing::ContainsRegex("contains 0 samples, .* expected"));
}

TEST(CheckSubject, DiscreteOutcomes_AreTested) {
  mc::Subject s;
  s.name = "coin";
  s.atoms = {0.5, 0.5};
  const auto coin = [](double p) {
    return [p](std::uint64_t seed, std::size_t n, std::vector<mc::Subject::Draw>& out) {
      Pcg random(seed);
      for (std::size_t i = 0; i < n; ++i) {
        mc::Subject::Draw d;
        d.kind = mc::Subject::Draw::Kind::atom;
        d.atom = random.uniform<double>() < p ? 0 : 1;
        out.push_back(d);
      }
    };
  };
  s.draw = coin(0.5);
  EXPECT_TRUE(check_subject(s, {.samples = 100'000}).passed());
  s.draw = coin(0.51);
  EXPECT_EQ(check_subject(s, {.samples = 100'000}).verdict(), Verdict::fail);
  s.draw = coin(0.5);
  s.atoms = {0.5, 0.5, 0.01};
  EXPECT_EQ(check_subject(s, {.samples = 100'000}).fault(), Fault::mass);
}

TEST(CheckSubject, SamplesToDetect_AreSufficient) {
  const std::uint64_t n = mc::samples_to_detect(0.05, 0.001, 2);
  const mc::Report r =
      check_subject(make_subject("cosine", mc::Hemisphere<double>{}, cosine, cosine_pdf), {.samples = n});
  EXPECT_LE(r.detectable, 0.0525);
  EXPECT_GE(r.detectable, 0.04);
  EXPECT_GT(mc::samples_to_detect(0.05, 0.001), n);
  EXPECT_THROW(mc::samples_to_detect(0, 0.01), mc::Error);
}

TEST(CheckSubject, SameSeed_SameReport) {
  const mc::Subject s = make_subject("cosine", mc::Hemisphere<double>{}, cosine, cosine_pdf);
  EXPECT_EQ(check_subject(s, {.samples = 5000}).p(), check_subject(s, {.samples = 5000}).p());
}

TEST(CheckSubject, InvalidOptions_Throw) {
  const mc::Subject s = make_subject("cosine", mc::Hemisphere<double>{}, cosine, cosine_pdf);
  EXPECT_THROW(check_subject(s, {.samples = 10}), mc::Error);
  EXPECT_THROW(check_subject(s, {.alpha = 2}), mc::Error);
}

TEST(CheckSubject, PlotData_HasAllCountsAndPValues) {
  const mc::Subject s = make_subject("cosine", mc::Hemisphere<double>{}, cosine, cosine_pdf);
  const mc::Report plain = check_subject(s, {.samples = 50'000}),
                   r = check_subject(s, {.samples = 50'000, .evidence = true});
  EXPECT_FALSE(plain.evidence);
  ASSERT_TRUE(r.evidence);
  EXPECT_EQ(plain.to_string(), r.to_string());
  EXPECT_EQ(plain.axes.size(), 2u);
  double observed = 0, expected = 0, volume = 0;
  for (const mc::CellCount& c : r.evidence->cells) {
    observed += c.observed;
    expected += c.expected;
    volume += (c.hi[0] - c.lo[0]) * (c.hi[1] - c.lo[1]);
  }
  EXPECT_EQ(observed, 50'000);
  EXPECT_NEAR(expected, 50'000, 1e-3);
  EXPECT_NEAR(volume, 1, 1e-12);
  ASSERT_EQ(r.evidence->p_after.size(), 7u); // 1024, ..., 32768, all
  EXPECT_EQ(r.evidence->p_after[5].samples, 32768u);
  EXPECT_EQ(r.evidence->p_after.back().samples, 50'000u);
  EXPECT_EQ(r.evidence->p_after.back().p, r.p());
  // A prefix of 32768 samples gives the p-value of a run of 32768 samples, except for the pilot's size and thus the
  // cells.
  for (const auto& [samples, p] : r.evidence->p_after) EXPECT_GT(p, 0.001) << samples;
}

TEST(CheckSubject, PlotData_WrongSamples_PValueFalls) {
  const auto skewed = [](Pcg& r) {
    const double z = std::pow(r.uniform<double>(), 1 / 2.1), phi = 2 * mc::pi<double> * r.uniform<double>();
    return mc::spherical_direction<double>(std::sqrt(1 - z * z), z, phi);
  };
  const mc::Report r = check_subject(make_subject("exponent", mc::Hemisphere<double>{}, skewed, cosine_pdf),
                                     {.samples = 1 << 17, .evidence = true});
  EXPECT_EQ(r.verdict(), Verdict::fail);
  EXPECT_GT(r.evidence->p_after.front().p, 1e-3);
  EXPECT_LT(r.evidence->p_after.back().p, 1e-9);
}

TEST(CheckSubject, PlotData_HasDiscreteOutcomes) {
  mc::Subject s;
  s.name = "coin";
  s.atoms = {0.5, 0.5};
  s.draw = [](std::uint64_t seed, std::size_t n, std::vector<mc::Subject::Draw>& out) {
    Pcg random(seed);
    for (std::size_t i = 0; i < n; ++i) {
      out.emplace_back().kind = mc::Subject::Draw::Kind::atom;
      out.back().atom = random.uniform<double>() < 0.55;
    }
  };
  const mc::Report r = check_subject(s, {.samples = 10'000, .evidence = true});
  EXPECT_EQ(r.verdict(), Verdict::fail);
  ASSERT_EQ(r.evidence->outcomes.size(), 2u);
  EXPECT_EQ(r.evidence->outcomes[0].observed + r.evidence->outcomes[1].observed, 10'000);
  EXPECT_EQ(r.evidence->outcomes[1].expected, 5000);
  EXPECT_THAT(r.to_string(), testing::HasSubstr(": outcome 0 has 4"));
}

// Exactly right densities, whose integral neither cubature nor random points give exactly, with wrong samples.
TEST(CheckSubject, WrongSamplesOfRightDensity_AreNoFaultOfMass) {
  using checker_bench::beta_subject, checker_bench::dirichlet_subject;
  const std::array<double, 3> a{0.3, 0.5, 0.2};
  mc::Subject lobe = checker_bench::narrow_lobe(false, true, 1e-9);
  lobe.draw = [wider = checker_bench::narrow_lobe(false, true, 3e-9)](std::uint64_t seed, std::size_t n,
                                                                      std::vector<mc::Subject::Draw>& out) {
    wider.draw(seed, n, out);
    for (mc::Subject::Draw& d : out) d.density = -1;
  };
  std::vector<mc::Subject> wrong{beta_subject(0.5, 0.5, 0.6, 0.6), beta_subject(0.5, 0.5, 0.5, 0.51),
                                 beta_subject(0.2, 0.2, 0.3, 0.3), lobe};
  for (const std::array<double, 3>& sampled :
       {std::array{0.5, 0.3, 0.2}, {0.3, 0.5, 0.21}, {1.0, 1.0, 1.0}, {0.31, 0.5, 0.2}, {0.2, 0.2, 0.2}})
    wrong.push_back(dirichlet_subject(a, sampled));
  for (const mc::Subject& s : wrong) {
    const mc::Report r = check_subject(s, {.samples = 200'000, .open_interval = true});
    EXPECT_EQ(r.verdict(), Verdict::fail) << r.to_string(mc::ReportText::full);
    for (const mc::Check& c : r.checks) EXPECT_FALSE(c.verdict == Verdict::fail && c.fault == Fault::mass) << c.detail;
  }
}

// Right samples and a density with a factor.
TEST(CheckSubject, ScaledDensityWithPole_IsFaultOfMass) {
  for (const double factor : {0.9, 1.1}) {
    mc::Subject s = checker_bench::beta_subject(0.2, 0.3, 0.2, 0.3);
    s.density = [factor, right = s.density](const mc::Subject::Coordinates& v) { return factor * right(v); };
    s.draw = [draw = s.draw](std::uint64_t seed, std::size_t n, std::vector<mc::Subject::Draw>& out) {
      draw(seed, n, out);
      for (mc::Subject::Draw& d : out) d.density = -1;
    };
    const mc::Report r = check_subject(s, {.samples = 200'000, .open_interval = true});
    EXPECT_EQ(r.fault(), Fault::mass) << r.to_string();
  }
}

// A cosine lobe of a wrong exponent: theta is wrong, phi is exactly uniform.
TEST(CheckSubject, WrongPolarAngle_FailsNoTestOfTheAzimuth) {
  const auto sampler = [](Pcg& r) {
    const double z = std::pow(r.uniform<double>(), 1 / 2.5), phi = 2 * mc::pi<double> * r.uniform<double>();
    const double s = std::sqrt(1 - z * z);
    return V(s * std::cos(phi), s * std::sin(phi), z);
  };
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const mc::Report r = check_subject(make_subject("exponent", mc::Hemisphere<double>{}, sampler, cosine_pdf),
                                       {.samples = 300'000, .seed = seed});
    EXPECT_EQ(r.fault(), Fault::shape);
    for (const mc::Check& c : r.checks) {
      const bool of_azimuth = c.name == "KS, phi" || c.name == "tails, phi" || c.name == "correlation, theta and phi";
      EXPECT_FALSE(of_azimuth && c.verdict != Verdict::pass) << c.name << ": " << c.detail;
    }
  }
}

} // namespace

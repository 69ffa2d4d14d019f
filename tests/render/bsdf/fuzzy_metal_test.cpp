#include <render/bsdf/fuzzy_metal.h>

#include <mc/check/bsdf_laws.h>
#include <mc/check/laws/bsdf/roughness_limit.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

Vec3 at_angle(double degrees) {
  const double theta = degrees * mc::pi<double> / 180;
  return Vec3d(std::sin(theta), 0, std::cos(theta)).cast<Float>();
}

TEST(FuzzyMetal, WithoutFuzzIsAMirror) {
  const FuzzyMetal mirror{Spectrum::Constant(Float(0.8)), 0};
  EXPECT_TRUE(mirror.lobes().is_delta());
  for (const double angle : {0.0, 60.0, 89.9, 120.0}) {
    const Vec3 wo = at_angle(angle);
    const auto s = mirror.sample(wo, Float(0.3), Vec2(Float(0.1), Float(0.7)));
    ASSERT_TRUE(s.has_value());
    EXPECT_TRUE(s->delta);
    EXPECT_EQ(s->wi, Vec3(-wo.x(), -wo.y(), wo.z()));
    EXPECT_NEAR(s->f[0] * std::abs(s->wi.z()) / s->pdf, 0.8, 1e-6);
    EXPECT_EQ(mirror.pdf(wo, s->wi), 0);
    EXPECT_TRUE((mirror.eval(wo, s->wi) == 0).all());
  }
}

// The closed-form density against samples, in eight cases at alpha = 1e-5. Absorbed samples are the density's deficit
// to 1.
TEST(FuzzyMetal, SamplesFollowTheChordDensity) {
  for (const double fuzz : {0.1, 1.0})
    for (const double angle : {0.0, 60.0, 85.0, 120.0}) {
      const FuzzyMetal metal{Spectrum::Constant(Float(0.9)), Float(fuzz)};
      const auto report = mc::check_bsdf<Float>(
          metal, at_angle(angle),
          {.statistics = {.samples = 50'000, .alpha = 1e-5}, .reciprocal = false, .mass_tolerance = 1e-4});
      EXPECT_TRUE(report.passed()) << "fuzz " << fuzz << ", " << angle << " degrees\n" << report.to_string();
    }
}

TEST(FuzzyMetal, TendsToTheMirrorAsFuzzVanishes) {
  const auto metal = [](Float fuzz) { return FuzzyMetal{Spectrum::Constant(Float(0.9)), fuzz}; };
  for (const double angle : {0.0, 60.0, 85.0, 120.0})
    for (const mc::Check& c : mc::check_roughness_limit<Float>(metal, metal(0), at_angle(angle)))
      EXPECT_EQ(c.verdict, mc::Verdict::pass) << c.name << ": " << c.detail;
}

// Shares of samples below the surface, as measured with the book's code ([Shirley16], ch. 10). 4e5 samples: 5 standard
// errors are below .004.
TEST(FuzzyMetal, AbsorbsDirectionsBelowSurface) {
  struct Row {
    double fuzz, angle, below;
  };
  for (const Row& row : {Row{1, 45, .058}, {1, 75, .310}, {1, 85, .435}, {.3, 75, .014}, {.3, 85, .288}}) {
    const FuzzyMetal metal{Spectrum::Ones(), Float(row.fuzz)};
    mc::Pcg random(5);
    const int n = 400'000;
    int absorbed = 0;
    for (int i = 0; i < n; ++i) {
      const Float uc = random.uniform<Float>();
      absorbed += !metal.sample(at_angle(row.angle), uc, random.point<Float, 2>());
    }
    EXPECT_NEAR(double(absorbed) / n, row.below, 0.004 + 0.0005) << row.fuzz << " at " << row.angle;
  }
}

TEST(FuzzyMetal, RefusesNonsense) {
  for (const Float bad : {Float(-0.1), Float(1.1), std::numeric_limits<Float>::quiet_NaN()}) {
    EXPECT_THROW(FuzzyMetal(Spectrum(1, bad, 1)), mc::Error);
    EXPECT_THROW(FuzzyMetal(Spectrum::Ones(), bad), mc::Error);
  }
}

TEST(FuzzyMetal, IsFiniteAtTheEdgesOfTheUnitCube) {
  const Float top = mc::one_minus_epsilon<Float>;
  for (const Float fuzz : {Float(1e-3), Float(1)})
    for (const double angle : {0.0, 89.99, 179.0})
      for (const Float a : {Float(0), top})
        for (const Float b : {Float(0), top})
          for (const Float c : {Float(0), top})
            if (const auto s = FuzzyMetal{Spectrum::Ones(), fuzz}.sample(at_angle(angle), a, Vec2(b, c))) {
              EXPECT_TRUE(s->wi.allFinite() && s->f.isFinite().all()) << fuzz << ", " << angle;
              EXPECT_GT(s->pdf, 0);
              EXPECT_LE(s->pdf, std::numeric_limits<Float>::max());
            }
}

} // namespace

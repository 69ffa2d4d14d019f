#include <mc/gtest/matchers.h>

#include <mc/domain/interval.h>
#include <mc/warp/disk.h>
#include <mc/warp/hemisphere.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace {

using testing::HasSubstr;

TEST(Matchers, WarpLaws) {
  EXPECT_WARP_LAWS(mc::UniformDisk<double>{});
  mc::LawOptions few;
  few.statistics.samples = 20'000;
  EXPECT_WARP_LAWS(mc::CosineHemisphere<float>{}, few);
}

TEST(Matchers, Distribution_NamesTheGeneratorAndItsFinding) {
  const std::exponential_distribution<double> mine(1.05);
  const auto pdf = [](double x) { return std::exp(-x); };
  EXPECT_DISTRIBUTION(std::exponential_distribution<double>(), pdf, {.samples = 50'000});
  const testing::AssertionResult wrong = mc::has_law("mine", mine, pdf, {.samples = 50'000});
  EXPECT_FALSE(wrong);
  EXPECT_THAT(wrong.message(), HasSubstr("mine: fail"));
}

// A grey diffuse BSDF with the given albedo. Its samples state the value for `stated`, which is wrong if it differs.
struct Grey {
  struct Sample {
    mc::Vec3<double> wi;
    double f, pdf;
  };
  double albedo, stated;
  double eval(const mc::Vec3<double>& wo, const mc::Vec3<double>& wi) const {
    return wo.z() > 0 && wi.z() > 0 ? albedo / mc::pi<double> : 0;
  }
  double pdf(const mc::Vec3<double>& wo, const mc::Vec3<double>& wi) const {
    return wo.z() > 0 && wi.z() > 0 ? wi.z() / mc::pi<double> : 0;
  }
  std::optional<Sample> sample(const mc::Vec3<double>& wo, const mc::Vec2<double>& u) const {
    const mc::Vec3<double> wi = mc::CosineHemisphere<double>{}.sample(u);
    return Sample{wi, stated / mc::pi<double>, pdf(wo, wi)};
  }
};

TEST(Matchers, BsdfLaws) {
  const mc::Vec3<double> wo(0.6, 0, 0.8);
  const mc::BsdfOptions few{.statistics = {.samples = 20'000}};
  EXPECT_BSDF_LAWS((Grey{0.5, 0.5}), wo, few);
  EXPECT_THAT(mc::obeys_bsdf_laws("grey", Grey{0.5, 0.6}, wo, few).message(),
              testing::AllOf(testing::StartsWith("grey, wo = (0.6, 0, 0.8): fail: f is 0.19"),
                             HasSubstr(", should be 0.159"), HasSubstr(", at u = ("), HasSubstr("likely cause: weight"),
                             HasSubstr("law: weight = f / pdf")));
  EXPECT_THAT(mc::obeys_bsdf_laws("grey", Grey{1.1, 1.1}, wo, few).message(), HasSubstr("energy <= 1"));
}

// The same grey as renderers write it that return f |cos wi|, with the weight f |cos wi| / pdf.
struct GreyWithCosine : Grey {
  struct Sample {
    mc::Vec3<double> wi;
    double weight, pdf;
  };
  double eval(const mc::Vec3<double>& wo, const mc::Vec3<double>& wi) const {
    return Grey::eval(wo, wi) * std::abs(wi.z());
  }
  std::optional<Sample> sample(const mc::Vec3<double>& wo, const mc::Vec2<double>& u) const {
    const mc::Vec3<double> wi = mc::CosineHemisphere<double>{}.sample(u);
    return Sample{wi, albedo, pdf(wo, wi)};
  }
};

// As docs/methods/bsdf-conventions.md advises.
TEST(Matchers, ABsdfWithTheCosine_PassesWithItsOptionsAndIsRecognisedWithout) {
  const mc::Vec3<double> wo(0.6, 0, 0.8);
  const GreyWithCosine grey{{0.5, 0.5}};
  EXPECT_BSDF_LAWS(grey, wo, {.statistics = {.samples = 20'000}, .reciprocal = false, .cosine = false});
  const mc::BsdfOptions few{.statistics = {.samples = 20'000}};
  EXPECT_THAT(mc::obeys_bsdf_laws("grey", grey, wo, few).message(),
              testing::AllOf(testing::ContainsRegex("fail: weight is 0.5, should be 0[.][0-9]+, at u = "),
                             HasSubstr("eval seems to include it: set .cosine = false")));
  EXPECT_BSDF_LAWS(grey, wo, {.statistics = {.samples = 20'000}, .cosine = false});
}

TEST(Matchers, DirectionOfWrongLength_FailsWithItsLength) {
  const mc::Vec3<double> wo(1, 0, 1);
  EXPECT_THAT(mc::obeys_bsdf_laws("grey", Grey{0.5, 0.5}, wo, {.statistics = {.samples = 20'000}}).message(),
              HasSubstr("wo = (1, 0, 1) has length 1.41421356, should be 1"));
}

TEST(Matchers, SamplesMatchPdf) {
  const auto sampler = [](mc::Pcg& r) { return std::sqrt(1 - r.uniform<double>()); };
  const mc::SubjectOptions few{.samples = 50'000};
  EXPECT_SAMPLES_MATCH_PDF(
      sampler, [](double x) { return 2 * x; }, mc::Interval<double>(0, 1), few);
  const testing::AssertionResult wrong = mc::samples_match_pdf(
      "sampler", sampler, [](double x) { return 3 * x * x; }, mc::Interval<double>(0, 1), few);
  EXPECT_FALSE(wrong);
  EXPECT_THAT(
      wrong.message(),
      testing::AllOf(testing::StartsWith("sampler: fail, p < 1e-300 (50000 samples, alpha 0.001): region x 0 to "),
                     HasSubstr(" expected (z = "), HasSubstr("likely cause: shape"), HasSubstr(" more checks fail")));
}

TEST(Matchers, Mean) {
  mc::Pcg random(8);
  std::vector<float> u(10'000);
  for (float& x : u) x = random.uniform<float>();
  EXPECT_MEAN(u, 0.5);
  const testing::AssertionResult wrong = mc::has_mean("u", u, 0.52);
  EXPECT_FALSE(wrong);
  EXPECT_THAT(wrong.message(), testing::AllOf(testing::StartsWith("mean of u is 0."), HasSubstr("should be 0.52"),
                                              HasSubstr("standard errors off")));
  EXPECT_THAT(mc::has_mean("x", std::vector<double>{1, std::nan("")}, 0).message(), HasSubstr("not finite"));
}

} // namespace

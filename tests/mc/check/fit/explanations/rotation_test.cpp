#include <mc/check/fit/explanations/rotation.h>

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>
#include <mc/domain/hemisphere.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using V = mc::Vec3<double>;
using mc::Fault, mc::Pcg;

// Density z / pi * (1 + 0.8 cos phi) [1/sr], sampled with phi rotated by `degrees`.
mc::Subject bent_cosine(double degrees, double bend = 0.8) {
  const auto sampler = [=](Pcg& r) {
    for (;;) {
      const double u = r.uniform<double>(), phi = 2 * mc::pi<double> * r.uniform<double>();
      if (r.uniform<double>() * 1.8 > 1 + bend * std::cos(phi)) continue;
      const double turned = phi + degrees * mc::pi<double> / 180;
      return mc::spherical_direction<double>(std::sqrt(u), std::sqrt(1 - u), turned);
    }
  };
  const auto pdf = [](const V& w) {
    return w.z() > 0 ? w.z() / mc::pi<double> * (1 + 0.8 * w.x() / std::hypot(w.x(), w.y())) : 0.0;
  };
  return make_subject("bent cosine", mc::Hemisphere<double>{}, sampler, pdf);
}

TEST(FindRotation, SmallAndLargeRotations_AreFound) {
  for (const double degrees : {2.0, -3.0, 40.0, 90.0, -110.0, 180.0}) {
    const mc::Report r = check_subject(bent_cosine(degrees), {.samples = 200'000});
    EXPECT_EQ(r.fault(), Fault::rotation) << degrees << r.to_string();
    const std::string text = r.to_string(), words = "the samples seem rotated by ";
    const std::size_t at = text.find(words);
    ASSERT_NE(at, std::string::npos) << text;
    const double found = std::stod(text.substr(at + words.size()));
    // The standard error of the score is 0.3 degrees here. The search of large rotations resolves 0.2 degrees and uses
    // an eighth of the samples.
    EXPECT_LE(std::abs(std::remainder(found - degrees, 360)), 2.5) << degrees << text;
  }
}

TEST(FindRotation, OtherShape_IsNoRotation) {
  const mc::Report r = check_subject(bent_cosine(0, 0.6), {.samples = 200'000});
  EXPECT_EQ(r.fault(), Fault::shape) << r.to_string();
  EXPECT_TRUE(check_subject(bent_cosine(0), {.samples = 200'000}).passed());
}

// No rotation changes this density, so no rotation explains the wrong samples.
TEST(FindRotation, RotationallySymmetricDensity_HasNoRotation) {
  for (const double exponent : {0.8, 1.1, 1.5}) {
    const auto sampler = [exponent](Pcg& r) {
      const double z = std::pow(r.uniform<double>(), 1 / (1 + exponent)),
                   phi = 2 * mc::pi<double> * r.uniform<double>();
      return mc::spherical_direction<double>(std::sqrt(1 - z * z), z, phi);
    };
    const auto pdf = [](const V& w) { return w.z() > 0 ? w.z() / mc::pi<double> : 0.0; };
    const mc::Subject s = make_subject("round", mc::Hemisphere<double>{}, sampler, pdf);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const mc::Report r = check_subject(s, {.samples = 60'000, .seed = seed});
      EXPECT_EQ(r.verdict(), mc::Verdict::fail);
      EXPECT_NE(r.fault(), Fault::rotation) << r.to_string();
    }
  }
}

} // namespace

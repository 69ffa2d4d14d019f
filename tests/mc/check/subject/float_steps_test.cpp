#include <mc/check/subject/float_steps.h>

#include <mc/check/laws.h>
#include <mc/domain/hemisphere.h>
#include <mc/warp/blinn_phong.h>
#include <mc/warp/disk.h>
#include <mc/warp/hemisphere.h>

#include <gmock/gmock.h>

namespace {

using testing::HasSubstr;

// A lobe cos^n about +z from the cosine itself, which a float cannot tell from 1 where n is large.
template <class S> auto lobe_from_cosine(S n) {
  return mc::make_sampler(
      "lobe", mc::Hemisphere<S>(),
      [n](const mc::Vec2<S>& u) {
        const S z = std::pow(S(1) - u[0], 1 / (n + 1)), phi = 2 * mc::pi<S> * u[1];
        const S r = std::sqrt(std::max(S(0), 1 - z * z));
        return mc::Vec3<S>(r * std::cos(phi), r * std::sin(phi), z);
      },
      [n](const mc::Vec3<S>& w) { return (n + 1) / (2 * mc::pi<S>)*std::pow(w.z(), n); });
}

TEST(FloatSteps, ANarrowLobeFromAFloatCosineIsTold) {
  EXPECT_EQ(mc::float_steps(lobe_from_cosine(1e6f), 1),
            "cos theta comes in steps of a float; compute 1 - cos theta instead");
  EXPECT_EQ(mc::float_steps(lobe_from_cosine(1e6), 1), "");
  const mc::Report report = check_laws(lobe_from_cosine(1e6f), {.samples = 100'000});
  EXPECT_EQ(report.verdict(), mc::Verdict::fail);
  EXPECT_THAT(report.to_string(), HasSubstr("cos theta comes in steps of a float"));
}

TEST(FloatSteps, AnAngleInFloatWithinDoublesIsTold) {
  const auto disk = [](auto angle) {
    return mc::make_sampler(
        "disk", mc::Disk<double>(),
        [angle](const mc::Vec2<double>& u) {
          const double phi = angle(u[1]), r = std::sqrt(u[0]);
          return mc::Vec2<double>(r * std::cos(phi), r * std::sin(phi));
        },
        [](const mc::Vec2<double>&) { return 1 / mc::pi<double>; });
  };
  EXPECT_THAT(mc::float_steps(disk([](double u) { return double(float(2 * mc::pi<double> * u)); }), 1),
              HasSubstr("phi comes in steps of a float; compute it in double"));
  EXPECT_EQ(mc::float_steps(disk([](double u) { return 2 * mc::pi<double> * u; }), 1), "");
}

TEST(FloatSteps, WhatComputesInItsOwnScalarIsSilent) {
  EXPECT_EQ(mc::float_steps(mc::make_sampler("cosine", mc::CosineHemisphere<float>()), 1), "");
  EXPECT_EQ(mc::float_steps(mc::make_sampler("cosine", mc::CosineHemisphere<double>()), 1), "");
  EXPECT_EQ(mc::float_steps(mc::make_sampler("disk", mc::UniformDisk<float>()), 1), "");
}

} // namespace

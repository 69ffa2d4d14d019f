// A BSDF of your own: Lambert's law with a coloured albedo, and the same with a forgotten cosine in the density.
#include <mc/gtest/matchers.h>
#include <mc/warp/hemisphere.h>

#include <optional>

using Vec = mc::Vec3<double>; // an Eigen vector; <Eigen/Geometry> has a.cross(b) and unitOrthogonal()
using Color = Eigen::Array3d;

struct Lambert {
  Color albedo;

  struct Sample {
    Vec wi;
    Color f;
    double pdf;
  };
  // f without the cosine; wo and wi leave the surface, whose normal is z.
  Color eval(const Vec&, const Vec& wi) const { return wi.z() > 0 ? Color(albedo / mc::pi<double>) : Color::Zero(); }
  double pdf(const Vec&, const Vec& wi) const { return mc::CosineHemisphere<double>().pdf(wi); }
  std::optional<Sample> sample(const Vec& wo, const mc::Vec2<double>& u) const {
    const Vec wi = mc::CosineHemisphere<double>().sample(u);
    return Sample{wi, eval(wo, wi), pdf(wo, wi)};
  }
};

struct UniformPdf : Lambert {
  double pdf(const Vec&, const Vec& wi) const { return mc::UniformHemisphere<double>().pdf(wi); }
};

const Vec wo(0.6, 0, 0.8);
const Lambert lambert{Color(0.8, 0.5, 0.2)};

TEST(Lambert, ObeysItsLaws) { EXPECT_BSDF_LAWS(lambert, wo); }

TEST(Lambert, WrongDensityIsFound) {
  const mc::Report report = mc::check_bsdf<double>(UniformPdf{lambert}, wo);
  EXPECT_EQ(report.verdict(), mc::Verdict::fail) << report;
}

TEST(Lambert, MoreLightThanArrivesIsFound) {
  const mc::Report report = mc::check_bsdf<double>(Lambert{Color(0.8, 1.1, 0.2)}, wo);
  EXPECT_EQ(report.fault(), mc::Fault::physics) << report;
}

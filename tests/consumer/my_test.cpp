#include <mc/gtest/matchers.h>
#include <mc/warp/hemisphere.h>

// The normal is z; wo and wi leave the surface, above it.
struct MyBsdf {
  struct Sample {
    mc::Vec3<float> wi;
    float f, pdf;
  };
  float eval(const mc::Vec3<float>&, const mc::Vec3<float>& wi) const { return wi.z() > 0 ? 0.5f / mc::pi<float> : 0; }
  float pdf(const mc::Vec3<float>&, const mc::Vec3<float>& wi) const { return mc::CosineHemisphere<float>().pdf(wi); }
  std::optional<Sample> sample(const mc::Vec3<float>& wo, const mc::Vec2<float>& u) const {
    const mc::Vec3<float> wi = mc::CosineHemisphere<float>().sample(u);
    return Sample{wi, eval(wo, wi), pdf(wo, wi)};
  }
};
TEST(MyBsdf, IsRight) { EXPECT_BSDF_LAWS(MyBsdf(), mc::Vec3<float>(0.6f, 0, 0.8f)); }

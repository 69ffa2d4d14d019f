#include <mc/gtest/matchers.h>
#include <mc/warp/hemisphere.h>

// Local frame: z is the normal, wo and wi leave the surface. Half of the light, the same in all directions.
struct MyBsdf {
  using W = mc::Vec3<float>;
  struct Sample {
    W wi;
    float f, pdf;
  };
  float eval(const W& wo, const W& wi) const { return wo.z() * wi.z() > 0 ? 0.5f / mc::pi<float> : 0; }
  float pdf(const W& wo, const W& wi) const { return wo.z() * wi.z() > 0 ? std::abs(wi.z()) / mc::pi<float> : 0; }
  std::optional<Sample> sample(const W& wo, const mc::Vec2<float>& u) const {
    W wi = mc::CosineHemisphere<float>().sample(u);
    if (wo.z() < 0) wi.z() = -wi.z();
    return Sample{wi, eval(wo, wi), pdf(wo, wi)};
  }
};

TEST(MyBsdf, IsRight) { EXPECT_BSDF_LAWS(MyBsdf(), mc::Vec3<float>(0.6f, 0, 0.8f)); }

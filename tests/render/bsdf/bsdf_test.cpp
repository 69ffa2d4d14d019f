#include <render/bsdf/bsdf.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

static_assert(BsdfLike<Lambert> && BsdfLike<Metal> && BsdfLike<Dielectric> && BsdfLike<RoughPlastic> &&
              BsdfLike<RoughDielectric> && BsdfLike<RoughConductor<Microfacets>> &&
              BsdfLike<RoughConductor<BlinnPhongFacets>> && BsdfLike<Bsdf>);

TEST(Bsdf, SaysWhatItsMemberSays) {
  const Metal metal{Spectrum::Constant(Float(0.7)), Float(0.5)};
  const Bsdf bsdf = metal;
  const Vec3 wo = Vec3(1, 0, 2).normalized(), wi = Vec3(-1, Float(0.1), 2).normalized();
  const Vec2 u(Float(0.2), Float(0.6));
  EXPECT_EQ(bsdf.pdf(wo, wi), metal.pdf(wo, wi));
  EXPECT_TRUE((bsdf.eval(wo, wi) == metal.eval(wo, wi)).all());
  EXPECT_EQ(bsdf.sample(wo, Float(0.5), u)->wi, metal.sample(wo, Float(0.5), u)->wi);
  EXPECT_FALSE(bsdf.is_delta());
  EXPECT_TRUE(Bsdf(Dielectric{}).is_delta());
  EXPECT_TRUE(Bsdf(Metal{}).is_delta());
  EXPECT_FALSE(Bsdf(Lambert{}).is_delta());
}

} // namespace

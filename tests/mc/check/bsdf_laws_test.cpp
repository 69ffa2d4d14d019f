#include <mc/check/bsdf_laws.h>

#include <mc/warp/hemisphere.h>

#include <gtest/gtest.h>

#include <optional>

namespace {

using V = mc::Vec3<double>;
using Color = Eigen::Array3d;
using mc::Fault;

enum class Slip { none, weight, cosine, energy, reciprocity, negative, mirror, mirror_probability };

struct Sample { V wi; Color f; double pdf; bool delta, transmission; };

// Half Lambert, half perfect mirror when asked for.
struct Coated {
  Slip slip = Slip::none;
  double mirror = 0;

  Color eval(const V& wo, const V& wi) const {
    if (!(wo.z() > 0 && wi.z() > 0)) return Color::Zero();
    double f = 0.5 / mc::pi<double>;
    if (slip == Slip::energy) f *= 2.2;
    if (slip == Slip::reciprocity) f *= 0.5 + wo.z();
    if (slip == Slip::negative) f -= 0.1 * (wi.x() > 0.9);
    if (slip == Slip::negative && wi.x() > 0.9) f = -f;
    return Color::Constant(f);
  }
  double pdf(const V& wo, const V& wi) const {
    return wo.z() > 0 && wi.z() > 0 ? (1 - mirror) * (slip == Slip::cosine ? 1 / (2 * mc::pi<double>) : wi.z() / mc::pi<double>) : 0.0;
  }
  std::optional<Sample> sample(const V& wo, double uc, const mc::Vec2<double>& u) const {
    if (uc < mirror) return Sample{V(-wo.x(), -wo.y(), wo.z()), Color::Constant(0.2 * mirror / wo.z()), slip == Slip::mirror_probability ? uc : mirror, true, false};
    const V wi = mc::CosineHemisphere<double>{}.sample(u);
    return Sample{wi, (slip == Slip::weight ? 1.01 : 1.0) * eval(wo, wi), pdf(wo, wi), false, false};
  }
};

mc::Report check(Coated b) {
  return mc::check_bsdf<double>(b, V(0.6, 0, 0.8), {.samples = 50'000});
}

TEST(BsdfLaws, ARightBsdfPassesWithAndWithoutADeltaLobe) {
  EXPECT_TRUE(check({}).passed()) << check({}).to_string();
  EXPECT_TRUE(check({Slip::none, 0.3}).passed()) << check({Slip::none, 0.3}).to_string();
  EXPECT_TRUE(check({Slip::none, 1}).passed()) << check({Slip::none, 1}).to_string();
}

TEST(BsdfLaws, EachSlipIsNamed) {
  EXPECT_EQ(check({Slip::weight}).fault(), Fault::weight);
  EXPECT_EQ(check({Slip::energy}).fault(), Fault::physics);
  EXPECT_EQ(check({Slip::reciprocity}).fault(), Fault::physics);
  EXPECT_EQ(check({Slip::negative}).fault(), Fault::physics);
  EXPECT_EQ(check({Slip::cosine}).verdict(), mc::Verdict::fail);
  EXPECT_EQ(check({Slip::mirror_probability, 0.3}).fault(), Fault::weight);
}

} // namespace

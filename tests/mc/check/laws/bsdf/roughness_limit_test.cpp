#include <mc/check/laws/bsdf/roughness_limit.h>

#include <mc/core/frame.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using V = mc::Vec3<double>;

struct Sample {
  V wi;
  double f, pdf;
  bool delta;
};

struct Mirror {
  std::optional<Sample> sample(const V& wo, const mc::Vec2<double>&) const {
    return Sample{V(-wo.x(), -wo.y(), wo.z()), 0.8 / wo.z(), 1, true};
  }
};

// A uniform cone of half angle `spread` (approximately) around the mirror direction, with albedo 0.8.
struct Cone {
  double spread, albedo = 0.8, tilt = 0;
  double height() const { return spread * spread / 2; } // 1 - cos
  mc::Frame<double> frame(const V& wo) const {
    return mc::Frame<double>::from_z(V(-wo.x() + tilt, -wo.y(), wo.z()).normalized());
  }
  double pdf(const V& wo, const V& wi) const {
    return frame(wo).to_local(wi).z() >= 1 - height() ? 1 / (2 * mc::pi<double> * height()) : 0.0;
  }
  double eval(const V& wo, const V& wi) const { return albedo * pdf(wo, wi) / std::abs(wi.z()); }
  std::optional<Sample> sample(const V& wo, const mc::Vec2<double>& u) const {
    const double t = height() * u[0];
    const V wi =
        frame(wo).to_world(mc::spherical_direction<double>(std::sqrt(t * (2 - t)), 1 - t, 2 * mc::pi<double> * u[1]));
    const double density = 1 / (2 * mc::pi<double> * height());
    return Sample{wi, albedo * density / std::abs(wi.z()), density, false};
  }
};

// A BSDF with four wavelengths; the last has `last` times the value of the others.
template <class B> struct FourWavelengths {
  struct Sample {
    V wi;
    Eigen::Vector4d f;
    double pdf;
    bool delta;
  };
  B grey;
  double last = 1;

  Eigen::Vector4d four(double f) const { return {f, f, f, last * f}; }
  double pdf(const V& wo, const V& wi) const requires(!std::same_as<B, Mirror>) { return grey.pdf(wo, wi); }
  Eigen::Vector4d eval(const V& wo, const V& wi) const requires(!std::same_as<B, Mirror>) {
    return four(grey.eval(wo, wi));
  }
  std::optional<Sample> sample(const V& wo, const mc::Vec2<double>& u) const {
    const auto s = grey.sample(wo, u);
    return Sample{s->wi, four(s->f), s->pdf, s->delta};
  }
};

std::vector<mc::Check> check(const std::function<Cone(double)>& family) {
  return mc::check_roughness_limit<double>(family, Mirror{}, V(0.6, 0, 0.8));
}

TEST(RoughnessLimit, LobeNarrowingToMirror_Passes) {
  for (const mc::Check& c : check([](double r) { return Cone{r}; }))
    EXPECT_EQ(c.verdict, mc::Verdict::pass) << c.detail;
}

TEST(RoughnessLimit, WrongLimitAlbedoOrDirection_Fails) {
  EXPECT_THAT(check([](double r) { return Cone{r, 0.78}; })[0].detail, testing::HasSubstr("mean weight"));
  EXPECT_EQ(check([](double r) { return Cone{r, 0.8, 0.01}; })[0].verdict, mc::Verdict::fail);
}

TEST(RoughnessLimit, WrongSingleChannel_Fails) {
  const auto check_four = [](double last) {
    const auto family = [&](double r) { return FourWavelengths<Cone>{Cone{r}, last}; };
    return mc::check_roughness_limit<double>(family, FourWavelengths<Mirror>{Mirror{}}, V(0.6, 0, 0.8))[0];
  };
  EXPECT_EQ(check_four(1).verdict, mc::Verdict::pass);
  EXPECT_THAT(check_four(0.97).detail, testing::HasSubstr("mean weight of channel 3"));
}

TEST(RoughnessLimit, EvalJumpsInRoughness_Fails) {
  const auto checks = check([](double r) { return Cone{r < 0.99 ? r : 2 * r}; });
  EXPECT_EQ(checks[0].verdict, mc::Verdict::pass) << checks[0].detail;
  EXPECT_THAT(checks[1].detail, testing::HasSubstr("from roughness 1 to"));
}

} // namespace

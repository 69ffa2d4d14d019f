#include <mc/check/subject/any_bsdf.h>

#include <gtest/gtest.h>

namespace {

using Direction = mc::Vec3<float>;

struct Half {
  struct Sample {
    Direction wi;
    Eigen::Array3f f;
    float pdf;
  };
  Eigen::Array3f eval(const Direction&, const Direction&) const { return {0.1f, 0.2f, 0.3f}; }
  float pdf(const Direction&, const Direction& wi) const { return wi.z(); }
  std::optional<Sample> sample(const Direction&, const mc::Vec2<float>& u) const {
    if (u[0] < 0.5f) return {};
    return Sample{Direction(0, 0, -1), eval({}, {}), u[1]};
  }
};

TEST(AnyBsdf, ForwardsToBsdf) {
  const mc::AnyBsdf b = mc::any_bsdf<float>(Half{});
  const mc::AnyBsdf::Direction wo(0, 0, 1);
  EXPECT_TRUE(b.is_float);
  EXPECT_FALSE(b.sample(wo, 0, {0.25, 0.5}));
  const auto d = b.sample(wo, 0, {0.75, 0.5});
  ASSERT_TRUE(d);
  EXPECT_EQ(d->pdf, 0.5);
  EXPECT_TRUE(d->transmission) << "wi lies on the other side";
  EXPECT_FALSE(d->delta);
  EXPECT_EQ(d->f.count, 3);
  EXPECT_EQ(d->weight.count, 0);
  EXPECT_EQ(b.eval(wo, wo)[1], static_cast<double>(0.2f));
  EXPECT_EQ(b.pdf(wo, wo), 1);
}

TEST(AnyBsdf, OpenInterval_NeverPassesZero) {
  mc::Pcg random(1), before = random;
  while (random.uniform<float>() != 0) before = random;
  mc::AnyBsdf b;
  b.is_float = true;
  double uc = 1;
  b.sample = [&uc](const mc::AnyBsdf::Direction&, double first, const mc::Vec2<double>&) {
    uc = first;
    return std::optional<mc::AnyBsdf::Sample>();
  };
  for (const bool open : {false, true}) {
    b.open_interval = open;
    mc::Pcg again = before;
    b.sample_next({0, 0, 1}, again);
    EXPECT_EQ(uc, open ? b.epsilon() / 2 : 0.0);
  }
}

TEST(AnyBsdf, Channels_LastRepeats) {
  mc::Channels grey;
  grey.count = 1;
  grey.value[0] = 0.5;
  EXPECT_EQ(grey[2], 0.5);
}

} // namespace

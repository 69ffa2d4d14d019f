#include <mc/check/subject/make_subject.h>

#include <mc/check/check_subject.h>
#include <mc/domain/box.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/table/alias_table.h>
#include <mc/table/table_dist_2d.h>
#include <mc/warp/hemisphere.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using Kind = mc::Subject::Draw::Kind;

std::vector<mc::Subject::Draw> draw(const mc::Subject& s, std::size_t n) {
  std::vector<mc::Subject::Draw> out;
  s.draw(1, n, out);
  return out;
}

TEST(MakeSubject, Warp_DrawsChartPoints) {
  const mc::Subject s = mc::make_subject("cosine", mc::CosineHemisphere<float>{});
  EXPECT_EQ(s.dim, 2);
  for (const auto& d : draw(s, 1000)) {
    EXPECT_EQ(d.kind, Kind::point);
    EXPECT_TRUE(d.pdf_positive);
    EXPECT_TRUE(d.v[0] >= 0 && d.v[0] <= 1 && d.v[1] >= 0 && d.v[1] < 1);
  }
  EXPECT_NEAR(s.density({0.5, 0.25, 0}), 1, 1e-6); // 2 pi z / pi at z = 1/2
  EXPECT_THAT(s.describe_draw(1, 3), testing::AllOf(testing::HasSubstr("u = ("), testing::HasSubstr("pdf = ")));
  EXPECT_THAT(s.describe_point({0, 0, 0}), testing::HasSubstr("1)"));
}

TEST(MakeSubject, Draws_AreClassified) {
  const mc::Interval<double> unit;
  const auto pdf = [](double x) { return x > 0.5 ? 2.0 : 0.0; };
  EXPECT_EQ(draw(mc::make_subject(
                     "nan", unit, [](mc::Pcg&) { return std::nan(""); }, pdf),
                 1)[0]
                .kind,
            Kind::not_finite);
  EXPECT_EQ(draw(mc::make_subject(
                     "out", unit, [](mc::Pcg&) { return 2.0; }, pdf),
                 1)[0]
                .kind,
            Kind::outside);
  EXPECT_FALSE(draw(mc::make_subject(
                        "leak", unit, [](mc::Pcg&) { return 0.25; }, pdf),
                    1)[0]
                   .pdf_positive);
  const mc::Subject failing = mc::make_subject(
      "fails", unit, [](mc::Pcg&) { return std::optional<double>(); }, pdf);
  EXPECT_EQ(draw(failing, 1)[0].kind, Kind::failed);
  EXPECT_TRUE(failing.may_fail);
}

TEST(MakeSubject, Witness_DescribesDraw) {
  const auto sampler = [](mc::Pcg& r) { return r.uniform<double>(); };
  const mc::Subject s = mc::make_subject("u", mc::Interval<double>(), sampler, [](double) { return 1.0; });
  const auto draws = draw(s, 5);
  EXPECT_THAT(s.describe_draw(1, 4), testing::HasSubstr(fmt::format("x = {:.17g}", draws[4].v[0])));
}

TEST(MakeSubject, Witness_NamesUniformNumbers) {
  const auto sampler = [](mc::Pcg& r) { return mc::Vec2<float>(r.uniform<float>(), r.uniform<float>()); };
  const mc::Subject s =
      mc::make_subject("u", mc::Square<float>(), sampler, [](const mc::Vec2<float>&) { return 1.0f; });
  mc::Pcg random(1);
  random.advance(2);
  EXPECT_THAT(s.describe_draw(1, 1),
              testing::StartsWith("u = " + mc::detail::format_point(random.point<float, 2>()) + ", x = "));
}

// Direct light from a rectangle at height 1, sampled by area. The weight is the radiance over the density of
// directions.
struct AreaLightSeen {
  struct Sample {
    mc::Vec3<double> x;
    Eigen::Array3d weight;
    double pdf;
  };
  double bug = 1;
  // Returns the point at height 1 in direction w.
  static mc::Vec2<double> hit(const mc::Vec3<double>& w) { return {w.x() / w.z(), w.y() / w.z()}; }
  static bool visible(const mc::Vec3<double>& w) {
    return w.z() > 0 && std::abs(hit(w).x()) <= 1 && std::abs(hit(w).y()) <= 0.5;
  }
  Eigen::Array3d radiance(const mc::Vec3<double>& w) const {
    return visible(w) ? Eigen::Array3d(1, 2, 3) : Eigen::Array3d(Eigen::Array3d::Zero());
  }
  double pdf(const mc::Vec3<double>& w) const {
    return visible(w) ? 1 / (2 * w.z() * w.z() * w.z()) : 0;
  } // r^2 / (cos area)
  Sample sample(const mc::Vec2<double>& u) const {
    const mc::Vec3<double> w = mc::Vec3<double>(2 * u[0] - 1, u[1] - 0.5, 1).normalized();
    return {w, bug * Eigen::Array3d(1, 2, 3) / pdf(w), pdf(w)};
  }
};

TEST(MakeSubject, LightSampledFromPoint_Passes) {
  const auto check = [](AreaLightSeen light) {
    return check_subject(mc::make_subject(
                             "light", mc::Hemisphere<double>(),
                             [=](const mc::Vec2<double>& u) { return light.sample(u); },
                             [=](const mc::Vec3<double>& w) { return light.pdf(w); },
                             [=](const mc::Vec3<double>& w) { return light.radiance(w); }),
                         {.samples = 50'000});
  };
  EXPECT_TRUE(check({}).passed()) << check({}).to_string();
  EXPECT_EQ(check({1.001}).fault(), mc::Fault::weight);
  EXPECT_THAT(check({1.001}).to_string(),
              testing::ContainsRegex("light: fail: weight is [0-9.]+, should be [0-9.]+, at u = \\("));
}

TEST(MakeSubject, ImageTable_Passes) {
  std::vector<double> pixels(64 * 32, 1);
  pixels[20 * 64 + 5] = 1000;
  const mc::TableDist2D<float> table(pixels, 64, 32);
  EXPECT_TRUE(check_subject(mc::make_subject("image", table), {.samples = 50'000}).passed());
  pixels[20 * 64 + 5] = 1100;
  const mc::TableDist2D<float> other(pixels, 64, 32);
  const auto sampler = [&](const mc::Vec2<float>& u) { return table.sample(u); };
  const auto pdf = [&](const mc::Vec2<float>& p) { return other.pdf(p); };
  EXPECT_EQ(
      check_subject(mc::make_subject("another image", table.domain(), sampler, pdf), {.samples = 50'000}).verdict(),
      mc::Verdict::fail);
}

TEST(MakeSubject, DiscreteDistribution_HasAtoms) {
  const std::vector<double> weights{1, 0, 3};
  const mc::Subject s = mc::make_discrete_subject("alias", mc::AliasTable(weights));
  EXPECT_EQ(s.dim, 0);
  EXPECT_THAT(s.atoms, testing::ElementsAre(0.25, 0, 0.75));
  for (const auto& d : draw(s, 1000)) {
    EXPECT_EQ(d.kind, Kind::atom);
    EXPECT_NE(d.atom, 1);
    EXPECT_NEAR(d.weight, 1, 1e-12);
  }
}

TEST(MakeSubject, Witness_NamesDeviationFromUnitLength) {
  const auto with = [](double length, double z) {
    return make_subject(
               "w", mc::Hemisphere<double>(),
               [=](mc::Pcg&) { return mc::Vec3<double>(0.6 * length, 0, 0.8 * z * length); },
               [](const auto&) { return 1.0; })
        .describe_draw(1, 0);
  };
  EXPECT_THAT(with(1 - 1e-9, 1), testing::EndsWith("of length 1 - 1e-09, draw 0 of Pcg(1)"));
  EXPECT_THAT(with(1, -1), testing::Not(testing::HasSubstr("length"))) << "it is below the horizon";
}

} // namespace

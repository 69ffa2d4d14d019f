#include <mc/check/make_subject.h>

#include <mc/domain/interval.h>
#include <mc/table/alias_table.h>
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

TEST(MakeSubject, AWarpBecomesChartPoints) {
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

TEST(MakeSubject, DrawsAreClassified) {
  const mc::Interval<double> unit;
  const auto pdf = [](double x) { return x > 0.5 ? 2.0 : 0.0; };
  EXPECT_EQ(draw(mc::make_subject("nan", unit, [](mc::Pcg&) { return std::nan(""); }, pdf), 1)[0].kind, Kind::not_finite);
  EXPECT_EQ(draw(mc::make_subject("out", unit, [](mc::Pcg&) { return 2.0; }, pdf), 1)[0].kind, Kind::outside);
  EXPECT_FALSE(draw(mc::make_subject("leak", unit, [](mc::Pcg&) { return 0.25; }, pdf), 1)[0].pdf_positive);
  const mc::Subject failing = mc::make_subject("fails", unit, [](mc::Pcg&) { return std::optional<double>(); }, pdf);
  EXPECT_EQ(draw(failing, 1)[0].kind, Kind::failed);
  EXPECT_TRUE(failing.may_fail);
}

TEST(MakeSubject, TheWitnessIsTheDraw) {
  const auto sampler = [](mc::Pcg& r) { return r.uniform<double>(); };
  const mc::Subject s = mc::make_subject("u", mc::Interval<double>(), sampler, [](double) { return 1.0; });
  const auto draws = draw(s, 5);
  EXPECT_THAT(s.describe_draw(1, 4), testing::HasSubstr(fmt::format("x = {:.17g}", draws[4].v[0])));
}

TEST(MakeSubject, ADiscreteDistributionBecomesAtoms) {
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

} // namespace

#include <mc/check/subject/any_distribution.h>

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_distribution.h>
#include <mc/warp/hemisphere.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using mc::PointArray, mc::AnyDistribution;
using Kind = mc::Subject::Draw::Kind;

AnyDistribution unit() {
  return mc::make_distribution(
      "u", mc::Interval<double>(), [](double u) { return u; }, [](double) { return 1.0; });
}

TEST(AnyDistribution, ToChart_ClassifiesEverySample) {
  const AnyDistribution s = unit();
  AnyDistribution::Sample d;
  d.x = {0.25};
  EXPECT_EQ(to_chart(s, d).draw.kind, Kind::point);
  EXPECT_EQ(to_chart(s, d).draw.v[0], 0.25);
  EXPECT_EQ(to_chart(s, d).pdf, 1);
  d.x = {2};
  EXPECT_EQ(to_chart(s, d).draw.kind, Kind::outside);
  d.x = {NAN};
  EXPECT_EQ(to_chart(s, d).draw.kind, Kind::not_finite);
  EXPECT_EQ(to_chart(s, std::nullopt).draw.kind, Kind::failed);
}

TEST(AnyDistribution, RandomUniforms_AreOfItsScalar) {
  AnyDistribution s = unit();
  s.is_float = true;
  mc::Pcg random(1);
  for (int i = 0; i < 100; ++i) {
    const double u = random_uniforms(s, random)[0];
    EXPECT_EQ(u, static_cast<double>(static_cast<float>(u)));
  }
}

// An outcome of probability 1/4 in addition to the interval.
AnyDistribution point_and_lobe() {
  AnyDistribution s = unit();
  s.atoms = {0.25};
  s.sample = [](const AnyDistribution::Uniforms& u) {
    AnyDistribution::Sample d;
    if (u[0] < 0.25) d.atom = 0;
    else d.x[0] = (u[0] - 0.25) / 0.75;
    return std::optional(d);
  };
  s.pdf = [](const PointArray&) { return 0.75; };
  return s;
}

TEST(AnyDistribution, PointsAndDeltaLobe_AreDrawnTogether) {
  AnyDistribution s = point_and_lobe();
  const mc::Report right = check_subject(make_subject(s), {.samples = 50'000});
  EXPECT_TRUE(right.passed()) << right.to_string();
  s.atoms = {0.26};
  EXPECT_EQ(check_subject(make_subject(s), {.samples = 50'000}).verdict(), mc::Verdict::fail);
}

// The fault is found at any place and for rare points. With outcomes, the index of the witness counts all draws.
TEST(AnyDistribution, NonFiniteInverse_Fails) {
  for (const double lost : {1e-2, 2e-4}) {
    AnyDistribution s = point_and_lobe();
    s.invert_tolerance = 1e-12;
    for (const bool fails : {false, true}) {
      s.invert = [=](const PointArray& x) -> std::optional<AnyDistribution::Uniforms> {
        if (x[0] < 1 - lost) return AnyDistribution::Uniforms{0.25 + 0.75 * x[0]};
        return fails ? std::nullopt : std::optional(AnyDistribution::Uniforms{NAN});
      };
      const mc::Report r = check_subject(make_subject(s), {.samples = 50'000});
      EXPECT_EQ(r.fault(), mc::Fault::inverse) << r.to_string();
      EXPECT_THAT(r.to_string(),
                  testing::ContainsRegex("fail: invert fails or is not finite, at u = 0.99[0-9]+, x = 0.99"))
          << r.to_string();
    }
  }
}

// draw_many and the calls of sample and pdf give the same draws bit for bit, including draws that fail, lie outside or
// are not finite.
TEST(AnyDistribution, DrawMany_EqualsSampleAndPdf) {
  const auto expect_same = [](AnyDistribution s) {
    ASSERT_TRUE(s.draw_many);
    std::vector<mc::Subject::Draw> typed, stepwise;
    make_subject(s).draw(7, 3000, typed);
    s.sample = [sample = s.sample](const AnyDistribution::Uniforms& u) { return sample(u); }; // disables draw_many
    make_subject(s).draw(7, 3000, stepwise);
    ASSERT_EQ(typed.size(), stepwise.size());
    for (std::size_t i = 0; i < typed.size(); ++i) {
      EXPECT_EQ(typed[i].kind, stepwise[i].kind) << s.name << i;
      EXPECT_EQ(typed[i].v, stepwise[i].v) << s.name << i;
      EXPECT_EQ(typed[i].density, stepwise[i].density) << s.name << i;
      EXPECT_EQ(typed[i].pdf_positive, stepwise[i].pdf_positive) << s.name << i;
    }
  };
  expect_same(mc::make_distribution("float", mc::CosineHemisphere<float>()));
  expect_same(mc::make_distribution("double", mc::CosineHemisphere<double>()));
  expect_same(mc::make_distribution(
      "broken", mc::Interval<double>(0, 1),
      [](double u) -> std::optional<double> {
        if (u < 0.1) return {};
        if (u < 0.2) return std::nan("");
        return u < 0.3 ? 2.0 : u;
      },
      [](double x) { return x < 0.5 ? 0.0 : HUGE_VAL; }));
}

// The checker evaluates nearly all densities in batches if the distribution supports them, with the same results.
TEST(AnyDistribution, PdfMany_IsCalledOnce) {
  AnyDistribution s = mc::make_distribution(
      "e", mc::HalfLine<double>(0, 2), [](double u) { return -std::log1p(-u); }, [](double x) { return std::exp(-x); });
  const mc::Report one_by_one = check_subject(make_subject(s), {.samples = 20'000});
  int questions = 0, asked = 0;
  s.pdf_many = [&, pdf = s.pdf](std::span<const PointArray> x) {
    ++questions;
    asked += static_cast<int>(x.size());
    std::vector<double> densities;
    for (const PointArray& one : x) densities.push_back(pdf(one));
    return densities;
  };
  const mc::Report together = check_subject(make_subject(s), {.samples = 20'000});
  EXPECT_EQ(together.p(), one_by_one.p());
  EXPECT_EQ(together.mass, one_by_one.mass);
  EXPECT_GT(asked, 30'000);
  EXPECT_LT(questions, asked / 32);
}

TEST(AnyDistribution, InvertMany_EqualsInvert) {
  AnyDistribution s = unit();
  s.invert_tolerance = 1e-12;
  s.invert = [](const PointArray& x) { return std::optional(AnyDistribution::Uniforms{x[0]}); };
  const auto single = make_subject(s).inverted(5, 1000);
  int calls = 0;
  s.invert_many = [&](std::span<const PointArray> x) {
    ++calls;
    std::vector<std::optional<AnyDistribution::Uniforms>> u;
    for (const PointArray& one : x) u.emplace_back(AnyDistribution::Uniforms{one[0]});
    return u;
  };
  EXPECT_EQ(make_subject(s).inverted(5, 1000), single);
  EXPECT_GE(calls, 1);
  EXPECT_LE(calls, 4);
}

TEST(AnyDistribution, Witness_DescribesDraw) {
  const mc::Subject subject = make_subject(unit());
  std::vector<mc::Subject::Draw> draws;
  subject.draw(1, 5, draws);
  EXPECT_THAT(subject.describe_draw(1, 4), testing::HasSubstr(fmt::format("x = {:.17g}, pdf = 1", draws[4].v[0])));
}

} // namespace

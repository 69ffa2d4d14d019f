#include <mc/check/fit/draw_stats.h>

#include <mc/core/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using Draw = mc::Subject::Draw;

// Every tenth draw has one of five faults, in turn.
mc::Subject broken_subject() {
  mc::Subject s;
  s.name = "broken";
  s.dim = 1;
  s.atoms = {0.5, 0};
  s.draw = [](std::uint64_t, std::size_t n, std::vector<Draw>& out) {
    for (std::size_t i = 0; i < n; ++i) {
      Draw& d = out.emplace_back();
      d.v[0] = 0.25;
      if (i % 10 != 9) continue;
      switch (i / 10 % 5) {
      case 0: d.kind = Draw::Kind::failed; break;
      case 1: d.kind = Draw::Kind::outside; break;
      case 2: d.pdf_positive = false; break;
      case 3: d.weight = 2; break;
      default: d.kind = Draw::Kind::atom; d.atom = 1;
      }
    }
  };
  s.density = [](const auto&) { return 1.0; };
  s.describe_draw = [](std::uint64_t, std::uint64_t index) { return "draw " + std::to_string(index); };
  return s;
}

TEST(DrawStats, CountsViolationsAndKeepsFirstWitness) {
  const mc::Subject s = broken_subject();
  std::size_t points = 0;
  const mc::DrawStats t = draw_samples(s, 1, 1000, [&](std::span<const mc::Subject::Coordinates> v, const auto&) {
    for (const auto& one : v) points += one[0] == 0.25;
  });
  EXPECT_EQ(t.draws, 1000u);
  EXPECT_EQ(points, 940u);
  EXPECT_EQ(t.failed.count, 20u);
  EXPECT_EQ(t.outside.count, 20u);
  EXPECT_EQ(t.outside.index, 19u);
  EXPECT_EQ(t.zero_pdf.count, 20u);
  EXPECT_EQ(t.weight.count, 20u);
  EXPECT_EQ(t.max_weight_error, 1);
  EXPECT_EQ(t.atoms[1], 20u);
  const mc::DrawStats twice = merge(t, t);
  EXPECT_EQ(twice.draws, 2000u);
  EXPECT_EQ(twice.zero_pdf.count, 40u);
  EXPECT_EQ(twice.zero_pdf.index, t.zero_pdf.index);
}

TEST(DrawStats, EachViolationKind_IsCheck) {
  const mc::Subject s = broken_subject();
  std::vector<std::string> failed;
  for (const mc::Check& c : check_draws(s, draw_samples(s, 1, 1000, [](const auto&, const auto&) {})))
    if (c.verdict == mc::Verdict::fail) failed.push_back(c.name + ": " + c.detail);
  EXPECT_THAT(failed,
              testing::ElementsAre(
                  "in the domain: sample is outside the domain, at draw 19; 20 of 1000 samples",
                  "pdf > 0 at samples: pdf is 0, should be > 0 at every sample, at draw 29; 20 of 1000 samples",
                  "weight = f / pdf: weight differs from f / pdf by 1, relative, at draw 39; 20 of 1000 samples",
                  "never fails: sample fails, at draw 9; 20 of 1000 samples; set may_fail if a sample may fail, with a "
                  "density of less mass",
                  "outcomes of probability 0: outcome 1 was drawn 20 times, should never be: its probability is 0"));
}

// A NaN density and a negative density have faults of their own, different from a density of 0.
TEST(DrawStats, InvalidDensity_HasOwnFault) {
  mc::Subject s;
  s.dim = 1;
  s.draw = [&s](std::uint64_t, std::size_t n, std::vector<Draw>& out) {
    for (std::size_t i = 0; i < n; ++i) {
      Draw& d = out.emplace_back();
      d.v[0] = static_cast<double>(i % 4) / 4;
      d.pdf_positive = i % 4 == 0;
      d.density = s.density(d.v);
    }
  };
  s.density = [](const auto& v) {
    return v[0] == 0.25 ? std::numeric_limits<double>::quiet_NaN() : v[0] == 0.5 ? 0.0 : v[0] == 0.75 ? -1.0 : 1.0;
  };
  std::vector<std::string> failed;
  std::vector<mc::Fault> faults;
  for (const mc::Check& c : check_draws(s, draw_samples(s, 1, 1000, [](const auto&, const auto&) {})))
    if (c.verdict == mc::Verdict::fail) {
      failed.push_back(c.name + ": " + c.detail);
      faults.push_back(c.fault);
    }
  EXPECT_THAT(failed,
              testing::ElementsAre("pdf finite at samples: pdf is not finite; 250 of 1000 samples",
                                   "pdf >= 0 at samples: pdf is negative; 250 of 1000 samples",
                                   "pdf > 0 at samples: pdf is 0, should be > 0 at every sample; 250 of 1000 samples"));
  EXPECT_THAT(faults, testing::ElementsAre(mc::Fault::not_finite, mc::Fault::negative, mc::Fault::zero_pdf));
}

// An invalid density on the edge of the domain does not imply a wrong density.
TEST(DrawStats, InvalidDensityOnChartFace_IsMeasureZero) {
  mc::Subject s;
  s.dim = 2;
  s.density = [](const auto& v) { return v[1] <= 0 ? std::numeric_limits<double>::infinity() : v[1] >= 1 ? 0.0 : 2.0; };
  const auto failed = [&](std::size_t low, std::size_t high, bool open_interval) {
    s.draw = [&](std::uint64_t, std::size_t n, std::vector<Draw>& out) {
      for (std::size_t i = 0; i < n; ++i) {
        Draw& d = out.emplace_back();
        d.v = {0.25, i < low ? 0.0 : i < low + high ? 1.0 : 0.5, 0};
        d.pdf_positive = i >= low + high;
      }
    };
    double sum = 0;
    const mc::DrawStats t = draw_samples(s, 1, 1000, [&](const auto&, std::span<const double> densities) {
      for (const double density : densities) sum += density;
    });
    EXPECT_EQ(sum, 2000) << "the density beside the face";
    std::vector<mc::Fault> faults;
    for (const mc::Check& c : check_draws(s, t, open_interval))
      if (c.verdict == mc::Verdict::fail || c.verdict == mc::Verdict::warning) faults.push_back(c.fault);
    return faults;
  };
  EXPECT_THAT(failed(300, 3, false), testing::ElementsAre(mc::Fault::measure_zero));
  EXPECT_THAT(failed(300, 3, true), testing::IsEmpty());
  EXPECT_THAT(failed(0, 4, true), testing::ElementsAre(mc::Fault::zero_pdf))
      << "rounding puts no four where nothing is";
}

// In a sharp lobe over float, the density changes when the point is rounded: by 2.4 % within four steps here.
TEST(DrawStats, WeightErrorWithinRounding_Passes) {
  const auto broken = [](double weight, double slope) {
    mc::Subject s;
    s.dim = 1;
    s.epsilon = 0x1p-23;
    s.draw = [weight](std::uint64_t, std::size_t n, std::vector<Draw>& out) {
      for (std::size_t i = 0; i < n; ++i) {
        Draw& d = out.emplace_back();
        d.v[0] = 0.5;
        d.weight = weight;
      }
    };
    s.density = [slope](const auto& v) { return std::exp(slope * (v[0] - 0.5)); };
    return draw_samples(s, 1, 10, [](const auto&, const auto&) {}).weight.count > 0;
  };
  for (const double side : {-1, 1}) {
    EXPECT_FALSE(broken(1 + side * 0.02, 1e5));
    EXPECT_TRUE(broken(1 + side * 0.03, 1e5));
    EXPECT_TRUE(broken(1 + side * 0.02, 1));
    EXPECT_TRUE(broken(1 + side * 0.0002, 1));
  }
  EXPECT_TRUE(broken(std::numeric_limits<double>::quiet_NaN(), 1));
}

TEST(DrawStats, NanWeight_StaysLargestError) {
  mc::Subject s;
  s.draw = [](std::uint64_t, std::size_t n, std::vector<Draw>& out) {
    for (std::size_t i = 0; i < n; ++i) {
      Draw& d = out.emplace_back();
      d.kind = Draw::Kind::atom;
      d.atom = 0;
      d.weight = i == 3 ? std::numeric_limits<double>::quiet_NaN() : 1 + 1e-7;
    }
  };
  s.atoms = {1};
  const mc::DrawStats t = draw_samples(s, 1, 10, [](const auto&, const auto&) {});
  EXPECT_EQ(t.weight.count, 1u);
  EXPECT_EQ(t.max_weight_error, std::numeric_limits<double>::infinity());
}

TEST(DrawStats, SubjectWithoutDraws_Throws) {
  mc::Subject s;
  s.draw = [](std::uint64_t, std::size_t, std::vector<Draw>&) {};
  EXPECT_THROW(draw_samples(s, 1, 10, [](const auto&, const auto&) {}), mc::Error);
}

// A distribution that always fails, in agreement with its density of 0: no fault, but nothing was tested.
TEST(DrawStats, AllDrawsFail_IsInconclusive) {
  mc::Subject s;
  s.may_fail = true;
  mc::DrawStats stats;
  stats.draws = stats.failed.count = 1000;
  EXPECT_EQ(mc::check_draws(s, stats).back().verdict, mc::Verdict::inconclusive);
  --stats.failed.count;
  EXPECT_EQ(mc::check_draws(s, stats).back().verdict, mc::Verdict::pass);
}

} // namespace

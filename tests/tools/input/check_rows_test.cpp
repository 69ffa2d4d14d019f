#include <input/check_rows.h>

#include "tools/input/samples_scratch.h"

#include <mc/random/pcg.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using carlo::ValidateCommandOptions;
using support::Output, support::run;
using testing::HasSubstr;

mc::Report check(bool even, bool dependent) {
  constexpr std::size_t outcomes = 500, rows = 100'000;
  const std::vector<double> p(outcomes, 1.0 / outcomes);
  carlo::OrderedSamples samples{{}, {{"i"}}, 1, p};
  mc::Pcg random(1);
  for (std::size_t i = 0; i < rows; ++i)
    samples.points.push_back({even ? std::floor(static_cast<double>(i * outcomes) / static_cast<double>(rows))
                                   : std::floor(static_cast<double>(outcomes) * random.uniform<double>())});
  mc::Subject s;
  s.atoms = p;
  s.draw = [&samples, next = std::size_t{0}](std::uint64_t, std::size_t n,
                                             std::vector<mc::Subject::Draw>& out) mutable {
    for (std::size_t i = 0; i < n; ++i) {
      out.emplace_back().kind = mc::Subject::Draw::Kind::atom;
      out.back().atom = static_cast<int>(samples.points[next++][0]);
    }
  };
  return carlo::check_rows(s, samples, dependent, {.samples = rows, .alpha = 0.01});
}

TEST(CheckRows, RandomRowsPass_SortedRowsFailUnlessDependent) {
  EXPECT_TRUE(check(false, false).passed()) << check(false, false).to_string();
  const mc::Report sorted = check(true, false);
  EXPECT_EQ(sorted.fault(), mc::Fault::dependent) << sorted.to_string();
  EXPECT_THAT(sorted.to_string(), testing::HasSubstr("--dependent"));
  const mc::Report accepted = check(true, true);
  EXPECT_TRUE(accepted.passed()) << accepted.to_string();
  EXPECT_EQ(accepted.untried_text(), "not tried: independence of the samples (--dependent)");
}

TEST(CheckRows, Shares_AddUpToAtMostOne) {
  double sum = 0;
  for (const mc::Check& c : check(false, false).checks) sum += c.share;
  EXPECT_LE(sum, 1 + 1e-9);
}

// The rest 1 - x - y has a pole at 0: many points are rounded onto the edge x + y = 1 or beyond.
TEST_F(SamplesFile, TrianglePole_PassesWithWarning) {
  const auto draw = [](mc::Pcg& r) {
    const double x = 0.5 - 0.5 * std::cos(mc::pi<double> * r.uniform<double>()); // arcsine
    const double rest = 1e-3 * std::pow(r.uniform<double>(), 5), a = (1 - rest) * x;
    return fmt::format("{:.17g},{:.17g}", a, 1 - rest - a);
  };
  ValidateCommandOptions o = options(samples(draw), "");
  o.domain = "triangle";
  o.pdf = "0.2*1e-3^-0.2*(1-x-y)^-0.8/_pi/sqrt(x*y)*((1-x-y)<=1e-3)";
  const Output out = run(o);
  EXPECT_EQ(out.code, carlo::exit_ok) << out.text;
  EXPECT_THAT(out.text, HasSubstr("pass (boundary of measure zero)"));
}

TEST_F(SamplesFile, SortedRows_FailUnlessDependent) {
  int row = 0;
  ValidateCommandOptions o = options(samples([&row](mc::Pcg&) { return fmt::format("{}", row++ / 100); }), "");
  o.domain = fmt::format("discrete={}", (row + 99) / 100);
  o.pdf = "1";
  o.unnormalized = true;
  const Output sorted = run(o);
  EXPECT_EQ(sorted.code, carlo::exit_failed);
  EXPECT_THAT(sorted.text, HasSubstr("likely cause: dependent"));
  o.dependent = true;
  EXPECT_EQ(run(o).code, carlo::exit_ok);
}

TEST_F(SamplesFile, UnnormalizedDensityOfAnyScale_Passes) {
  ValidateCommandOptions o =
      options(samples([](mc::Pcg& r) { return fmt::format("{:.17g}", -std::log1p(-r.uniform<double>())); }), "");
  o.domain = "x=0:inf";
  o.unnormalized = true;
  for (const std::string scale : {"1e-7", "1e-30", "1", "1e20"}) {
    o.pdf = scale + "*exp(-x)";
    EXPECT_EQ(run(o).code, carlo::exit_ok) << scale;
  }
}

} // namespace

#include <input/check_rows.h>

#include <mc/random/pcg.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

mc::Report check(bool even, bool dependent) {
  constexpr std::size_t outcomes = 500, rows = 100'000;
  const std::vector<double> p(outcomes, 1.0 / outcomes);
  carlo::OrderedSamples samples{{}, {{"i"}}, 1, p};
  mc::Pcg random(1);
  for (std::size_t i = 0; i < rows; ++i)
    samples.points.push_back({even ? static_cast<double>(i / (rows / outcomes))
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

} // namespace

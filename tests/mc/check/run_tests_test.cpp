#include <mc/check/run_tests.h>

#include <mc/check/table.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <numeric>

namespace {

std::vector<mc::Cell> uniform_cells(std::size_t k) {
  std::vector<mc::Cell> cells(k);
  for (std::size_t i = 0; i < k; ++i) {
    cells[i].p = 1 / static_cast<double>(k);
    cells[i].rank_lo[0] = static_cast<double>(i) / static_cast<double>(k);
    cells[i].rank_hi[0] = static_cast<double>(i + 1) / static_cast<double>(k);
  }
  return cells;
}

void fill(std::vector<mc::Cell>& cells, std::uint64_t seed, int n, double power = 1) {
  mc::Pcg random(seed);
  for (int i = 0; i < n; ++i)
    count_in(
        cells[static_cast<std::size_t>(std::pow(random.uniform<double>(), power) * static_cast<double>(cells.size()))],
        1);
}

mc::Report report(const mc::Findings& t) {
  mc::Report r;
  r.checks = t.checks;
  return r;
}

TEST(CellTests, AlphaShares_SumToAtMostAlpha) {
  for (const int dim : {0, 1, 2, 3}) {
    auto cells = uniform_cells(64);
    for (mc::Cell& c : cells) c.rank_lo[1] = c.rank_lo[2] = 0.25;
    fill(cells, 1, 10000);
    double sum = 0;
    for (const mc::Check& c : mc::test_cells(cells, dim, 0.01).checks) sum += c.share;
    EXPECT_LE(sum, 0.91 + 1e-9) << dim;
  }
}

// 1000 runs at 10 %, of which 91 % is spent; KS on cells is conservative. Binomial(1000, 0.1) is below 140 with
// probability 0.9999.
TEST(CellTests, CorrectCounts_RejectedAtMostAtAlpha) {
  int rejected = 0;
  for (int run = 0; run < 1000; ++run) {
    auto cells = uniform_cells(128);
    fill(cells, static_cast<std::uint64_t>(run) + 100, 20000);
    rejected += !report(mc::test_cells(cells, 1, 0.1)).passed();
  }
  EXPECT_LE(rejected, 140);
  EXPECT_GE(rejected, 30);
}

TEST(CellTests, WrongExponentsSpikesAndSteps_Fail) {
  auto cells = uniform_cells(512);
  fill(cells, 3, 100000, 1.05);
  EXPECT_EQ(report(mc::test_cells(cells, 1, 0.01)).verdict(), mc::Verdict::fail) << "exponent";
  cells = uniform_cells(512);
  fill(cells, 4, 100000);
  for (int i = 0; i < 150; ++i) count_in(cells[77], 1);
  const mc::Report spike = report(mc::test_cells(cells, 1, 0.01));
  EXPECT_EQ(spike.verdict(), mc::Verdict::fail) << "spike";
  cells = uniform_cells(512);
  fill(cells, 5, 100000);
  for (std::size_t i = 0; i < 512; i += 2)
    for (int k = 0; k < 12; ++k) count_in(cells[i], 1);
  EXPECT_EQ(report(mc::test_cells(cells, 1, 0.01)).verdict(), mc::Verdict::fail) << "alternating";
}

// Errors of the stated size are detected: random signs, and a single wrong cell.
TEST(CellTests, DetectableError_IsRejected) {
  auto cells = uniform_cells(256);
  fill(cells, 6, 100000);
  const mc::Findings stated = mc::test_cells(cells, 1, 0.01);
  int caught = 0, caught_cell = 0;
  for (int run = 0; run < 100; ++run) {
    mc::Pcg random(static_cast<std::uint64_t>(run) + 50);
    auto wrong = uniform_cells(256);
    std::vector<double> cdf{0};
    for (std::size_t i = 0; i < 256; ++i)
      cdf.push_back(cdf.back() + 1 + (random.uniform<double>() < 0.5 ? -1 : 1) * stated.detectable);
    auto one = uniform_cells(256);
    for (int i = 0; i < 100000; ++i) {
      const double u = random.uniform<double>();
      count_in(
          wrong[static_cast<std::size_t>(std::upper_bound(cdf.begin(), cdf.end() - 1, u * cdf.back()) - cdf.begin()) -
                1],
          1);
      const double v = random.uniform<double>() * (256 + stated.detectable_cell);
      count_in(one[v < 256 ? static_cast<std::size_t>(v) : 100], 1);
    }
    caught += report(mc::test_cells(wrong, 1, 0.01)).verdict() == mc::Verdict::fail;
    caught_cell += report(mc::test_cells(one, 1, 0.01)).verdict() == mc::Verdict::fail;
  }
  EXPECT_GE(caught, 95);
  EXPECT_GE(caught_cell, 95);
}

// Estimated probabilities with the same variance as the counts: 500 runs at 10 %. Binomial(500, 0.1) is below 75 with
// probability 0.9998. Errors far beyond both variances are still found.
TEST(CellTests, EstimatedProbabilities_KeepAlpha) {
  int rejected = 0;
  for (int run = 0; run < 500; ++run) {
    auto cells = uniform_cells(128);
    fill(cells, static_cast<std::uint64_t>(run) + 5000, 20000);
    auto other = uniform_cells(128);
    fill(other, static_cast<std::uint64_t>(run) + 9000, 20000);
    for (std::size_t i = 0; i < 128; ++i) {
      cells[i].p = other[i].observed / 20000;
      cells[i].variance = 1 / 128.0 / 20000;
    }
    rejected += !report(mc::test_cells(cells, 1, 0.1)).passed();
    if (run > 0) continue;
    for (int i = 0; i < 300; ++i) count_in(cells[7], 1);
    EXPECT_EQ(report(mc::test_cells(cells, 1, 0.01)).verdict(), mc::Verdict::fail);
  }
  EXPECT_LE(rejected, 75);
}

// All samples have the same weight below 1: the variance follows the weights.
TEST(CellTests, WeightedSamples_RejectedAtRateAlpha) {
  int rejected = 0;
  for (int run = 0; run < 300; ++run) {
    auto cells = uniform_cells(128);
    mc::Pcg random(static_cast<std::uint64_t>(run) + 700);
    for (int i = 0; i < 20000; ++i) count_in(cells[static_cast<std::size_t>(128 * random.uniform<double>())], 0.25);
    rejected += !report(mc::test_cells(cells, 1, 0.1)).passed();
  }
  EXPECT_LE(rejected, 48); // Binomial(300, 0.1) is below 48 with probability 0.9995
  EXPECT_GE(rejected, 5);
}

// One expectation has a standard deviation of 0.03 and is one deviation off. Given the sum, the other, exact
// expectations are off by the same amount: no run of them is wrong.
TEST(CellTests, UncertainCell_FailsNoOtherCell) {
  std::vector<mc::Cell> cells(64);
  for (mc::Cell& c : cells) {
    c.p = 0.5 / 63;
    c.observed = c.squares = std::round(1e6 * c.p);
  }
  cells[0].p = 0.53;
  cells[0].variance = 9e-4;
  cells[0].observed = cells[0].squares = 5e5;
  for (const mc::Check& c : test_cells(cells, 0, 0.01).checks) EXPECT_EQ(c.verdict, mc::Verdict::pass) << c.name;
}

// Rows with equal names spend one share. A table of too many shares spends alpha, not more.
TEST(ShareOf, RowsOfEqualName_DivideOneShare) {
  mc::Subject s;
  s.dim = 2;
  const auto fourier = [&] {
    double sum = 0;
    for (const mc::FitTestRow& row : mc::fit_tests())
      if (std::string_view(row.name) == "Fourier" && row.applies(s)) sum += share_of(row, s);
    return sum;
  };
  EXPECT_EQ(fourier(), 0.05);
  s.inverted = [](std::uint64_t, std::size_t) { return std::vector<mc::Subject::Coordinates>{}; };
  EXPECT_EQ(fourier(), 0.05);
}

TEST(PrependFinding, OnlyLeadingFailedChecks_BeginWithIt) {
  mc::Check pass, likely, other, certain;
  likely.verdict = other.verdict = certain.verdict = mc::Verdict::fail;
  likely.p = other.p = 1e-5;
  certain.p = 1e-12;
  mc::prepend_finding({&pass, &likely, &other, &certain}, "found");
  EXPECT_EQ(pass.detail, "");
  EXPECT_EQ(likely.detail, "found; ");
  EXPECT_EQ(other.detail, "");
  EXPECT_EQ(certain.detail, "found; ");
}

} // namespace

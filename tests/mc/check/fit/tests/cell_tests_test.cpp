#include <mc/check/fit/tests/cell_tests.h>

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
    ++cells[static_cast<std::size_t>(std::pow(random.uniform<double>(), power) * static_cast<double>(cells.size()))]
          .observed;
}

mc::Report report(const mc::CellTests& t) {
  mc::Report r;
  r.checks = t.checks;
  return r;
}

TEST(CellTests, SharesNeverExceedAlpha) {
  for (const int dim : {0, 1, 2, 3}) {
    auto cells = uniform_cells(64);
    for (mc::Cell& c : cells) c.rank_lo[1] = c.rank_lo[2] = 0.25;
    fill(cells, 1, 10000);
    double sum = 0;
    for (const mc::Check& c : mc::test_cells(cells, dim, 0.01).checks) sum += c.share;
    EXPECT_LE(sum, 0.91 + 1e-9) << dim;
  }
}

// 1000 runs at 10 %, of which 91 % is spent; KS on cells is conservative. Binomial(1000, 0.1) lies below 140 with
// 0.9999.
TEST(CellTests, RejectsAtMostAtTheRateOfAlpha) {
  int rejected = 0;
  for (int run = 0; run < 1000; ++run) {
    auto cells = uniform_cells(128);
    fill(cells, static_cast<std::uint64_t>(run) + 100, 20000);
    rejected += !report(mc::test_cells(cells, 1, 0.1)).passed();
  }
  EXPECT_LE(rejected, 140);
  EXPECT_GE(rejected, 30);
}

TEST(CellTests, FindsExponentsSpikesAndSteps) {
  auto cells = uniform_cells(512);
  fill(cells, 3, 100000, 1.05);
  EXPECT_EQ(report(mc::test_cells(cells, 1, 0.01)).verdict(), mc::Verdict::fail) << "exponent";
  cells = uniform_cells(512);
  fill(cells, 4, 100000);
  cells[77].observed += 150;
  const mc::Report spike = report(mc::test_cells(cells, 1, 0.01));
  EXPECT_EQ(spike.verdict(), mc::Verdict::fail) << "spike";
  cells = uniform_cells(512);
  fill(cells, 5, 100000);
  for (std::size_t i = 0; i < 512; i += 2) cells[i].observed += 12;
  EXPECT_EQ(report(mc::test_cells(cells, 1, 0.01)).verdict(), mc::Verdict::fail) << "alternating";
}

// What it says it catches, it catches: random signs of the stated size, and a single cell off by the stated size.
TEST(CellTests, KeepsItsPromiseOfPower) {
  auto cells = uniform_cells(256);
  fill(cells, 6, 100000);
  const mc::CellTests stated = mc::test_cells(cells, 1, 0.01);
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
      ++wrong[static_cast<std::size_t>(std::upper_bound(cdf.begin(), cdf.end() - 1, u * cdf.back()) - cdf.begin()) - 1]
            .observed;
      const double v = random.uniform<double>() * (256 + stated.detectable_cell);
      ++one[v < 256 ? static_cast<std::size_t>(v) : 100].observed;
    }
    caught += report(mc::test_cells(wrong, 1, 0.01)).verdict() == mc::Verdict::fail;
    caught_cell += report(mc::test_cells(one, 1, 0.01)).verdict() == mc::Verdict::fail;
  }
  EXPECT_GE(caught, 95);
  EXPECT_GE(caught_cell, 95);
}

TEST(CellTests, QuadratureErrorMakesItInconclusiveNotWrong) {
  auto cells = uniform_cells(64);
  fill(cells, 7, 100000);
  cells[10].observed += 400; // ten sigma
  for (mc::Cell& c : cells) c.error = 0.5 / 64;
  EXPECT_EQ(report(mc::test_cells(cells, 1, 0.01)).verdict(), mc::Verdict::inconclusive);
  auto good = uniform_cells(64);
  fill(good, 8, 100000);
  for (mc::Cell& c : good) c.error = 1e-7;
  EXPECT_EQ(report(mc::test_cells(good, 1, 0.01)).verdict(), mc::Verdict::pass);
}

} // namespace

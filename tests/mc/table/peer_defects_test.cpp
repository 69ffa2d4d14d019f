// Regression tests for defects that were observed in the tables of other renderers. Each comment states the defect.

#include <mc/core/error.h>
#include <mc/core/sum.h>
#include <mc/random/hash.h>
#include <mc/random/uniform.h>
#include <mc/table/alias_table.h>
#include <mc/table/table_dist_1d.h>
#include <mc/table/table_dist_2d.h>

#include <gtest/gtest.h>

namespace {

constexpr std::size_t sky_width = 1024, sky_height = 512, sky_cells = sky_width * sky_height;

std::vector<double> sky(std::size_t sun, double radiance) {
  std::vector<double> w(sky_cells);
  for (std::size_t i = 0; i < sky_cells; ++i) w[i] = 0.5 + mc::hash_uniform<double>(4, i);
  w[sun] = radiance;
  return w;
}

double total(const std::vector<double>& w) {
  mc::CompensatedSum sum;
  for (const double x : w) sum.add(x);
  return sum.value();
}

// pbrt-v4: in a one-dimensional table of a sky with a bright sun, most cells are never sampled.
TEST(PeerDefects, EveryCellBesideTheSunIsReached) {
  for (const std::size_t sun : {std::size_t{10}, sky_cells / 2}) {
    const std::vector<double> w = sky(sun, 1e8);
    const double sum = total(w);
    const mc::TableDist1D<double> table(w);
    for (std::size_t i = 0; i < sky_cells; ++i) {
      ASSERT_EQ(table.sample_index(table.cdf().cdf(i)).index, i);
      ASSERT_NEAR(table.pmf(i) / (w[i] / sum), 1, 1e-6) << i;
    }
  }
}

// pbrt-v4: in a two-dimensional table of the same sky, cells in the row of the sun, to its right, get a wrong mass.
TEST(PeerDefects, CellsInTheRowOfTheSunHaveTheirMass) {
  const std::size_t row = 100, sun = row * sky_width + 10;
  const std::vector<double> w = sky(sun, 1e8);
  const double sum = total(w);
  const mc::TableDist2D<double> table(w, sky_width, sky_height);
  for (std::size_t x = 0; x < sky_width; ++x)
    ASSERT_NEAR(table.pmf(x, row) / (w[row * sky_width + x] / sum), 1, 1e-6) << x;
}

// pbrt-v4: tables with only zero weights give pdf NaN or 0, and one infinite weight makes everything NaN. A negative
// weight counts as its absolute value, and denormal weights sum to 0. SampleDiscrete has the same defects, and the
// alias table fails for zero weights.
TEST(PeerDefects, WeightsThatAreNoneAndWeightsAtTheEndsOfTheRange) {
  const double inf = std::numeric_limits<double>::infinity(), tiny = std::numeric_limits<double>::denorm_min(),
               huge = std::numeric_limits<double>::max();
  for (const std::vector<double>& w :
       std::vector<std::vector<double>>{{0, 0}, {1, inf}, {1, std::nan("")}, {1, -5}, {}}) {
    EXPECT_THROW(mc::TableDist1D<float>{w}, mc::Error);
    EXPECT_THROW(mc::AliasTable{w}, mc::Error);
    if (!w.empty()) {
      EXPECT_THROW((mc::TableDist2D<float>(w, 2, 1)), mc::Error);
    }
  }
  for (const double value : {tiny, 1e-45, 1e-40, 1e38, 3e38, huge}) {
    const std::vector<double> w(16, value);
    EXPECT_EQ(mc::TableDist1D<float>(w).pdf(0.37f), 1.0f) << value;
    EXPECT_EQ(mc::AliasTable(w).pmf(3), 1.0 / 16) << value;
    EXPECT_EQ((mc::TableDist2D<float>(w, 4, 4).pdf({0.37f, 0.1f})), 1.0f) << value;
  }
}

// pbrt-v4: large alias tables sample some entries far too often, and with zeros also entries of weight 0. Computes the
// probabilities that the bins imply from the point in each bin where the outcome changes.
TEST(PeerDefects, AliasTablesSampleWhatTheySay) {
  constexpr std::size_t size = 65536;
  for (const bool zeros : {false, true}) {
    std::vector<double> w(size), mass(size);
    for (std::size_t i = 0; i < size; ++i) w[i] = zeros && i % 2 ? 0 : mc::hash_uniform<double>(9, i);
    if (zeros) w[7] = 1e6;
    const mc::AliasTable table(w);
    for (std::size_t i = 0; i < size; ++i) {
      const auto outcome = [&](double v) { return table.sample_index((static_cast<double>(i) + v) / size).index; };
      const std::size_t first = outcome(0), second = outcome(1 - 0x1p-30);
      double lo = 0, hi = 1;
      while (first != second && hi - lo > 0x1p-32) (outcome((lo + hi) / 2) == first ? lo : hi) = (lo + hi) / 2;
      mass[first] += hi / size;
      mass[second] += (1 - hi) / size;
    }
    const double sum = total(w);
    for (std::size_t i = 0; i < size; ++i) {
      ASSERT_NEAR(table.pmf(i), w[i] / sum, 1e-15);
      ASSERT_TRUE(w[i] > 0 || mass[i] == 0) << i;
      // Bisection locates the change in each bin to 2^-30 of the bin.
      ASSERT_NEAR(mass[i], table.pmf(i), 0x1p-29 * (1.0 / size + table.pmf(i))) << i;
    }
  }
}

} // namespace

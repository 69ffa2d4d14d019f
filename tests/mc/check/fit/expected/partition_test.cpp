#include <mc/check/fit/expected/partition.h>

#include <mc/core/error.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using Point = mc::Partition::Coordinates;

std::vector<Point> draw(int dim, int n, std::uint64_t seed, double power) {
  mc::Pcg random(seed);
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) {
    Point p{};
    for (int d = 0; d < dim; ++d) p[static_cast<std::size_t>(d)] = std::pow(random.uniform<double>(), power);
    points.push_back(p);
  }
  return points;
}

TEST(ShortestBinaryFraction, IsTheShortest) {
  EXPECT_EQ(mc::shortest_binary_fraction(0.45, 0.55), 0.5);
  EXPECT_EQ(mc::shortest_binary_fraction(0.5, 0.8), 0.75);
  EXPECT_EQ(mc::shortest_binary_fraction(0.3, 0.5), 0.5);
  EXPECT_EQ(mc::shortest_binary_fraction(0, 1e-300), std::ldexp(1.0, std::ilogb(1e-300)));
}

TEST(Partition, CellsTileCubeWithEqualShares) {
  for (int dim = 1; dim <= 3; ++dim)
    for (const double power : {1.0, 20.0}) {
      const mc::Partition partition(draw(dim, 65536, 1, power), dim, 9);
      ASSERT_EQ(partition.size(), 512);
      double volume = 0;
      for (int i = 0; i < partition.size(); ++i) {
        const mc::UnitBox b = partition.box(i);
        double v = 1;
        Point middle{};
        for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) {
          v *= b.hi[d] - b.lo[d];
          middle[d] = 0.5 * (b.lo[d] + b.hi[d]);
        }
        volume += v;
        EXPECT_EQ(partition.cell(middle), i);
        EXPECT_EQ(partition.cell(b.lo), i);
      }
      EXPECT_NEAR(volume, 1, 1e-12);
      std::vector<int> counts(512);
      for (const Point& p : draw(dim, 65536, 2, power)) ++counts[static_cast<std::size_t>(partition.cell(p))];
      // 128 expected. Splits between the 45 % and 55 % quantiles at nine levels keep shares within a factor of 1.1^9 =
      // 2.4.
      for (const int c : counts) EXPECT_TRUE(c >= 30 && c <= 400) << c;
    }
}

TEST(Partition, AtomInPilot_GetsOwnCell) {
  std::vector<Point> pilot = draw(1, 1000, 3, 1);
  for (int i = 0; i < 1000; ++i) pilot.push_back({0.3, 0, 0});
  const mc::Partition partition(pilot, 1, 8);
  const mc::UnitBox b = partition.box(partition.cell({0.3, 0, 0}));
  EXPECT_LE(b.hi[0] - b.lo[0], 1e-3);
}

TEST(Partition, DegeneratePilots_AreAccepted) {
  EXPECT_EQ(mc::Partition({}, 2, 4).size(), 16);
  EXPECT_EQ(mc::Partition({{0.5, 0.5, 0}}, 2, 4).size(), 16);
  EXPECT_EQ(mc::Partition(std::vector<Point>(100), 3, 6).size(), 64);
  EXPECT_THROW(mc::Partition({}, 0, 4), mc::Error);
  EXPECT_THROW(mc::Partition({}, 2, 40), mc::Error);
}

// If no box may be narrower than 1/20, the remaining cells tile the cube and the others are empty.
TEST(Partition, UnsplittableBoxes_StayWhole) {
  const auto may_split = [](const mc::UnitBox& box, std::size_t axis, double place, const Point& beside) {
    EXPECT_TRUE(beside[axis] >= box.lo[axis] && beside[axis] <= box.hi[axis]);
    return std::min(place - box.lo[axis], box.hi[axis] - place) >= 0.05;
  };
  for (int dim = 1; dim <= 3; ++dim) {
    const mc::Partition partition(draw(dim, 65536, 5, 3), dim, 12, may_split);
    double whole = 0;
    int empty = 0;
    for (int i = 0; i < partition.size(); ++i) {
      const mc::UnitBox b = partition.box(i);
      double volume = 1, narrowest = 1;
      for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) {
        volume *= b.hi[d] - b.lo[d];
        narrowest = std::min(narrowest, b.hi[d] - b.lo[d]);
      }
      EXPECT_TRUE(narrowest == 0 || narrowest >= 0.05) << i;
      if (volume > 0) {
        EXPECT_EQ(partition.cell(b.lo), i);
      }
      empty += volume == 0;
      whole += volume;
    }
    EXPECT_GE(empty, partition.size() / 8);
    EXPECT_NEAR(whole, 1, 1e-12);
    const std::vector<Point> points = draw(dim, 4096, 6, 3);
    const std::vector<std::uint32_t> cells = partition.find_cells(points);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(static_cast<int>(cells[i]), partition.cell(points[i]));
  }
}

} // namespace

#include <mc/random/uniform.h>
#include <mc/table/table_dist_2d.h>
#include <mc/warp/concept.h>

#include <support/files.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

template <class S> class TableDist2DTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TableDist2DTest, Scalars);

static_assert(mc::InvertibleWarp<mc::TableDist2D<float>>);

std::vector<double> holes(std::size_t n) {
  std::vector<double> w(n);
  for (std::size_t i = 0; i < n; ++i)
    w[i] = mc::hash(5, i) % 2 == 0 ? 0 : std::pow(10.0, 60 * mc::hash_uniform<double>(6, i) - 30);
  return w;
}

TYPED_TEST(TableDist2DTest, NeverACellOfWeightZero) {
  using S = TypeParam;
  for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 49u}, {49u, 7u}, {100u, 50u}}) {
    auto w = holes(width * height);
    w.back() = 1;
    const mc::TableDist2D<S> table(w, width, height);
    for (int k = 0; k < 20000; ++k) {
      const S ends[] = {0, mc::one_minus_epsilon<S>, mc::hash_uniform<S>(k, 1), mc::hash_uniform<S>(k, 2)};
      const mc::Vec2<S> u{ends[k % 4], ends[k / 4 % 4]};
      const auto cell = table.sample_index(u);
      ASSERT_GT(w[cell.y * width + cell.x], 0);
      ASSERT_GT(cell.pmf, 0);
      ASSERT_EQ(cell.pmf, table.pmf(cell.x, cell.y));
      const mc::Vec2<S> x = table.sample(u);
      ASSERT_TRUE(table.domain().contains(x));
      ASSERT_NEAR(table.pdf(x), cell.pmf * S(width * height), 8 * std::numeric_limits<S>::epsilon() * table.pdf(x));
    }
  }
}

TYPED_TEST(TableDist2DTest, InvertsSamples) {
  using S = TypeParam;
  const mc::TableDist2D<S> table(std::vector<double>{1, 2, 0, 0, 0, 0, 3, 0, 1}, 3, 3);
  for (int k = 0; k < 10000; ++k) {
    const mc::Vec2<S> u{mc::hash_uniform<S>(k, 1), mc::hash_uniform<S>(k, 2)};
    EXPECT_LE((table.invert(table.sample(u)) - u).cwiseAbs().maxCoeff(), 8 * std::numeric_limits<S>::epsilon());
  }
}

TEST(TableDist2D, MassIsTheShareOfTheWeight) {
  std::vector<double> w(1024 * 512);
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = mc::hash_uniform<double>(7, i);
  w[200 * 1024 + 300] = 1e6;
  mc::CompensatedSum total;
  for (const double x : w) total.add(x);
  const double sum = total.value();
  const mc::TableDist2D<double> table(w, 1024, 512);
  for (std::size_t i = 0; i < w.size(); ++i) ASSERT_NEAR(table.pmf(i % 1024, i / 1024), w[i] / sum, 1e-15);
}

// A constant image of the sphere: the mass of each row is its share of the solid angle.
TEST(TableDist2D, LatLongWeighsBySolidAngle) {
  const auto table = mc::TableDist2D<double>::from_lat_long(std::vector<double>(8 * 16, 1.0), 16, 8);
  for (std::size_t y = 0; y < 8; ++y) {
    const double row = (std::cos(mc::pi<double> * static_cast<double>(y) / 8) -
                        std::cos(mc::pi<double> * static_cast<double>(y + 1) / 8)) /
                       2;
    EXPECT_NEAR(table.pmf(3, y) * 16, row, 1e-15);
  }
}

TEST(TableDist2D, RejectsNonsense) {
  const auto make = [](std::vector<double> w, std::size_t width, std::size_t height) {
    return mc::TableDist2D<float>(w, width, height);
  };
  EXPECT_THROW(make({1, 2, 3}, 2, 2), mc::Error);
  EXPECT_THROW(make({}, 0, 0), mc::Error);
  EXPECT_THROW(make({0, 0}, 2, 1), mc::Error);
  EXPECT_THROW(make({1, std::nan("")}, 2, 1), mc::Error);
  EXPECT_THROW(make({1, -1}, 1, 2), mc::Error);
  EXPECT_THROW(mc::TableDist2D<double>::from_lat_long({}, 4, 0), mc::Error);
}

TEST(TableDist2D, InverseLiesBelowOneUpToTheEdge) {
  const mc::TableDist2D<double> table(std::vector<double>{1, 2, 3, 4}, 2, 2);
  for (const mc::Vec2<double>& p : {mc::Vec2<double>(0.3, 1), mc::Vec2<double>(1, 0.3), mc::Vec2<double>(1, 1)}) {
    const mc::Vec2<double> u = table.invert(p);
    EXPECT_LT(u.maxCoeff(), 1);
    EXPECT_GT(table.pdf(table.sample(u)), 0);
  }
}

// Errors name the input weights, not the scaled ones.
TEST(TableDist2D, LatLongNamesTheWeightsThatItGot) {
  const auto refusal = [](const std::vector<double>& weights, std::size_t width, std::size_t height) {
    return support::error_of([&] { mc::TableDist2D<double>::from_lat_long(weights, width, height); });
  };
  EXPECT_THAT(refusal({1, -1, 1, 1}, 2, 2), testing::HasSubstr("weights[1] = -1 (column 1, row 0)"));
  EXPECT_EQ(refusal({1.5e308, 1}, 2, 1), "");
  EXPECT_EQ(refusal(std::vector<double>(200, 5e-324), 2, 100), "");
}

} // namespace

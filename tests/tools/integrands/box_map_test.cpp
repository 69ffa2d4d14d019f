#include <integrands/box_map.h>
#include <support/files.h>

#include <mc/core/types.h>
#include <mc/random/uniform.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace {

using carlo::BoxMap, carlo::VariableBounds;
const double box_end = mc::infinity<double>;

const std::vector<VariableBounds> every_kind = {
    {"a", -1, 3}, {"b", 2, box_end}, {"c", -box_end, -1}, {"d", -box_end, box_end}, {"e", 0, 1}};

TEST(BoxMap, UnmapInvertsMap) {
  const double spacing[] = {0x1p-51, 0x1p-51, 0x1p-51, 0x1p-51, 0}; // of a coordinate, relative to the larger bound
  for (std::size_t kind = 0; kind < every_kind.size(); ++kind) {
    const BoxMap box({every_kind[kind]});
    for (std::uint64_t i = 0; i < 10'000; ++i) {
      double u = mc::hash_uniform<double>(i, kind), x = 0, again = 0;
      if (i % 4 == 1) u = std::pow(u, 20);         // near one end
      if (i % 4 == 2) u = 1 - std::pow(u, 10) / 2; // and the other
      u = std::clamp(u, 0x1p-500, 1 - 0x1p-53);
      const double slope = box.map(std::span(&u, 1), std::span(&x, 1)),
                   inverse = box.unmap(std::span(&x, 1), std::span(&again, 1));
      ASSERT_NEAR(again, u, spacing[kind] + 8e-16 * u) << kind << " " << u;
      if (u > 1e-3 && u < 0.999) {
        ASSERT_NEAR(inverse / slope, 1, 1e-9) << kind << " " << u;
      }
    }
  }
}

// The slope is the derivative of the map, by central differences.
TEST(BoxMap, SlopeIsDeterminant) {
  for (const VariableBounds& s : every_kind) {
    const BoxMap box({s});
    for (const double u : {0.1, 0.37, 0.5, 0.81}) {
      const double h = 1e-6;
      double low = 0, high = 0, x = 0;
      box.map(std::vector{u - h}, std::span(&low, 1));
      box.map(std::vector{u + h}, std::span(&high, 1));
      EXPECT_NEAR((high - low) / (2 * h) / box.map(std::vector{u}, std::span(&x, 1)), 1, 1e-8) << s.name << " " << u;
    }
  }
}

TEST(BoxMap, PointsOutsideHaveNoSlope) {
  const BoxMap box({{"x", 0, 1}, {"y", 0, box_end}});
  std::vector<double> u(2);
  EXPECT_GT(box.unmap(std::vector{0.5, 5.0}, u), 0);
  for (const auto& x : {std::vector{1.5, 5.0}, {0.5, -1.0}, {0.0, 5.0}, {0.5, box_end}, {std::nan(""), 1.0}})
    EXPECT_EQ(box.unmap(x, u), 0) << x[0] << " " << x[1];
}

TEST(BoxMap, VolumeThatOverflowsIsRefused) {
  std::vector<VariableBounds> bounds(400, {"x", 0, 1e10});
  EXPECT_THAT(support::error_of([&] { BoxMap box(bounds); }), testing::HasSubstr("domain: the volume of the 400"));
  for (std::size_t i = 0; i < 200; ++i) bounds[i].hi = 1e-10;
  EXPECT_EQ(support::error_of([&] { BoxMap box(bounds); }), "");
}

TEST(BoxMap, DescribesTheFirstVariables) {
  const BoxMap box(carlo::unit_cube_bounds(20));
  const std::string text = box.describe(std::vector<double>(20, 0.25));
  EXPECT_THAT(text, testing::StartsWith("u0 = 0.25, u1 = 0.25"));
  EXPECT_THAT(text, testing::EndsWith("u7 = 0.25, ... (20 variables)"));
}

} // namespace

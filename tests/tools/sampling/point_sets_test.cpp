// Points lie strictly inside of the cube, also those whose bits are all 0 and those in float.

#include <sampling/point_sets.h>

#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#include <gtest/gtest.h>

namespace {

using carlo::PointSet, carlo::UnitCubeIntegral;

TEST(PointSets, LieStrictlyInside) {
  for (const PointSet& set : carlo::point_sets())
    for (const int dim : {1, 2, 3}) {
      UnitCubeIntegral e;
      e.name = "inside";
      e.dim = dim;
      e.f = [](UnitCubeIntegral::UnitPoint u) {
        for (const double x : u)
          if (!(x > 0 && x < 1)) return 1.0;
        return 0.0;
      };
      // A float is 0 once in 2^24 numbers.
      for (std::uint64_t seed = 0; seed < 8; ++seed) {
        EXPECT_EQ(set.mean_in_float(e, 1 << 18, seed), 0) << set.name << " " << dim;
        EXPECT_EQ(set.mean(e, 1 << 12, seed), 0) << set.name << " " << dim;
      }
    }
}

// A sampler whose bits are all 0, or all 1.
struct Ends {
  std::uint64_t value;
  std::uint64_t bits(std::uint64_t, std::uint32_t) const { return value; }
};

TEST(PointSets, EndsOfBitsAreInside) {
  EXPECT_EQ(mc::coordinate<float>(Ends{0}, 0, 0), 0x1p-25f);
  EXPECT_EQ(mc::coordinate<double>(Ends{0}, 0, 0), 0x1p-54);
  EXPECT_LT(mc::coordinate<float>(Ends{~0ULL}, 0, 0), 1);
  EXPECT_LT(mc::coordinate<double>(Ends{~0ULL}, 0, 0), 1);
}

TEST(PointSets, StratifiedPointsOfFloatsEqualTheirCoordinates) {
  const mc::Stratified s(97, 3, 5);
  std::vector<float> u(12);
  for (std::uint64_t index = 0; index < 300; ++index) {
    s.point(index, std::span(u));
    for (std::uint32_t d = 0; d < u.size(); ++d) ASSERT_EQ(u[d], mc::coordinate<float>(s, index, d));
  }
}

} // namespace

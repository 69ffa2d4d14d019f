#include <mc/estimate/integrate/sums.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using mc::detail::ScaledMoments;

std::vector<double> block(std::uint64_t seed, int power) {
  std::vector<double> x(256);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::ldexp(1 + mc::hash_uniform<double>(seed, i), power);
  return x;
}
ScaledMoments moments(std::uint64_t seed, int power) {
  ScaledMoments m;
  std::vector<double> x = block(seed, power);
  m.add(x, 0, std::ldexp(2.0, power));
  return m;
}

TEST(ScaledMoments, ErrorIsScaleInvariant) {
  const ScaledMoments plain = moments(1, 0);
  for (const int power : {-1000, -600, -200, 200, 600, 1000}) {
    const ScaledMoments m = moments(1, power);
    EXPECT_EQ(m.mean(), std::ldexp(plain.mean(), power));
    EXPECT_EQ(m.std_error(), std::ldexp(plain.std_error(), power));
  }
}

TEST(ScaledMoments, MergeAcrossScales) {
  for (const int power : {-900, 900}) {
    ScaledMoments zeros_first, zeros_last = moments(2, power);
    std::vector<double> zeros(256);
    zeros_first.add(zeros, 0, 0);
    const ScaledMoments none = zeros_first;
    zeros_first.merge(moments(2, power));
    zeros_last.merge(none);
    EXPECT_GT(zeros_first.std_error(), 0);
    EXPECT_EQ(zeros_first.mean(), zeros_last.mean());
    EXPECT_DOUBLE_EQ(zeros_first.std_error() / zeros_last.std_error(), 1);
  }
  ScaledMoments both = moments(3, 0); // the small values vanish beside the large ones
  both.merge(moments(3, 900));
  EXPECT_DOUBLE_EQ(both.mean(), moments(3, 900).mean() / 2);
  EXPECT_TRUE(std::isfinite(both.std_error()));
}

} // namespace

#include <mc/core/sum.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

TEST(CompensatedSum, SurvivesCancellation) {
  mc::CompensatedSum sum;
  for (const double x : {1.0, 1e100, 1.0, -1e100}) sum.add(x);
  EXPECT_EQ(sum.value(), 2.0);
}

TEST(CompensatedSum, TenMillionTenths) {
  mc::CompensatedSum sum;
  for (int i = 0; i < 10'000'000; ++i) sum.add(0.1);
  // The double nearest to 0.1, times 1e7, rounded once.
  EXPECT_LE(std::abs(sum.value() - static_cast<double>(1e7L * static_cast<long double>(0.1))), 2e-10);
}

TEST(InterleavedSum, AddsEachTermOnce) {
  for (const std::size_t n : {0u, 1u, 7u, 8u, 9u, 19u}) {
    std::vector<int> calls(n);
    const double sum = mc::interleaved_sum(n, [&](std::size_t i) {
      ++calls[i];
      return std::ldexp(1.0, static_cast<int>(i));
    });
    EXPECT_EQ(sum, std::ldexp(1.0, static_cast<int>(n)) - 1) << n;
    EXPECT_EQ(calls, std::vector<int>(n, 1)) << n;
  }
}

} // namespace

#include <mc/warp/logistic.h>

#include <mc/gtest/matchers.h>

#include <cmath>

namespace mc {
namespace {

template <class S> class LogisticOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(LogisticOver, Scalars);

TYPED_TEST(LogisticOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const double scale : {1e-4, 1.0, 1e4})
    EXPECT_WARP_LAWS(Logistic<S>(0, S(scale)), {.name = fmt::format("scale {}", scale),
                                                .statistics = {.samples = scale == 1 ? 50'000u : 0u},
                                                .invert_eps = 8,
                                                .pdf_eps = 16});
}

TYPED_TEST(LogisticOver, TrimmedObeysTheLawsInTailsAndOnShortIntervals) {
  using S = TypeParam;
  for (const auto& [lo, hi] : {std::pair{-1.0, 1.0},
                               {0.0, 5.0},
                               {-60.0, 70.0},
                               {40.0, 41.0},
                               {-41.0, -40.0},
                               {-1e-3, 1e-3},
                               {-300.0, 300.0}}) {
    const double condition = std::max({1.0, std::abs(lo), std::abs(hi)}) / (hi - lo);
    EXPECT_WARP_LAWS(TrimmedLogistic<S>(1, S(lo), S(hi)), {.name = fmt::format("[{}, {}]", lo, hi),
                                                           .statistics = {.samples = 0},
                                                           .invert_eps = 8 * std::max(1.0, condition),
                                                           .pdf_eps = 64});
  }
}

// A tail with a density next to the smallest number. Neither the pdf nor the ends lose precision.
TYPED_TEST(LogisticOver, TrimmedToATailAsThinAsTheScalarAllows) {
  using S = TypeParam;
  const double lo = sizeof(S) == sizeof(float) ? 80 : 700;
  for (const double length : {1e-3, 2e-3, 1.0, 20.0, 1000.0})
    for (const bool below : {false, true}) {
      const S a = S(below ? -lo - length : lo), b = S(below ? -lo : lo + length);
      // Fewer than 128 steps are too few for two cells.
      const S steps = (b - a) / (std::numeric_limits<S>::epsilon() * S(lo));
      EXPECT_WARP_LAWS(TrimmedLogistic<S>(1, a, b), {.name = fmt::format("[{}, {}]", a, b),
                                                     .statistics = {.samples = steps < 128 ? 0u : 20'000u},
                                                     .invert_eps = 8 * (lo + length) / std::min(1.0, length),
                                                     .pdf_eps = 64});
    }
}

TEST(Logistic, RefusesNonsense) {
  for (const double scale : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
    EXPECT_THROW((Logistic<double>(0, scale)), Error);
    EXPECT_THROW((TrimmedLogistic<double>(scale, 0, 1)), Error);
  }
  EXPECT_THROW((Logistic<double>(std::nan(""), 1)), Error);
  EXPECT_THROW((TrimmedLogistic<double>(1, 1, 1)), Error);
  EXPECT_THROW((TrimmedLogistic<double>(1, std::nan(""), 1)), Error);
  EXPECT_THROW((TrimmedLogistic<double>(1, 1000, 1001)), Error) << "its mass underflows";
}

} // namespace
} // namespace mc

#include <mc/warp/beckmann.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class BeckmannNormalsOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BeckmannNormalsOver, Scalars);

// r^2 stays below 6 for 256 random u, so the bound (8 + 8 r^2) eps stays below 56.
TYPED_TEST(BeckmannNormalsOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const double a : {1e-4, 1e-2, 0.3, 1.0}) {
    const BeckmannNormals<S> warp(S(a), S(0.5 * a));
    EXPECT_WARP_LAWS(warp, {.name = fmt::format("alpha {}", a),
                            .statistics = {.samples = a >= 0.3 ? 50'000u : 0u},
                            .invert_eps = 16,
                            .sample_eps = 16,
                            .pdf_eps = 56});
  }
}

TEST(BeckmannNormals, RefusesNonsense) {
  for (const double a : {0.0, -1.0, 1e-7, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(BeckmannNormals<double>(a, 0.1), Error);
    EXPECT_THROW(BeckmannNormals<double>(0.1, a), Error);
  }
}

} // namespace
} // namespace mc

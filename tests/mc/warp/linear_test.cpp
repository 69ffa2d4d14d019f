#include <mc/warp/linear.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class LinearOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(LinearOver, Scalars);

TYPED_TEST(LinearOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const auto& [a, b] : {std::pair{1.0, 1.0}, {0.0, 1.0}, {3.0, 1.0}, {1e-30, 1e30}, {1e30, 1e30}})
    EXPECT_WARP_LAWS(Linear<S>(S(a), S(b)), {.name = fmt::format("{} to {}", a, b),
                                             .statistics = {.samples = a <= 3 ? 50'000u : 0u},
                                             .invert_eps = 8,
                                             .sample_eps = 8,
                                             .pdf_eps = 16});
}

TEST(Linear, RefusesNonsense) {
  EXPECT_THROW(Linear<double>(0, 0), Error);
  EXPECT_THROW(Linear<double>(-1, 2), Error);
  EXPECT_THROW(Linear<double>(1, NAN), Error);
  EXPECT_THROW(Linear<double>(INFINITY, 1), Error);
}

} // namespace
} // namespace mc

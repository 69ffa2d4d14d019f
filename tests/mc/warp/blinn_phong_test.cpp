#include <mc/warp/blinn_phong.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class BlinnPhongOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BlinnPhongOver, Scalars);

TYPED_TEST(BlinnPhongOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const double n : {0.0, 0.5, 1.0, 10.0, 1e3, 1e7}) {
    const BlinnPhong<S> warp{S(n)};
    EXPECT_WARP_LAWS(warp, {.name = fmt::format("n {}", n),
                            .statistics = {.samples = n <= 10 ? 50'000u : 0u},
                            .invert_eps = 16,
                            .sample_eps = 16,
                            .pdf_eps = 32});
  }
}

TEST(BlinnPhong, RefusesNonsense) {
  for (const double n : {-1.0, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(BlinnPhong<double>{n}, Error);
}

} // namespace
} // namespace mc

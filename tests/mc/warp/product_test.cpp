#include <mc/warp/product.h>

#include <mc/gtest/matchers.h>
#include <mc/warp/hemisphere.h>

namespace mc {
namespace {

template <class S> class ProductOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ProductOver, Scalars);

TYPED_TEST(ProductOver, ObeysTheLaws) {
  using S = TypeParam;
  EXPECT_WARP_LAWS((Tent2D<S>{Tent<S>(0, 1), Tent<S>(0, S(1e-3))}),
                   {.name = "2-D tent", .statistics = {.samples = 0}, .points = 64, .invert_eps = 8, .pdf_eps = 16});
  EXPECT_WARP_LAWS(Normal2D<S>{}, {.name = "2-D normal", .statistics = {.samples = 0}, .points = 64, .pdf_eps = 32});
}

TEST(Product, JoinsPointsOfAnyDimension) {
  const Product both{CosineHemisphere<double>{}, Tent<double>{}};
  const auto x = both.sample({0.3, 0.6, 0.25});
  EXPECT_EQ(x.size(), 4);
  EXPECT_EQ(both.pdf(x), CosineHemisphere<double>{}.pdf(x.head<3>()) * Tent<double>{}.pdf(x[3]));
  EXPECT_NEAR((both.invert(x) - Vec3<double>(0.3, 0.6, 0.25)).norm(), 0, 1e-15);
}

} // namespace
} // namespace mc

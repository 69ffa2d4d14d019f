#include <mc/core/types.h>

#include <mc/check/subject/oracle.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using mc::Oracle;

TEST(Types, ConstantsReachThePrecisionOfTheirScalar) {
  EXPECT_EQ(mc::pi<double>, M_PI);
  EXPECT_LE(abs(mc::pi<Oracle> - Oracle("3.14159265358979323846264338327950288419716939937510582097494")),
            Oracle(1e-49));
  EXPECT_LT(mc::one_minus_epsilon<float>, 1.0f);
  EXPECT_EQ(std::nextafter(mc::one_minus_epsilon<float>, 2.0f), 1.0f);
  EXPECT_EQ(std::nextafter(mc::one_minus_epsilon<double>, 2.0), 1.0);
}

TEST(Types, SafeSqrtKeepsNaN) {
  EXPECT_EQ(mc::safe_sqrt(-1e-9f), 0.0f);
  EXPECT_EQ(mc::safe_sqrt(4.0), 2.0);
  EXPECT_TRUE(std::isnan(mc::safe_sqrt(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Types, ChooseTakesEitherSideWhole) {
  EXPECT_EQ(mc::choose(true, 1.5f, -2.0f), 1.5f);
  EXPECT_EQ(mc::choose(false, 1.5, -2.0), -2.0);
  EXPECT_EQ(mc::choose(false, std::numeric_limits<double>::quiet_NaN(), -0.0), 0.0);
  EXPECT_TRUE(std::isnan(mc::choose(true, std::numeric_limits<float>::quiet_NaN(), 1.0f)));
  EXPECT_EQ(mc::choose(true, Oracle(3), Oracle(4)), 3);
}

// Checks the bound of 1.5 ulp [JeannerodLouvetMuller13] on products that nearly cancel.
TEST(Types, DifferenceOfProductsDoesNotCancel) {
  mc::Pcg random(3);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const float a = random.uniform<float>() + 0.5f, b = random.uniform<float>() + 0.5f;
    const float c = b * (1 + 1e-6f * random.uniform<float>()), d = a;
    const double exact = double(a) * double(b) - double(c) * double(d); // exact: 24-bit products fit 53 bits
    const double got = mc::difference_of_products(a, b, c, d);
    if (exact != 0)
      worst = std::max(worst, std::abs(got - exact) / std::abs(exact) / std::numeric_limits<float>::epsilon());
  }
  EXPECT_LE(worst, 1.5);
}

// No vector may require more than the 16-byte alignment of every x86-64 and ARM64, for any compiler flags.
TEST(Types, VectorsAreLaidOutTheSameUnderAllFlags) {
  static_assert(alignof(mc::Vec<double, 4>) == alignof(double) && sizeof(mc::Vec<double, 4>) == 32);
  static_assert(alignof(mc::Vec<float, 8>) == alignof(float) && alignof(mc::Vec<double, 8>) == alignof(double));
  static_assert(alignof(mc::Vec2<double>) <= 16 && alignof(mc::Vec<float, 4>) <= 16 &&
                alignof(mc::Vec<double, 6>) <= 16);
  static_assert(std::is_same_v<mc::Vec3<double>, Eigen::Vector3d>);
}

} // namespace

#include <mc/check/subject/oracle.h>

#include <mc/core/error.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <thread>
#include <vector>

namespace {

TEST(Oracle, HasFiftyDigits) {
  const mc::Oracle root = sqrt(mc::Oracle(2));
  EXPECT_LE(abs(mc::Oracle(root * root - 2)), mc::Oracle("1e-49"));
  EXPECT_LE(abs(mc::Oracle(mc::pi<mc::Oracle> - mc::Oracle("3.14159265358979323846264338327950288419716939937510"))),
            mc::Oracle("1e-48"));
  static_assert(mc::Real<mc::Oracle>);
}

TEST(Oracle, WorksAsEigenScalar) {
  const mc::Vec3<mc::Oracle> v(1, 2, 2);
  EXPECT_EQ(v.norm(), 3);
}

TEST(Oracle, RoundTrip_DoubleIsExact) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double x : {0.0, -0.0, 1.0, -0.1, 5e-324, 1.7976931348623157e308, inf, -inf}) {
    EXPECT_EQ(static_cast<double>(mc::Oracle(x)), x);
    EXPECT_EQ(signbit(mc::Oracle(x)), std::signbit(x));
    EXPECT_EQ(isinf(mc::Oracle(x)), std::isinf(x));
  }
  const mc::Oracle nan = mc::Oracle(inf) - mc::Oracle(inf);
  EXPECT_TRUE(isnan(nan));
  EXPECT_FALSE(nan == nan || nan < nan || nan > nan || isfinite(nan));
  EXPECT_EQ(static_cast<long long>(mc::Oracle(-2.75)), -2);
  EXPECT_EQ(mc::Oracle(-9007199254740993LL) + 9007199254740992LL, -1);
  EXPECT_THROW(mc::Oracle("1.5x"), mc::Error);
}

TEST(Oracle, NumericLimits_AreConsistent) {
  using Limits = std::numeric_limits<mc::Oracle>;
  EXPECT_EQ(nextafter(mc::Oracle(1), 2) - 1, Limits::epsilon());
  EXPECT_GT(Limits::min(), 0);
  EXPECT_TRUE(isfinite(Limits::max()) && isinf(mc::Oracle(Limits::max() * 2)));
  EXPECT_EQ(Limits::lowest(), -Limits::max());
  EXPECT_TRUE(isinf(Limits::infinity()) && isnan(Limits::quiet_NaN()));
}

TEST(Oracle, Print_FollowsStreamPrecision) {
  std::ostringstream out;
  out << std::setprecision(20) << mc::Oracle("0.1") << ' ' << std::scientific << std::setprecision(2)
      << mc::Oracle(-250);
  EXPECT_EQ(out.str(), "0.1 -2.50e+02");
}

// From x = 2^-150, where erfc(x) is nearly 1, to x = 96, where it is far below the range of double. The bound is a few
// times the error of x for one unit in the last place of erfc(x).
TEST(Oracle, ErfcInvInvertsErfc) {
  mc::Pcg random(3);
  const mc::Oracle last = ldexp(mc::Oracle(1), -168);
  for (int i = 0; i < 300; ++i) {
    const int exponent = static_cast<int>(random.next32() % 157) - 150;
    const mc::Oracle x = ldexp(mc::Oracle(random.uniform<double>() + 0.5), exponent), p = erfc(x);
    const mc::Oracle each = last * exp(x * x);
    EXPECT_LE(abs(erfc_inv(p) - x), 8 * (last * x + p * each)) << x;
    if (x < 5) {
      EXPECT_LE(abs(erfc_inv(2 - p) + x), 8 * (last * x + 2 * each)) << x;
    }
  }
  EXPECT_EQ(erfc_inv(mc::Oracle(1)), 0);
  EXPECT_TRUE(isinf(erfc_inv(mc::Oracle(0))) && isinf(erfc_inv(mc::Oracle(2))) && isnan(erfc_inv(mc::Oracle(-1))));
}

// MPFR caches constants per thread: all threads get the same numbers.
TEST(Oracle, SameResultInEveryThread) {
  const mc::Oracle here = log(mc::Oracle(3)) * sin(mc::Oracle(2));
  std::vector<mc::Oracle> there(8);
  std::vector<std::thread> threads;
  for (mc::Oracle& x : there) threads.emplace_back([&x] { x = log(mc::Oracle(3)) * sin(mc::Oracle(2)); });
  for (std::thread& t : threads) t.join();
  for (const mc::Oracle& x : there) EXPECT_EQ(x, here);
}

} // namespace

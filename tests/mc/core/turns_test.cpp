#include <mc/core/turns.h>

#include <mc/check/subject/oracle.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace mc {
namespace {

// Error in units of the last place of the exact value, or of the smallest normal number near 0.
template <class S, class T> double ulps(S got, const T& exact) {
  using std::abs;
  const S near = abs(static_cast<S>(exact)), least = std::numeric_limits<S>::min();
  const S place = near > least ? std::nextafter(near, infinity<S>) - near : least;
  return static_cast<double>(T(abs(T(T(got) - exact)) / T(place)));
}

// Covers every multiple of 2^-24, all values of uniform<float>. The double version is an accurate reference: its error
// is 2^-29 float ulp.
TEST(Turns, CosSinOfEveryFloatUniformIsWithinTwoUlps) {
  double worst = 0;
  for (std::uint32_t i = 0; i < 1u << 24; ++i) {
    const float u = static_cast<float>(i) * 0x1p-24f;
    const auto got = cos_sin<float>(u);
    const auto exact = cos_sin<double>(double(u));
    const double off = std::max(ulps<float>(got.cos, exact.cos), ulps<float>(got.sin, exact.sin));
    worst = off <= worst ? worst : off;
  }
  EXPECT_LE(worst, 2);
}

// Compares double, and float between multiples of 2^-24, with 50 digits. Half of the points are close to the zeros.
template <class S> double worst_ulps() {
  Pcg random(12);
  double worst = 0;
  for (int i = 0; i < 20'000; ++i) {
    const S far = random.uniform<S>(), near = std::ldexp(far, -static_cast<int>(random.next32() % 40));
    const S u = i % 2 == 0 ? far : S(0.25) * S(i / 2 % 4) + near / 4;
    const auto got = cos_sin<S>(u);
    const auto exact = cos_sin<Oracle>(Oracle(u));
    const double off = std::max(ulps<S>(got.cos, exact.cos), ulps<S>(got.sin, exact.sin));
    worst = off <= worst ? worst : off;
  }
  return worst;
}

TEST(Turns, CosSinIsWithinTwoUlpsOfFiftyDigits) {
  EXPECT_LE(worst_ulps<float>(), 2);
  EXPECT_LE(worst_ulps<double>(), 2);
}

TEST(Turns, QuartersAreExact) {
  const double expected[5][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  for (int k = 0; k <= 4; ++k) {
    EXPECT_EQ(cos_sin<float>(float(k) / 4).cos, float(expected[k][0])) << k;
    EXPECT_EQ(cos_sin<float>(float(k) / 4).sin, float(expected[k][1])) << k;
    EXPECT_EQ(cos_sin<double>(k / 4.0).cos, expected[k][0]) << k;
    EXPECT_EQ(cos_sin<double>(k / 4.0).sin, expected[k][1]) << k;
  }
  EXPECT_EQ(polar_point<double>(3, 0.25), Vec2<double>(0, 3));
  EXPECT_EQ(polar_direction<double>(0.6, 0.8, 0.5), Vec3<double>(-0.6, 0, 0.8));
}

TEST(Turns, AzimuthStaysInTheUnitInterval) {
  EXPECT_EQ(azimuth_turns(0.0f, 0.0f), 0.0f);
  EXPECT_EQ(azimuth_turns(0.0f, 1.0f), 0.25f);
  const float below = azimuth_turns(1.0f, -std::numeric_limits<float>::denorm_min());
  EXPECT_TRUE(below >= 0 && below < 1) << below;
  EXPECT_LT(azimuth_turns(-1.0, -1e-300), 1.0);
  EXPECT_EQ(azimuth_turns(0.0, -1.0), 0.75);
  EXPECT_TRUE(std::isnan(azimuth_turns(std::nan(""), 1.0)));
  EXPECT_EQ(azimuth_turns(-infinity<double>, infinity<double>), 0.375);
}

// Points of every octant with sizes from denormal to the largest number, many near the axes and the diagonals.
template <class S> double worst_ulps_of_turn() {
  Pcg random(13);
  double worst = 0;
  for (int i = 0; i < 15'000; ++i) {
    const auto size = [&] {
      return std::ldexp(random.uniform<S>() + S(0.5), static_cast<int>(random.next32() % 60) - 60);
    };
    const auto another = [&](S a) {
      if (i % 3 == 0) return size();
      if (i % 3 == 1) return a * (1 + size());
      return a * (random.uniform<S>() + S(0.1));
    };
    const S a = size(), b = another(a);
    const int range = std::numeric_limits<S>::max_exponent - 8;
    const int move = i % 5 == 0 ? static_cast<int>(random.next32() % static_cast<std::uint32_t>(2 * range)) - range : 0;
    const auto sign = [&] { return random.next32() % 2 ? S(1) : S(-1); };
    const bool swapped = random.next32() % 2;
    const S x = sign() * std::ldexp(swapped ? a : b, move), y = sign() * std::ldexp(swapped ? b : a, move);
    const Oracle exact = azimuth_turns<Oracle>(Oracle(x), Oracle(y));
    if (static_cast<S>(exact) < 1) worst = std::max(worst, ulps<S>(azimuth_turns(x, y), exact));
    else EXPECT_EQ(azimuth_turns(x, y), S(0));
  }
  return worst;
}

TEST(Turns, AzimuthIsWithinTwoUlpsOfFiftyDigits) {
  EXPECT_LE(worst_ulps_of_turn<float>(), 2);
  EXPECT_LE(worst_ulps_of_turn<double>(), 2);
}

} // namespace
TEST(Turns, TheOriginHasTheAzimuthZero) {
  for (const double x : {0.0, -0.0})
    for (const double y : {0.0, -0.0}) {
      EXPECT_EQ(mc::azimuth_turns(x, y), 0);
      EXPECT_FALSE(std::signbit(mc::azimuth_turns(x, y)));
    }
}

} // namespace mc

#include <mc/check/laws/find_breaks.h>

#include <mc/check/subject/oracle.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using testing::Contains;

TEST(FindBreaks, Jump_IsLocatedToLastBit) {
  for (const double at : {0.3, 0.5, 0.71234567, 1.0 / 3, 0.001}) {
    EXPECT_THAT(mc::find_breaks<double>([&](double t) { return std::vector{t < at ? t : t + 0.5}; }, 256, 4),
                Contains(at));
    const float narrow = static_cast<float>(at);
    EXPECT_THAT(mc::find_breaks<float>(
                    [&](float t) {
                      return std::vector{t, t < narrow ? 0.0f : 0.1f};
                    },
                    256, 4),
                Contains(narrow));
  }
}

TEST(FindBreaks, Kink_IsLocatedOverOracle) {
  using mc::Oracle;
  for (const double at : {0.3, 0.5, 0.71234567}) {
    const auto breaks = mc::find_breaks<Oracle>(
        [&](const Oracle& t) { return std::vector{t < at ? Oracle(t * t) : Oracle(t * t + (t - at) / 2)}; }, 48, 2);
    EXPECT_TRUE(std::any_of(breaks.begin(), breaks.end(), [&](const Oracle& t) { return abs(t - at) < 1e-15; })) << at;
  }
}

TEST(FindBreaks, SmoothMap_HasNoBreaks) {
  EXPECT_TRUE(mc::find_breaks<double>([](double t) { return std::vector{1 + t + 0.2 * t * t}; }, 256, 4).empty());
}

} // namespace

#include <render/texture/uv_map.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using render::UvMap, render::Vec2d;

TEST(UvMap, ScalesThenMovesThenRepeats) {
  EXPECT_LE((UvMap({2, 3}, {0.25, -0.5})({0.75, 0.25}) - Vec2d(0.75, 0.25)).norm(), 1e-15);
  EXPECT_EQ(UvMap()({-0.25, 7.5}), Vec2d(0.75, 0.5));
}

TEST(UvMap, StaysBelowOne) {
  EXPECT_LT(UvMap()({-1e-20, 0})[0], 1);
  mc::Pcg random(1);
  for (int i = 0; i < 10000; ++i) {
    const double size = std::exp2(60 * random.uniform<double>() - 30);
    const Vec2d p = UvMap({size, -size}, {0.1, 3})({random.uniform<double>() - 0.5, random.uniform<double>()});
    EXPECT_TRUE(p[0] >= 0 && p[0] < 1 && p[1] >= 0 && p[1] < 1) << p;
  }
}

TEST(UvMap, IsDefinedWhereItOverflows) {
  for (const double size : {1e30, 1e300, 1.7e308})
    for (const Vec2d& offset : {Vec2d(0, 0), Vec2d(1e308, -1e308), Vec2d(-1e308, 1e308)})
      for (const double uv : {0.3, 1.0, -1e30}) EXPECT_EQ(UvMap({size, -size}, offset)({uv, uv}), Vec2d(0, 0)) << size;
}

TEST(UvMap, RefusesWhatIsNotFinite) {
  EXPECT_THROW(UvMap({NAN, 1}), mc::Error);
  EXPECT_THROW(UvMap({1, 1}, {0, INFINITY}), mc::Error);
}

} // namespace

#include <render/texture/checkerboard.h>

#include "support/files.h"

namespace {

using render::Spectrum, render::Vec2d;

TEST(Checkerboard, TwoByTwoSquaresInAPeriod) {
  const Spectrum a(1, 0, render::Float(0.5)), b(0, 1, render::Float(0.25));
  const render::Checkerboard board(a, b, render::UvMap({2, 1}));
  for (double u : {0.1, 0.6, -0.4})
    for (double v : {0.2, 1.2}) {
      EXPECT_TRUE((board.eval({u, v}) == a).all()) << u << " " << v;
      EXPECT_TRUE((board.eval({u + 0.25, v}) == b).all()) << u << " " << v;
      EXPECT_TRUE((board.eval({u, v + 0.5}) == b).all()) << u << " " << v;
      EXPECT_TRUE((board.eval({u + 0.25, v + 0.5}) == a).all()) << u << " " << v;
    }
}

TEST(Checkerboard, NamesTheColourThatIsNoReflectance) {
  const Spectrum good = Spectrum::Ones(), bright(0, 2, 0), negative(0, 0, -1);
  const auto said = [](const Spectrum& a, const Spectrum& b) {
    return support::error_of([&] { render::Checkerboard(a, b).require_reflectance("paint"); });
  };
  EXPECT_EQ(said(good, 0 * good), "");
  EXPECT_EQ(said(bright, good), "paint: color0 (0, 2, 0) must lie in [0, 1]");
  EXPECT_EQ(said(good, negative), "paint: color1 (0, 0, -1) must lie in [0, 1]");
}

} // namespace

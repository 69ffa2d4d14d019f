#include <render/texture/checkerboard.h>

#include <gtest/gtest.h>

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
  EXPECT_TRUE((board.largest() == Spectrum(1, 1, render::Float(0.5))).all());
  EXPECT_TRUE((board.smallest() == Spectrum(0, 0, render::Float(0.25))).all());
}

} // namespace

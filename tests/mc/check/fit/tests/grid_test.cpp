// The test of grids: correct densities that bins do not resolve pass, and local faults that the cells miss fail.

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>
#include <mc/domain/box.h>
#include <mc/random/hash.h>

#include <gtest/gtest.h>

namespace {

using mc::Pcg, mc::Report;
using Point = mc::Vec2<double>;

// The smallest p of the checks of grids; 1 without any.
double p_of_grids(const Report& r) {
  double p = 1;
  for (const mc::Check& c : r.checks)
    if (c.name.starts_with("grid")) p = std::min(p, *c.p);
  return p;
}
int number_of_grids(const Report& r) {
  return static_cast<int>(
      std::count_if(r.checks.begin(), r.checks.end(), [](const mc::Check& c) { return c.name.starts_with("grid"); }));
}

template <class Draw, class Pdf> Report check_square(Draw draw, Pdf pdf, std::uint64_t seed = 1) {
  return check_subject(mc::make_subject("square", mc::Square<double>{}, draw, pdf),
                       {.samples = 100'000, .seed = seed, .alpha = 0.01});
}

Point uniform(Pcg& r) {
  const double x = r.uniform<double>();
  return {x, r.uniform<double>()};
}

// 100 runs at 10 %: at most 21 with probability 0.9997. A tenth of alpha is spent by each of five grids.
TEST(Grid, UniformSamples_RejectedAtMostAtAlpha) {
  int rejected = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
    rejected += p_of_grids(check_square(
                    uniform, [](const Point&) { return 1.0; }, seed)) <= 0.02;
  EXPECT_LE(rejected, 21);
  EXPECT_GE(rejected, 1);
}

// 250 samples in one bin of 256 x 256, which a cell of the tree hides.
TEST(Grid, Spike_Fails) {
  const auto spike = [](Pcg& r) {
    const double u = r.uniform<double>();
    const Point p = uniform(r);
    return u < 0.0007 ? Point(0.301 + 0.002 * p[0], 0.602 + 0.001 * p[1]) : p;
  };
  const Report r = check_square(spike, [](const Point&) { return 1.0; });
  EXPECT_EQ(r.verdict(), mc::Verdict::fail);
  EXPECT_LE(p_of_grids(r), 1e-4);
}

// A texture that bins do not resolve has no grids.
TEST(Grid, Texture_HasNoGrids) {
  const auto pdf = [](const Point& p) {
    const auto texel = static_cast<std::uint64_t>(p[0] * 1000) * 1000 + static_cast<std::uint64_t>(p[1] * 1000);
    return mc::hash(texel) & 1 ? 1.5 : 0.5;
  };
  const auto draw = [pdf](Pcg& r) {
    for (;;)
      if (const Point p = uniform(r); r.uniform<double>() * 1.5 < pdf(p)) return p;
  };
  const Report r = check_square(draw, pdf);
  EXPECT_TRUE(r.passed()) << r.to_string();
  EXPECT_EQ(number_of_grids(r), 0);
}

// A bright square that lies between the points of its bin, or is hit by all of them.
TEST(Grid, BrightTexel_Passes) {
  for (const double size : {1e-5, 0.002, 0.003}) {
    const auto inside = [size](const Point& p) {
      return p[0] >= 0.3 && p[0] < 0.3 + size && p[1] >= 0.6 && p[1] < 0.6 + size;
    };
    const auto draw = [size](Pcg& r) {
      const bool bright = r.uniform<double>() < 0.5;
      const Point p = uniform(r);
      return bright ? Point(0.3 + size * p[0], 0.6 + size * p[1]) : p;
    };
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Report r = check_square(
          draw, [=](const Point& p) { return 0.5 + (inside(p) ? 0.5 / (size * size) : 0); }, seed);
      EXPECT_GT(p_of_grids(r), 1e-4) << size << " " << seed;
    }
  }
}

// Coordinates of 10 bits: bins are wider than the steps.
TEST(Grid, CoarseCoordinates_HaveWideBins) {
  mc::Subject s = mc::make_subject(
      "square", mc::Square<double>{},
      [](Pcg& r) {
        const Point p = uniform(r);
        return Point((std::floor(1024 * p[0]) + 0.5) / 1024, p[1]);
      },
      [](const Point&) { return 1.0; });
  s.resolution = [](const mc::Subject::Coordinates&, int) { return 1.0 / 1024; };
  EXPECT_GT(p_of_grids(check_subject(s, {.samples = 100'000})), 1e-3);
}

} // namespace

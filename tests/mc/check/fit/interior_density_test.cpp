#include <mc/check/fit/interior_density.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/interval.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using mc::Subject;

Subject pareto() {
  return make_subject(
      "Pareto", mc::HalfLine<double>(1, 1), [](mc::Pcg& r) { return 1 / mc::sqr(1 - r.uniform<double>()); },
      [](double x) { return 0.5 * std::pow(x, -1.5); });
}

TEST(InteriorDensity, InfiniteDomain_IsFiniteOnFaces) {
  const Subject s = pareto();
  EXPECT_TRUE(std::isfinite(interior_density(s, {1, 0, 0})));
  EXPECT_TRUE(std::isfinite(interior_density(s, {0, 0, 0})));
}

// Points close to 0 stay in place. The density at the face is taken so close to 0 that the chart of the line stays
// finite.
TEST(InteriorDensity, RealLine_FacesReturnTailDensity) {
  const Subject cauchy = make_subject(
      "Cauchy", mc::RealLine<double>(0, 1),
      [](mc::Pcg& r) { return std::tan(mc::pi<double> * (r.uniform<double>() - 0.5)); },
      [](double x) { return 1 / (mc::pi<double> * (1 + x * x)); });
  // There x = -1 / (2 v), so the density over v is 2 / pi.
  for (const double v : {0.0, 1e-300, 1e-100, 1e-20, 1 - 0x1p-53, 1.0})
    EXPECT_NEAR(interior_density(cauchy, {v, 0, 0}), 2 / mc::pi<double>, 1e-12) << v;
  const Subject root = make_subject(
      "root", mc::Interval<double>(0, 1), [](mc::Pcg& r) { return mc::sqr(r.uniform<double>()); },
      [](double x) { return 0.5 / std::sqrt(x); });
  EXPECT_NEAR(interior_density(root, {1e-100, 0, 0}), 0.5e50, 1e38);
  EXPECT_NEAR(interior_density(root, {1e-300, 0, 0}), 0.5e150, 1e138) << "where the chart has points";
}

TEST(InteriorDensity, AdjacentDensity_BreakAtSinglePoint_ReturnsNeighbour) {
  const auto on_unit = [](double (*pdf)(double)) {
    return make_subject(
        "f", mc::Interval<double>(0, 1), [](mc::Pcg& r) { return r.uniform<double>(); }, pdf);
  };
  const Subject arcsine = on_unit([](double x) { return 1 / (mc::pi<double> * std::sqrt(x * (1 - x))); });
  EXPECT_GT(adjacent_density(arcsine, {0, 0, 0}), 1e70);
  EXPECT_NEAR(adjacent_density(arcsine, {1, 0, 0}).value(), std::sqrt(0x1p53) / mc::pi<double>, 1);
  EXPECT_FALSE(adjacent_density(arcsine, {1 - 0x1p-53, 0, 0}));
  const Subject ramp = on_unit([](double x) { return 2 * x; });
  EXPECT_TRUE(adjacent_density(ramp, {0, 0, 0}));
  EXPECT_FALSE(adjacent_density(ramp, {1, 0, 0})) << "2 is a density";
  const Subject upper_half = on_unit([](double x) { return x < 0.5 ? 0.0 : 2.0; });
  EXPECT_FALSE(adjacent_density(upper_half, {0, 0, 0})) << "it is 0 beside the face too";
  EXPECT_EQ(adjacent_density(upper_half, {0.5 - 0x1p-54, 0, 0}), 2) << "a sampler rounds onto a jump";
  EXPECT_FALSE(adjacent_density(upper_half, {0.5 - 0x1p-40, 0, 0}));
  const Subject peak = on_unit([](double x) { return 0.5 / std::sqrt(std::abs(x - 0.5)); });
  EXPECT_TRUE(adjacent_density(peak, {0.5, 0, 0}));
  const Subject undefined = on_unit([](double x) { return x == 0.5 ? std::nan("") : 1.0; });
  EXPECT_FALSE(adjacent_density(undefined, {0.5, 0, 0}));
  // Far from 0, doubles do not resolve nearer points.
  const Subject shifted = make_subject(
      "shifted", mc::Interval<double>(1e6, 1e6 + 1), [](mc::Pcg& r) { return 1e6 + mc::sqr(r.uniform<double>()); },
      [](double x) { return 0.5 / std::sqrt(x - 1e6); });
  EXPECT_NEAR(adjacent_density(shifted, {0, 0, 0}).value(), 0x1p14, 0x1p11);
}

// In [1e6, 1e6 + 1], v = 1e-40 is rounded to 1e6, where the root is infinite.
TEST(InteriorDensity, AdjacentDensity_PointRoundedOntoEnd_ReturnsNeighbour) {
  const auto of = [](double (*pdf)(double)) {
    return make_subject(
        "f", mc::Interval<double>(1e6, 1e6 + 1), [](mc::Pcg& r) { return 1e6 + r.uniform<double>(); }, pdf);
  };
  const Subject root = of([](double x) { return 0.5 / std::sqrt(x - 1e6); });
  std::vector<Subject::Coordinates> v{{1e-40, 0, 0}, {0.25, 0, 0}};
  std::vector<double> densities(2);
  interior_densities(root, v, densities);
  EXPECT_GT(densities[0], 1e4);
  EXPECT_LT(densities[0], 1e5);
  EXPECT_EQ(densities[1], 1);
  EXPECT_EQ(interior_density(root, v[0]), densities[0]);
  EXPECT_TRUE(std::isinf(interior_density(of([](double) { return HUGE_VAL; }), v[0]))) << "and beside it";
}

TEST(InteriorDensity, BatchDensities_AreEvaluatedInOneCall) {
  Subject s = pareto();
  std::vector<Subject::Coordinates> v{{0, 0, 0}, {0.25, 0, 0}, {1, 0, 0}};
  std::vector<double> one_by_one(3), together(3);
  interior_densities(s, v, one_by_one);
  EXPECT_GT(v[0][0], 0);
  EXPECT_LT(v[2][0], 1);
  int questions = 0;
  s.densities = [&](std::span<const Subject::Coordinates> points, std::span<double> densities) {
    ++questions;
    for (std::size_t i = 0; i < points.size(); ++i) densities[i] = s.density(points[i]);
  };
  interior_densities(s, v, together);
  EXPECT_EQ(questions, 1);
  EXPECT_EQ(one_by_one, together);
  EXPECT_EQ(together[1], interior_density(s, {0.25, 0, 0}));
}

} // namespace

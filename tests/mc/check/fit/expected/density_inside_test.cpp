#include <mc/check/fit/expected/density_inside.h>

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

TEST(DensityInside, IsFiniteOnTheFacesOfAnInfiniteDomain) {
  const Subject s = pareto();
  EXPECT_TRUE(std::isfinite(density_inside(s, {1, 0, 0})));
  EXPECT_TRUE(std::isfinite(density_inside(s, {0, 0, 0})));
}

TEST(DensityInside, ManyAreAskedInOneQuestionWhereTheSubjectTakesIt) {
  Subject s = pareto();
  std::vector<Subject::Coordinates> v{{0, 0, 0}, {0.25, 0, 0}, {1, 0, 0}};
  std::vector<double> one_by_one(3), together(3);
  densities_inside(s, v, one_by_one);
  EXPECT_GT(v[0][0], 0);
  EXPECT_LT(v[2][0], 1);
  int questions = 0;
  s.densities = [&](std::span<const Subject::Coordinates> points, std::span<double> densities) {
    ++questions;
    for (std::size_t i = 0; i < points.size(); ++i) densities[i] = s.density(points[i]);
  };
  densities_inside(s, v, together);
  EXPECT_EQ(questions, 1);
  EXPECT_EQ(one_by_one, together);
  EXPECT_EQ(together[1], density_inside(s, {0.25, 0, 0}));
}

} // namespace

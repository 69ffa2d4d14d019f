#include <mc/check/fit/explanations/summary.h>

#include <gtest/gtest.h>

namespace {

mc::Cell cell(double p, double observed) {
  mc::Cell c;
  c.p = p;
  c.observed = observed;
  return c;
}

TEST(Summary, WorstCells_AreSortedAndOutcomesNamed) {
  mc::Subject s;
  s.dim = 1;
  s.describe_point = [](const mc::Subject::Coordinates& v) { return "x = " + std::to_string(v[0]).substr(0, 4); };
  const std::vector<mc::UnitBox> boxes{{{0, 0, 0}, {0.5, 1, 1}}, {{0.5, 0, 0}, {1, 1, 1}}};
  const std::vector<mc::Cell> cells{cell(0.25, 25), cell(0.25, 35), cell(0.5, 20)};
  const auto worst = worst_cells(s, boxes, cells, 100);
  ASSERT_EQ(worst.size(), 3u);
  EXPECT_EQ(worst[0].where, "outcome 0");
  EXPECT_EQ(worst[0].expected, 50);
  EXPECT_EQ(worst[1].where, "x = 0.75");
  EXPECT_EQ(worst[1].z, 2);
  mc::PlotData e;
  add_counts(boxes, cells, 100, e);
  ASSERT_EQ(e.cells.size(), 2u);
  ASSERT_EQ(e.outcomes.size(), 1u);
  EXPECT_EQ(e.cells[1].lo[0], 0.5);
  EXPECT_EQ(e.outcomes[0].observed, 20);
}

TEST(Summary, WorstRegion_JoinsCellsAndNeedsFourSigma) {
  mc::Subject s;
  s.dim = 1;
  s.axes = {{"x", mc::Axis::Scale::linear, 0, 8}};
  s.describe_point = [](const mc::Subject::Coordinates& v) { return std::to_string(8 * v[0]).substr(0, 4); };
  std::vector<mc::UnitBox> boxes;
  for (int i = 0; i < 4; ++i) boxes.push_back({{0.25 * i, 0, 0}, {0.25 * i + 0.25, 1, 1}});
  const auto worst = [&](double a, double b, double c, double d) {
    return describe_worst_region(s, boxes, {cell(0.25, a), cell(0.25, b), cell(0.25, c), cell(0.25, d)});
  };
  EXPECT_EQ(worst(1200, 1200, 800, 800),
            "region x 0 to 4, about 2.00, contains 2400 samples, 2000.0 expected (z = 12.6)");
  EXPECT_EQ(worst(1200, 1000, 900, 900), "cell x 0 to 2, about 1.00, contains 1200 samples, 1000.0 expected (z = 7.3)");
  EXPECT_EQ(worst(1010, 990, 1010, 990), "");
  EXPECT_EQ(mc::describe_worst_region({}, {}, {cell(0.5, 200), cell(0.5, 100)}),
            "outcome 0 has 200 samples, 150.0 expected (z = 5.8)");
}

TEST(Summary, NamedAxes_UnnamedAreNumbered) {
  mc::Subject s;
  s.dim = 2;
  s.axes = {{"r"}};
  const auto axes = named_axes(s);
  ASSERT_EQ(axes.size(), 2u);
  EXPECT_EQ(axes[0].name, "r");
  EXPECT_EQ(axes[1].name, "v1");
  s.dim = 0;
  EXPECT_TRUE(named_axes(s).empty());
}

} // namespace

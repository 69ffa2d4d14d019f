#include <mc/check/summary.h>

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

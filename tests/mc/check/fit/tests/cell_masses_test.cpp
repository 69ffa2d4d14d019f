#include <mc/check/fit/tests/cell_masses.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/interval.h>

#include <gtest/gtest.h>

namespace {

TEST(CellMasses, AddUpToTheDensityBetweenTheFacesOfEachCell) {
  const mc::Subject s = make_subject(
      "linear", mc::Interval<double>(0, 1), [](mc::Pcg& r) { return std::sqrt(r.uniform<double>()); },
      [](double x) { return 2 * x; });
  const mc::CellMasses m = integrate_cells(s, draw_pilot(s, 3, 100'000), 1e5, 100'000);
  ASSERT_EQ(m.partition.size(), 256);
  for (int i = 0; i < 256; ++i) {
    const mc::UnitBox box = m.partition.box(i);
    EXPECT_NEAR(m.cells[static_cast<std::size_t>(i)].p, mc::sqr(box.hi[0]) - mc::sqr(box.lo[0]), 1e-12);
  }
  EXPECT_NEAR(m.integrals.total.value, 1, 1e-12);
}

TEST(CellMasses, CellsHoldTwoHundredSamples) {
  EXPECT_EQ(mc::tree_depth(100), 0);
  EXPECT_EQ(mc::tree_depth(400), 1);
  EXPECT_EQ(mc::tree_depth(1e6), 12);
  EXPECT_EQ(mc::tree_depth(1e9), 12);
}

} // namespace

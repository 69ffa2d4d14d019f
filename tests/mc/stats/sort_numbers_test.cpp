#include <mc/stats/sort_numbers.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using mc::Pcg;

template <class F> void expect_sorted(const char* what, F number) {
  Pcg random(3);
  std::vector<double> values;
  for (int i = 0; i < 40'000; ++i) values.push_back(number(random, i));
  std::vector<double> expected = values;
  std::sort(expected.begin(), expected.end());
  mc::sort_numbers(values);
  EXPECT_EQ(values, expected) << what;
}

double with_infinities(Pcg&, int i) {
  if (i == 7) return HUGE_VAL;
  return i == 9 ? -HUGE_VAL : 1.0 / i;
}

TEST(SortNumbers, Ascending) {
  expect_sorted("even", [](Pcg& r, int) { return r.uniform<double>(); });
  expect_sorted("crowded at 0", [](Pcg& r, int i) { return (r.uniform<double>() - 0.25) * std::exp2(-i % 60); });
  expect_sorted("crowded at two scales",
                [](Pcg& r, int i) { return i % 9 == 0 ? r.uniform<double>() : 0.3 + 1e-12 * r.uniform<double>(); });
  expect_sorted("zeros of both signs", [](Pcg&, int i) { return i % 3 == 0 ? -0.0 : i % 3 - 1.0; });
  expect_sorted("all equal", [](Pcg&, int) { return 0.3; });
  expect_sorted("infinite", with_infinities);
  expect_sorted("tiny range", [](Pcg& r, int) { return 1e-310 * r.uniform<double>(); });
  expect_sorted("huge range", [](Pcg& r, int) { return 1.5e308 * (r.uniform<double>() - 0.5); });
}

TEST(SortNumbers, Few) {
  std::vector<double> values{3, -1, 2};
  mc::sort_numbers(values);
  EXPECT_EQ(values, (std::vector<double>{-1, 2, 3}));
  values.clear();
  mc::sort_numbers(values);
  EXPECT_TRUE(values.empty());
}

} // namespace

#include <mc/check/table.h>

#include <mc/check/run_tests.h>

#include <gtest/gtest.h>

namespace {

// Sum over the rows for the subject with every optional part, which all tests but correlation and axes need.
double sum_of_shares(int dim) {
  mc::Subject s;
  s.dim = dim;
  s.may_fail = true;
  s.inverted = [](std::uint64_t, std::size_t) { return std::vector<mc::Subject::Coordinates>{}; };
  double sum = 0;
  for (const mc::FitTestRow& row : mc::fit_tests())
    if (row.applies(s)) sum += share_of(row, s);
  return sum;
}

TEST(FitTests, Shares_SumToOne) {
  EXPECT_LE(sum_of_shares(0), 1);
  for (const int dim : {1, 2, 3}) EXPECT_NEAR(sum_of_shares(dim), 1, 1e-12) << dim;
}

TEST(FitTests, Shares_FollowTheNumberOfAxes) {
  constexpr mc::AlphaShare share{0.1, 0.2, 0.3};
  EXPECT_EQ(share.at_dimension(0), 0.1);
  EXPECT_EQ(share.at_dimension(1), 0.2);
  EXPECT_EQ(share.at_dimension(2), 0.3);
  EXPECT_EQ(share.at_dimension(3), 0.3);
}

} // namespace

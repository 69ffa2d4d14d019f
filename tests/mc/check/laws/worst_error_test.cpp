#include <mc/check/laws/worst_error.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

TEST(WorstError, KeepsLargestErrorAndItsWitness) {
  mc::WorstError error("law", 1, mc::Fault::inverse);
  for (const double e : {0.5, 3.0, 0.9, 2.0}) error.note(e, [e] { return std::to_string(e); });
  const mc::Check c = error.check();
  EXPECT_EQ(c.verdict, mc::Verdict::fail);
  EXPECT_EQ(c.statistic, 3);
  EXPECT_EQ(c.detail, "3.000000; 2 of 4 points break this law");
}

TEST(WorstError, AtLimitPasses_NanFails) {
  mc::WorstError good("law", 1, mc::Fault::inverse);
  good.note(1, [] { return std::string(); });
  EXPECT_EQ(good.check().verdict, mc::Verdict::pass);
  EXPECT_EQ(good.check().statistic, 1);
  mc::WorstError bad("law", 1, mc::Fault::inverse);
  bad.note(std::nan(""), [] { return std::string("nan"); });
  bad.note(7, [] { return std::string("7"); });
  EXPECT_EQ(bad.check().verdict, mc::Verdict::fail);
  EXPECT_EQ(bad.check().detail, "nan; 2 of 2 points break this law");
}

} // namespace

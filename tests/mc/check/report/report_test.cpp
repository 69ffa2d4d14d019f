#include <mc/check/report/report.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using mc::Fault, mc::Report, mc::Verdict;

TEST(Report, FailBeatsInconclusiveBeatsPass) {
  Report r;
  EXPECT_EQ(r.verdict(), Verdict::pass);
  EXPECT_EQ(r.p(), 1);
  r.checks.push_back({"a", Verdict::inconclusive, 0.2, 0.5, 1, 0, Fault::shape, "why"});
  EXPECT_EQ(r.verdict(), Verdict::inconclusive);
  EXPECT_EQ(r.fault(), Fault::none);
  r.checks.push_back({"b", Verdict::fail, 0.001, 0.5, 1, 0, Fault::local, "there"});
  EXPECT_EQ(r.verdict(), Verdict::fail);
  EXPECT_NEAR(r.p(), 1 - 0.999 * 0.999, 1e-12);
  EXPECT_EQ(r.fault(), Fault::local);
  r.checks.push_back({"c", Verdict::fail, {}, 0, 2, 1, Fault::mass, "by much"});
  EXPECT_EQ(r.fault(), Fault::mass) << "a broken law says more than a small p";
}

TEST(Report, EndsOfUDoNotNameTheFaultOfCountsBeyondDoubt) {
  Report r;
  r.checks.push_back({"ends of u", Verdict::fail, {}, 0, 1, 0, Fault::edge, "at u = 1"});
  EXPECT_EQ(r.fault(), Fault::edge);
  r.checks.push_back({"cells", Verdict::fail, 1e-6, 0.5, 1, 0, Fault::shape, "there"});
  EXPECT_EQ(r.fault(), Fault::edge);
  r.checks.back().p = 1e-12;
  EXPECT_EQ(r.fault(), Fault::shape);
  r.checks.front().fault = Fault::leak;
  EXPECT_EQ(r.fault(), Fault::leak) << "of other laws nothing takes the name";
  r.checks.front().fault = Fault::physics;
  EXPECT_EQ(r.fault(), Fault::shape) << "but of energy, which is weighed by the density";
}

TEST(Report, TextSaysWhereAndByHowMuch) {
  Report r;
  r.subject = "Cone";
  r.checks.push_back({"mass", Verdict::fail, {}, 0, 0.003, 1e-6, Fault::mass, "integrates to 1.003"});
  r.worst.push_back({{0, 0.25, 0}, {0.5, 0.5, 1}, 120, 64, 7, "(0, 0, 1)"});
  EXPECT_EQ(testing::PrintToString(r), r.to_string());
  EXPECT_THAT(r.to_string(),
              testing::AllOf(testing::HasSubstr("Cone: fail"),
                             testing::HasSubstr("mass fail: 0.003, limit 1e-06; integrates to 1.003"),
                             testing::Not(testing::HasSubstr("observed")), testing::HasSubstr("likely fault: mass")));
}

TEST(Report, CellsReadInTheCoordinatesOfTheDomain) {
  Report r;
  r.axes = {{"theta", mc::Axis::Scale::polar, 0, 1}, {"phi", mc::Axis::Scale::azimuth, 0, 1}};
  r.checks.push_back({"cells", Verdict::fail, 1e-9, 0.1, 7, 0, Fault::local, ""});
  r.worst.push_back({{0, 0.25, 0}, {0.5, 0.5, 1}, 120, 64, 7, "(0, 0, 1)"});
  r.worst.push_back({{}, {}, 12, 3, 5.2, "outcome 4"});
  EXPECT_THAT(r.to_string(),
              testing::AllOf(testing::HasSubstr("cell theta 0 to 60 deg, phi 90 to 180 deg at (0, 0, 1): observed 120"),
                             testing::HasSubstr("\n  outcome 4: observed 12, expected 3.0, z = 5.2")));
}

TEST(Report, EveryFaultAndVerdictHasAName) {
  for (int i = 0; i <= static_cast<int>(Fault::bias); ++i) EXPECT_GT(name(static_cast<Fault>(i)).size(), 3u) << i;
  for (const Verdict v : {Verdict::pass, Verdict::fail, Verdict::inconclusive}) EXPECT_GT(name(v).size(), 3u);
}

} // namespace

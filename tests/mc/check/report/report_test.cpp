#include <mc/check/report/report.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using mc::Fault, mc::Report, mc::Verdict;

TEST(Report, Verdict_FailBeatsInconclusiveBeatsPass) {
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

TEST(Report, Fault_SignificantCounts_OverrideBoundary) {
  Report r;
  r.checks.push_back({"ends of u", Verdict::fail, {}, 0, 1, 0, Fault::boundary, "at u = 1"});
  EXPECT_EQ(r.fault(), Fault::boundary);
  r.checks.push_back({"cells", Verdict::fail, 1e-6, 0.5, 1, 0, Fault::shape, "there"});
  EXPECT_EQ(r.fault(), Fault::boundary);
  r.checks.back().p = 1e-12;
  EXPECT_EQ(r.fault(), Fault::shape);
  r.checks.front().fault = Fault::zero_pdf;
  EXPECT_EQ(r.fault(), Fault::zero_pdf) << "of other laws nothing takes the name";
  r.checks.front().fault = Fault::physics;
  EXPECT_EQ(r.fault(), Fault::shape) << "but of energy, which is weighed by the density";
}

// A broken law is certain: its text has no p, although statistical tests have one.
TEST(Report, TextOfABrokenLaw_BeginsWithTheFindingAndHasNoP) {
  Report r;
  r.subject = "Grey";
  r.checks.push_back({"KS, x", Verdict::pass, 0.4, 1, 0.01, 0, Fault::shape, ""});
  r.checks.push_back({"weight = f / pdf",
                      Verdict::fail,
                      {},
                      0,
                      0.2,
                      1e-3,
                      Fault::weight,
                      "weight is 0.6, should be 0.5, at u = (0.1, 0.2); 7 of 20 samples"});
  EXPECT_EQ(r.finding(), "weight is 0.6, should be 0.5, at u = (0.1, 0.2)");
  EXPECT_EQ(r.to_string(), "Grey: fail: weight is 0.6, should be 0.5, at u = (0.1, 0.2)\n"
                           "  likely cause: weight: a stated weight, pdf or f differs from eval and pdf\n"
                           "  law: weight = f / pdf (largest error 0.2, limit 0.001); 7 of 20 samples");
  EXPECT_EQ(testing::PrintToString(r), r.to_string());
  EXPECT_FALSE(r.is_statistical());
}

TEST(Report, TextOfAFailedTest_HasPAndItsFinding) {
  Report r;
  r.subject = "Cone";
  r.samples = 20'000;
  r.axes = {{"theta", mc::Axis::Scale::polar, 0, 1}, {"phi", mc::Axis::Scale::azimuth, 0, 1}};
  r.checks.push_back({"single cells", Verdict::fail, 1e-9, 0.1, 7, 0, Fault::local, "there are too many; by far"});
  r.worst.push_back({{0, 0.25, 0}, {0.5, 0.5, 1}, 120, 64, 7, "(0, 0, 1)"});
  r.worst.push_back({{}, {}, 12, 3, 5.2, "outcome 4"});
  r.worst.push_back({{}, {}, 12, 8, 1.4, "outcome 5"});
  EXPECT_EQ(r.to_string(), "Cone: fail, p = 1e-08 (20000 samples, alpha 0.01): there are too many\n"
                           "  likely cause: local: single cells contain too many or too few samples\n"
                           "  test: single cells (p = 1e-09); by far");
  const std::string full = r.to_string(mc::ReportText::full);
  EXPECT_THAT(full, testing::HasSubstr("\n  cell theta 0 to 60 deg, phi 90 to 180 deg, about (0, 0, 1), contains 120 "
                                       "samples, 64.0 expected (z = 7.0)"));
  EXPECT_THAT(full, testing::EndsWith("\n  outcome 4 has 12 samples, 3.0 expected (z = 5.2)")) << "1.4 is chance";
}

TEST(Report, TextFoldsTheOtherChecks) {
  Report r;
  r.checks.push_back({"mass", Verdict::fail, {}, 0, 0.003, 1e-6, Fault::mass, "the density integrates to 1.003"});
  EXPECT_THAT(r.to_string(), testing::Not(testing::HasSubstr("more check")));
  r.checks.push_back({"KS, x", Verdict::fail, 1e-4, 0.5, 0.01, 0, Fault::shape, "D is off"});
  EXPECT_THAT(r.to_string(), testing::EndsWith("\n  1 more check fails"));
  r.checks.push_back({"tails, x", Verdict::fail, 1e-4, 0.5, 0.01, 0, Fault::shape, "there"});
  r.checks.push_back({"resolution, x", Verdict::inconclusive, {}, 0, 1, 2, Fault::none, "few values"});
  EXPECT_THAT(r.to_string(mc::ReportText::brief, "; --verbose shows them"),
              testing::EndsWith("\n  2 more checks fail, 1 is inconclusive; --verbose shows them"));
  const std::string full = r.to_string(mc::ReportText::full, "; --verbose shows them");
  EXPECT_THAT(full, testing::AllOf(testing::HasSubstr("\n  also fails: KS, x (p = 0.0001): D is off"),
                                   testing::HasSubstr("\n  inconclusive: resolution, x: few values"),
                                   testing::Not(testing::HasSubstr("--verbose"))));
}

TEST(Report, TextOfAPass_SaysWhatIsDetected) {
  Report r;
  r.subject = "Disk";
  r.samples = 20'000;
  r.checks.push_back({"KS, r", Verdict::pass, 0.42, 1, 0.01, 0, Fault::shape, ""});
  r.detectable = 0.12;
  r.detectable_cell = 1.5;
  EXPECT_EQ(r.to_string(), "Disk: pass, p = 0.42 (20000 samples, alpha 0.01); an error of the density of 12 % is "
                           "detected (more than 100 % in a single patch)");
  EXPECT_EQ(r.leading(), nullptr);
}

TEST(Report, TextOfAnInconclusiveCheck_SaysWhy) {
  Report r;
  r.checks.push_back({"resolution, x", Verdict::inconclusive, {}, 0, 1, 2, Fault::none, "x has few values"});
  EXPECT_EQ(r.to_string(), "inconclusive: x has few values\n  law: resolution, x");
}

TEST(Report, EveryFaultAndVerdict_HasName) {
  for (int i = 0; i <= static_cast<int>(Fault::bias); ++i) EXPECT_GT(name(static_cast<Fault>(i)).size(), 3u) << i;
  for (const Verdict v : {Verdict::pass, Verdict::fail, Verdict::inconclusive}) EXPECT_GT(name(v).size(), 3u);
}

} // namespace

#include <catalogue/looks.h>
#include <terminal/interrupt.h>

#include <mc/stats/multiple_testing.h>

#include <gtest/gtest.h>

#include <vector>

namespace {

using carlo::CaseOptions, carlo::check_in_looks;

// A check of one test with p-values that depend on the number of samples; it records its options.
struct Looks {
  std::vector<CaseOptions> seen = {};
  double p = 0.5;
  std::uint64_t interrupted_from = ~0ull;

  mc::Report operator()(const CaseOptions& o) {
    if (o.samples >= interrupted_from) throw carlo::Interrupted();
    seen.push_back(o);
    mc::Report r;
    r.alpha = o.alpha;
    r.samples = o.samples;
    mc::Check c{"test", mc::Verdict::pass, p, 1, 0, 0, mc::Fault::shape, {}};
    if (p <= mc::sidak_level(o.alpha, 1)) c.verdict = mc::Verdict::fail;
    r.checks.push_back(c);
    return r;
  }
};

carlo::LookReport run(Looks& looks, std::uint64_t samples) {
  return check_in_looks([&](const CaseOptions& o) { return looks(o); }, {.samples = samples, .seed = 4, .alpha = 0.01});
}

TEST(Looks, FewSamples_AreOneLook) {
  Looks looks;
  const carlo::LookReport r = run(looks, 9'000'000);
  ASSERT_EQ(looks.seen.size(), 1u);
  EXPECT_EQ(looks.seen[0].samples, 9'000'000u);
  EXPECT_EQ(looks.seen[0].alpha, 0.01);
  EXPECT_EQ(looks.seen[0].seed, 4u);
  EXPECT_TRUE(r.is_complete);
}

TEST(Looks, ManySamples_ShareAlpha) {
  Looks looks;
  EXPECT_TRUE(run(looks, 3'000'000'000).report.passed());
  std::vector<std::uint64_t> samples;
  double none = 1; // probability that no look rejects a correct distribution
  for (const CaseOptions& o : looks.seen) {
    samples.push_back(o.samples);
    none *= 1 - o.alpha;
  }
  EXPECT_EQ(samples, (std::vector<std::uint64_t>{1'000'000, 10'000'000, 100'000'000, 3'000'000'000}));
  EXPECT_NEAR(1 - none, 0.01, 1e-12);
  EXPECT_EQ(looks.seen.back().seed, 4u);
  EXPECT_NE(looks.seen[0].seed, looks.seen[1].seed);
}

// A sure verdict needs no more samples; its p-value is that of the whole check.
TEST(Looks, FailureEndsTheCheck) {
  Looks looks{.p = 1e-7};
  const carlo::LookReport r = run(looks, 3'000'000'000);
  EXPECT_EQ(looks.seen.size(), 1u);
  EXPECT_EQ(r.report.verdict(), mc::Verdict::fail);
  EXPECT_EQ(r.report.samples, 1'000'000u);
  EXPECT_NEAR(r.report.p(), 2e-6, 1e-9);
  EXPECT_TRUE(r.is_complete);
}

TEST(Looks, Interrupt_KeepsTheLastLook) {
  Looks looks{.interrupted_from = 100'000'000};
  const carlo::LookReport r = run(looks, 3'000'000'000);
  EXPECT_FALSE(r.is_complete);
  EXPECT_EQ(r.report.samples, 10'000'000u);
  Looks none{.interrupted_from = 0};
  EXPECT_THROW(run(none, 3'000'000'000), carlo::Interrupted);
}

} // namespace

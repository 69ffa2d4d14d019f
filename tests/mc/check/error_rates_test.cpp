// Random distributions: small runs of bench/mc/check/error_rates_bench.cpp with fixed seeds.

#include <mc/check/random_faults.h>
#include <mc/check/regression_subjects.h>

#include <mc/check/check_subject.h>

#include <gtest/gtest.h>

namespace {

using mc::Verdict;

// Each is rejected by chance with probability 1e-4.
TEST(CheckerErrorRates, RandomCorrectDistributions_Pass) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const mc::Report r =
        check_subject(checker_bench::random_correct(seed), {.samples = 50'000, .seed = 100 + seed, .alpha = 1e-4});
    EXPECT_TRUE(r.passed()) << seed << ": " << r.to_string();
  }
}

// Ridges and lobes in thin layers. An integral that misses them expects too few samples. Each is rejected by chance
// with probability 1e-3.
TEST(CheckerErrorRates, MassInThinLayers_IsNotMissed) {
  for (const std::uint64_t seed : {284u, 3407u, 3768u}) {
    const mc::Report r =
        check_subject(checker_bench::random_correct(seed), {.samples = 100'000, .seed = seed, .alpha = 1e-3});
    EXPECT_TRUE(r.passed()) << seed << ": " << r.to_string();
  }
}

// Narrow features, with thin layers next to them that contain few samples. Each is rejected by chance with probability
// 1e-4.
TEST(CheckerErrorRates, NarrowFeatures_Pass) {
  for (const std::uint64_t seed : {33u, 128u, 178u, 200u, 255u}) {
    const mc::Report r =
        check_subject(checker_bench::random_narrow(seed), {.samples = 50'000, .seed = seed, .alpha = 1e-4});
    EXPECT_TRUE(r.passed()) << seed << ": " << r.to_string();
  }
}

// Poles at ends, simplices, lobes of any width in float and double, and up to 1e7 outcomes. Each is rejected by chance
// with probability 1e-4. A lobe narrower than its rounding steps is inconclusive.
TEST(CheckerErrorRates, RoundedDistributions_AreNotRejected) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const mc::Report r = check_subject(checker_bench::random_rounded(seed),
                                       {.samples = 50'000, .seed = seed, .alpha = 1e-4, .open_interval = true});
    const bool is_coarse = std::any_of(r.checks.begin(), r.checks.end(),
                                       [](const mc::Check& c) { return c.fault == mc::Fault::rounding; });
    EXPECT_TRUE(r.passed() || (is_coarse && r.verdict() == Verdict::inconclusive)) << seed << ": " << r.to_string();
  }
}

// Henyey-Greenstein by a formula that cancels. The density of float points errs by up to a few per cent, and so does
// its integral. Each is rejected by chance with probability 1e-4.
TEST(CheckerErrorRates, LobesByCancellingFormulas_AreNotRejected) {
  for (int i = 0; i < 24; ++i) {
    const double one_minus_g = std::pow(10, -0.5 - 0.1 * i);
    const mc::Report r = check_subject(checker_bench::narrow_lobe(true, false, mc::sqr(one_minus_g)),
                                       {.samples = 50'000, .seed = 1, .alpha = 1e-4, .open_interval = true});
    EXPECT_NE(r.verdict(), Verdict::fail) << r.to_string();
    EXPECT_TRUE(one_minus_g < 0.02 || r.passed()) << r.to_string();
  }
}

// Each is missed with probability at most 0.01: more than 2 of 20 with probability 0.001.
TEST(CheckerErrorRates, FaultsOfStatedSize_AreFound) {
  int missed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const mc::SubjectOptions options{.samples = 50'000, .seed = seed, .alpha = 0.01};
    const mc::Subject right = checker_bench::random_continuous(seed);
    const checker_bench::FaultySubject wrong = checker_bench::stated_fault(right, check_subject(right, options), seed);
    missed += check_subject(wrong.subject, options).verdict() != Verdict::fail;
  }
  EXPECT_LE(missed, 2);
}

// Each correct subject is rejected by chance with probability 1e-4. The wrong subjects need a million samples. The
// clamped exponential has 7 expected samples at the clamp, including the pilot. It needs 2 equal samples, and has fewer
// with probability 0.01.
TEST(CheckerErrorRates, RegressionSubjects_AreJudgedCorrectly) {
  for (const checker_bench::RegressionSubject& f : checker_bench::regression_subjects()) {
    const mc::Report r = check_subject(
        f.subject, {.samples = f.right ? 150'000u : 1'000'000u, .seed = 3, .alpha = f.right ? 1e-4 : 0.01});
    EXPECT_EQ(r.verdict(), f.right ? Verdict::pass : Verdict::fail) << r.to_string();
  }
}

// The breaks of a table make the integral exact.
TEST(CheckerErrorRates, TableWithBreaks_MassIsExact) {
  mc::Pcg random(1);
  std::vector<double> weights(100 * 50);
  for (double& w : weights) w = random.uniform<double>();
  const mc::Subject s = checker_bench::table_subject("table", weights, 100, 50, true);
  EXPECT_EQ(s.breaks[0].size(), 99u);
  EXPECT_EQ(s.breaks[1].size(), 49u);
  EXPECT_NEAR(check_subject(s, {.samples = 100'000}).mass, 1, 1e-9);
}

} // namespace

#include <mc/check/fit/tests/marginal_bins.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/interval.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using mc::Pcg;

mc::Check strips(std::uint64_t seed, double alpha, const std::function<double(Pcg&)>& sample) {
  const mc::Subject s = make_subject(
      "uniform", mc::Interval<double>(0, 1), [](Pcg& r) { return r.uniform<double>(); }, [](double) { return 1.0; });
  const mc::Pilot pilot = draw_pilot(s, seed, 100'000);
  mc::MarginalBins strips(pilot, 1);
  Pcg random(seed, 3);
  for (int i = 0; i < 100'000; ++i) strips.add_sample({sample(random), 0, 0}, 1, 1);
  for (int i = 0; i < 50'000; ++i) strips.add_expected({random.uniform<double>(), 0, 0}, 1, 1);
  return strips.test(s, pilot, 100'000, 1, 1, alpha);
}

// 200 runs at 10 %: at most 36 with probability 0.9997.
TEST(MarginalBins, CorrectSamples_RejectedAtMostAtAlpha) {
  int rejected = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    rejected += strips(seed, 0.1, [](Pcg& r) { return r.uniform<double>(); }).verdict == mc::Verdict::fail;
  EXPECT_LE(rejected, 36);
}

TEST(MarginalBins, WrongThinLayer_Fails) {
  for (const double at : {0.0, 0.43, 0.998}) {
    const mc::Check layer = strips(1, 1e-3, [at](Pcg& r) {
      const double x = r.uniform<double>();
      return r.uniform<double>() < 3e-3 ? at + 2e-3 * x : x;
    });
    EXPECT_EQ(layer.verdict, mc::Verdict::fail) << at;
    EXPECT_THAT(layer.detail, testing::HasSubstr(" in ["));
  }
}

} // namespace

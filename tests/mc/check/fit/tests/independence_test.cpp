#include <mc/check/fit/tests/independence.h>

#include <mc/core/types.h>
#include <mc/random/pcg.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace {

using Coordinates = mc::Subject::Coordinates;

constexpr double alpha = 0.01;

mc::Report order(std::size_t n, const std::function<double(std::size_t, mc::Pcg&)>& value, std::uint64_t seed = 1) {
  mc::Pcg random(seed);
  std::vector<Coordinates> v(n);
  for (std::size_t i = 0; i < n; ++i) v[i][0] = value(i, random);
  mc::Report r;
  r.checks = mc::test_order(v, {{"x"}}, 1, seed, 1, alpha);
  return r;
}

// 1000 runs at 1 %: more than 22 rejections have probability 2e-4.
TEST(Independence, IndependentSamples_RejectedAtMostAtAlpha) {
  for (const double values : {2.0, 10.0, 1e9}) {
    int rejected = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed)
      rejected += !order(
                       2000, [&](std::size_t, mc::Pcg& r) { return std::floor(values * r.uniform<double>()); }, seed)
                       .passed();
    EXPECT_LE(rejected, 22) << values;
    EXPECT_GE(rejected, 2) << values;
  }
}

TEST(Independence, OrderedAndAlternatingSamples_Fail) {
  const auto fails = [](const std::function<double(std::size_t, mc::Pcg&)>& value) {
    const mc::Report r = order(5000, value);
    return r.fault() == mc::Fault::dependent;
  };
  EXPECT_TRUE(fails([](std::size_t i, mc::Pcg&) { return std::floor(static_cast<double>(i) / 10); })) << "sorted";
  EXPECT_TRUE(fails([](std::size_t i, mc::Pcg&) { return std::fmod(0.5 + 0.618034 * double(i), 1.0); })) << "Kronecker";
  EXPECT_TRUE(fails([](std::size_t i, mc::Pcg& r) { return (double(i % 2) + r.uniform<double>()) / 2; })) << "strata";
  double last = 0;
  EXPECT_TRUE(fails([&](std::size_t, mc::Pcg& r) { return last = 0.2 * last + r.uniform<double>(); })) << "a chain";
  EXPECT_TRUE(fails([&](std::size_t i, mc::Pcg& r) {
    return last = i % 2 ? std::abs(last - 0.5) : r.uniform<double>();
  })) << "uncorrelated pairs";
}

TEST(Independence, FewSamples_AreNotTested) {
  EXPECT_TRUE(mc::test_order(std::vector<Coordinates>(999), {}, 1, 1, 1, alpha).empty());
}

TEST(Independence, EqualCounts_AreTooEvenAndRandomOnesAreNot) {
  const std::vector<double> p(500, 1.0 / 500), equal(500, 800);
  EXPECT_EQ(mc::test_evenness(equal, p, 0.02, alpha)[0].verdict, mc::Verdict::fail);
  int rejected = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    mc::Pcg random(seed);
    std::vector<double> counts(500);
    for (int i = 0; i < 20'000; ++i) counts[static_cast<std::size_t>(500 * random.uniform<double>())] += 1;
    rejected += mc::test_evenness(counts, p, 1, alpha)[0].verdict == mc::Verdict::fail;
  }
  EXPECT_LE(rejected, 11); // more with probability 2e-4
  EXPECT_TRUE(mc::test_evenness(std::vector<double>{5, 5}, std::vector<double>{0.5, 0.5}, 1, alpha).empty());
}

} // namespace

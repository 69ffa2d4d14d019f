#include <mc/check/subject/generator.h>

#include <mc/check/check_subject.h>

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace {

using mc::Fault, mc::Verdict;

template <class D, class Law> mc::Report check(const D& d, Law law) {
  return check_subject(mc::make_generator_subject("mine", d, law), {.samples = 100'000, .alpha = 1e-4});
}

double normal_pdf(double x) { return std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi); }
double normal_cdf(double x) { return std::erfc(-x / std::numbers::sqrt2) / 2; }
auto poisson_pmf(double mean) {
  return [=](double k) { return std::exp(k * std::log(mean) - mean - std::lgamma(k + 1)); };
}

// Thirteen correct distributions at 1e-4 each.
TEST(Generator, StandardDistributions_Pass) {
  const auto expect_pass = [](const mc::Report& r) { EXPECT_TRUE(r.passed()) << r.to_string(); };
  expect_pass(check(std::normal_distribution<double>(), normal_pdf));
  expect_pass(check(std::normal_distribution<float>(), normal_pdf));
  expect_pass(check(std::normal_distribution<double>(1e6, 1), [](double x) { return normal_pdf(x - 1e6); }));
  expect_pass(check(std::exponential_distribution<double>(2), [](double x) { return 2 * std::exp(-2 * x); }));
  expect_pass(check(std::uniform_real_distribution<double>(3, 5), [](double) { return 0.5; }));
  expect_pass(check(std::cauchy_distribution<double>(), [](double x) { return 1 / (std::numbers::pi * (1 + x * x)); }));
  expect_pass(check(std::normal_distribution<double>(), mc::ClaimedCdf(normal_cdf)));
  expect_pass(check(std::exponential_distribution<double>(), mc::ClaimedCdf([](double x) { return -std::expm1(-x); })));
  expect_pass(check(std::poisson_distribution<int>(4), poisson_pmf(4)));
  expect_pass(check(std::poisson_distribution<std::int64_t>(1e4), poisson_pmf(1e4)));
  expect_pass(check(std::geometric_distribution<int>(0.01), [](double k) { return 0.01 * std::pow(0.99, k); }));
  expect_pass(check(std::bernoulli_distribution(0.3), [](bool k) { return k ? 0.3 : 0.7; }));
  expect_pass(check(std::uniform_int_distribution<int>(-3, 3), [](int) { return 1 / 7.0; }));
}

TEST(Generator, WrongLaws_Fail) {
  const auto fault = [](const auto& d, auto law) { return check(d, law).fault(); };
  const std::normal_distribution<double> wide(0, 1.05);
  EXPECT_NE(fault(wide, normal_pdf), Fault::none);
  EXPECT_NE(fault(wide, mc::ClaimedCdf(normal_cdf)), Fault::none);
  EXPECT_EQ(fault(std::normal_distribution<double>(), [](double x) { return 0.9 * normal_pdf(x); }), Fault::mass);
  EXPECT_EQ(fault(std::normal_distribution<double>(), mc::ClaimedCdf([](double x) { return 2 * normal_cdf(x); })),
            Fault::outside);
  EXPECT_NE(fault(std::poisson_distribution<int>(4), poisson_pmf(4.1)), Fault::none);
}

// Outcomes beyond the pilot are one outcome with the rest of the probability: a factor is found in both directions.
TEST(Generator, UnboundedProbabilitiesWithAFactor_Fail) {
  const std::poisson_distribution<int> d(4);
  for (const double factor : {0.9, 1.1}) {
    const mc::Report r = check(d, [&](double k) { return factor * poisson_pmf(4)(k); });
    EXPECT_EQ(r.verdict(), Verdict::fail) << factor;
  }
}

// Every second number comes from the state that the first call leaves.
struct SecondIsWrong {
  std::optional<double> kept;
  template <class Engine> double operator()(Engine& engine) {
    const double u = std::uniform_real_distribution<double>()(engine);
    if (kept) return std::sqrt(*std::exchange(kept, {}));
    return kept.emplace(u);
  }
  double min() const { return 0; }
  double max() const { return 1; }
};

TEST(Generator, WrongNumberOfItsState_Fails) {
  EXPECT_EQ(check(SecondIsWrong{}, [](double) { return 1.0; }).verdict(), Verdict::fail);
}

TEST(RandomEngine, EqualSeeds_GiveTheBitsOfPcg) {
  mc::RandomEngine engine(7);
  mc::Pcg random(7);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(engine(), random.next64());
}

} // namespace

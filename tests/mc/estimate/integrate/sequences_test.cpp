#include <mc/estimate/integrate/sequences.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

namespace detail = mc::detail;
using mc::detail::Sequences;

const std::function<double(std::span<const double>)> exponential = [](std::span<const double> u) {
  return std::exp(u[0] + u[1] * u[2]);
};

TEST(Sequences, GrowToTheSameSums) {
  mc::IntegrateOptions o;
  o.replicates = 5;
  detail::Run run{{.one = &exponential}, 1, 3, o};
  Sequences steps{.purpose = 0}, once{.purpose = 0};
  steps.extend(run, 64);
  steps.extend(run, 128);
  const auto grown = steps.extend(run, 1024), at_once = once.extend(run, 1024);
  EXPECT_NEAR(grown[0].value, at_once[0].value, 1e-14);
  EXPECT_NEAR(grown[0].error, at_once[0].error, 1e-2 * at_once[0].error);
  EXPECT_EQ(steps.history.size(), 3u);
  EXPECT_EQ(steps.widen(run, 3)[0].dof, 7);
  EXPECT_EQ(run.calls, 5u * 1024 + 5u * 1024 + 3u * 1024);
}

TEST(Sequences, AdvantageContinuesTheFallOfTheErrors) {
  const auto history = [](std::initializer_list<double> variances) {
    Sequences s{.purpose = 0};
    for (const double v : variances) s.history.push_back({{0, std::sqrt(v), 23}});
    return s;
  };
  const Sequences slow = history({1, 0.5, 0.25, 0.125}), fast = history({8, 2, 0.5, 0.125});
  EXPECT_NEAR(mc::detail::advantage(slow, fast, 0), 0, 1e-12);
  EXPECT_NEAR(mc::detail::advantage(slow, fast, 3), 3 * std::log(2), 1e-12); // a half against a quarter, thrice
  EXPECT_NEAR(mc::detail::advantage(fast, slow, 3), -3 * std::log(2), 1e-12);
}

} // namespace

#include <mc/estimate/integrate/learn/learner.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

namespace detail = mc::detail;

// Two peaks on a diagonal: every axis alone sees two bumps, and a product of axes four peaks.
const std::function<double(std::span<const double>)> peaks = [](std::span<const double> u) {
  const auto at = [&](double c) { return std::exp(-(mc::sqr(u[0] - c) + mc::sqr(u[1] - c)) / (2 * 0.05 * 0.05)); };
  return at(0.25) + at(0.75);
};

TEST(Learner, FollowsWhatIsNoProduct) {
  mc::IntegrateOptions o;
  detail::Run run{{.one = &peaks}, 1, 2, o};
  detail::Learner learner(run);
  double widths[4];
  for (std::uint64_t k = 0; k < 4; ++k) {
    const detail::Proposal proposal{.density = std::make_shared<mc::AdaptedDensity>(learner.density())};
    learner.learn(run.evaluate_all(run.sobol_sets(2 + k, 0, 24), 0, 128, proposal, detail::Keep::points));
    widths[k] = learner.width();
  }
  EXPECT_LT(widths[3], 0.3 * widths[0]);
  ASSERT_TRUE(learner.density().tree.has_value());
  std::vector<double> scratch(2);
  const auto density = [&](double x, double y) { return learner.density().density(std::array{x, y}, scratch); };
  EXPECT_GT(density(0.25, 0.25), 4 * density(0.25, 0.75));
  EXPECT_GT(density(0.75, 0.75), 4 * density(0.75, 0.25));
}

TEST(Learner, NothingSeenNothingLearned) {
  const std::function<double(std::span<const double>)> zero = [](std::span<const double>) { return 0.0; };
  mc::IntegrateOptions o;
  detail::Run run{{.one = &zero}, 1, 2, o};
  detail::Learner learner(run);
  for (std::uint64_t k = 0; k < 2; ++k)
    learner.learn(run.evaluate_all(run.sobol_sets(k, 0, 24), 0, 64, {}, detail::Keep::points));
  std::vector<double> scratch(2);
  EXPECT_NEAR(learner.density().density(std::array{0.3, 0.6}, scratch), 1, 1e-12);
}

} // namespace

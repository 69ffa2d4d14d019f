#include <mc/estimate/integrate/learn/density_learner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

namespace detail = mc::detail;

// Two peaks on a diagonal: each axis shows two bumps, and a product of axes has four peaks.
const std::function<double(std::span<const double>)> peaks = [](std::span<const double> u) {
  const auto at = [&](double c) { return std::exp(-(mc::sqr(u[0] - c) + mc::sqr(u[1] - c)) / (2 * 0.05 * 0.05)); };
  return at(0.25) + at(0.75);
};

TEST(DensityLearner, FollowsNonSeparableIntegrand) {
  mc::IntegrateOptions o;
  detail::IntegrationRun run{{.one = &peaks}, 1, 2, o};
  detail::DensityLearner learner(run);
  double widths[4];
  for (std::uint64_t k = 0; k < 4; ++k) {
    const detail::Proposal proposal{.density = std::make_shared<mc::AdaptedDensity>(learner.density())};
    learner.learn(run.evaluate_all(run.sobol_sets(2 + k, 0, 24), 0, 128, proposal, detail::Keep::points));
    widths[k] = learner.log_second_moment();
  }
  EXPECT_LT(widths[3], 0.3 * widths[0]);
  ASSERT_TRUE(learner.density().tree.has_value());
  std::vector<double> scratch(2);
  const auto density = [&](double x, double y) { return learner.density().density(std::array{x, y}, scratch); };
  EXPECT_GT(density(0.25, 0.25), 4 * density(0.25, 0.75));
  EXPECT_GT(density(0.75, 0.75), 4 * density(0.75, 0.25));
}

// The few largest values of this product dominate the mean square. The grid must stay as symmetric about the middle as
// the product, so it must not follow single points.
TEST(DensityLearner, DoesNotFollowSinglePoints) {
  constexpr std::size_t dim = 20;
  const std::function<double(std::span<const double>)> product = [](std::span<const double> u) {
    double f = 1;
    for (const double x : u) f *= std::abs(4 * x - 2);
    return f;
  };
  mc::IntegrateOptions o;
  detail::IntegrationRun run{{.one = &product}, 1, dim, o};
  detail::DensityLearner learner(run);
  learner.learn(run.evaluate_all(run.sobol_sets(2, 0, 24), 0, 512, {}, detail::Keep::points));
  std::vector<double> x(dim, 0.5), scratch(dim);
  const auto density = [&](std::size_t axis, double at) {
    x[axis] = at;
    const double p = learner.density().density(x, scratch);
    x[axis] = 0.5;
    return p;
  };
  double largest = 1;
  for (std::size_t axis = 0; axis < dim; ++axis)
    for (double at = 0.005; at < 0.5; at += 0.01) {
      const double ratio = density(axis, at) / density(axis, 1 - at);
      largest = std::max({largest, ratio, 1 / ratio});
    }
  EXPECT_LE(largest, 2.5); // measured 2.0
}

TEST(DensityLearner, AllZero_StaysUniform) {
  const std::function<double(std::span<const double>)> zero = [](std::span<const double>) { return 0.0; };
  mc::IntegrateOptions o;
  detail::IntegrationRun run{{.one = &zero}, 1, 2, o};
  detail::DensityLearner learner(run);
  for (std::uint64_t k = 0; k < 2; ++k)
    learner.learn(run.evaluate_all(run.sobol_sets(k, 0, 24), 0, 64, {}, detail::Keep::points));
  std::vector<double> scratch(2);
  EXPECT_NEAR(learner.density().density(std::array{0.3, 0.6}, scratch), 1, 1e-12);
}

} // namespace

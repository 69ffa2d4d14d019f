// Several outputs, points in blocks, and the diagnostics of rounds.

#include <mc/core/error.h>
#include <mc/estimate/integrate.h>
#include <mc/random/uniform.h>

#include <mc/estimate/settings.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

namespace {

using support::with;
using Unit = std::span<const double>;
using mc::Method;
constexpr auto& methods = support::all_methods;

// exp(c . u) for two random c that differ by a tenth, so that the errors of their integrals are correlated.
struct Pair {
  std::size_t dim;
  std::vector<double> c[2];
  double truth[2] = {1, 1};

  explicit Pair(std::uint64_t seed) : dim(1 + seed % 4) {
    for (std::size_t d = 0; d < dim; ++d) {
      const double x = 0.5 + 3 * mc::hash_uniform<double>(seed, 1, d),
                   y = x * (1 + 0.1 * mc::hash_uniform<double>(seed, 2, d));
      c[0].push_back(x);
      c[1].push_back(y);
      truth[0] *= std::expm1(x) / x;
      truth[1] *= std::expm1(y) / y;
    }
  }
  double value(std::size_t k, Unit u) const {
    double sum = 0;
    for (std::size_t d = 0; d < dim; ++d) sum += c[k][d] * u[d];
    return std::exp(sum);
  }
};

// The error of a ratio by the covariances must be calibrated, and small compared with the errors of both integrals. The
// mean of 80 squared deviates of Student's t with 23 degrees of freedom is 1.05 with a standard deviation of .2. The
// bounds are 3.5 of these away.
TEST(VectorIntegral, CovariancesGiveTheErrorOfARatio) {
  for (const Method method : methods) {
    double squares = 0, reduction = 0;
    constexpr int runs = 80;
    for (std::uint64_t seed = 0; seed < runs; ++seed) {
      const Pair pair(seed);
      const mc::VectorIntegrand f = [&](Unit u, std::span<double> y) {
        y[0] = pair.value(0, u);
        y[1] = 1e6 * pair.value(1, u);
      };
      const mc::VectorIntegral r = mc::integrate_unit(f, 2, static_cast<int>(pair.dim), with(method, 3000, seed));
      const double w[] = {1 / pair.truth[0], -1e-6 / pair.truth[1]}; // of the logarithm of the ratio
      double difference = 0, variance = 0, alone = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        difference += w[i] * r.outputs[i].estimate.value;
        alone += w[i] * w[i] * r.covariance(i, i);
        for (std::size_t j = 0; j < 2; ++j) variance += w[i] * w[j] * r.covariance(i, j);
        EXPECT_NEAR(std::sqrt(r.covariance(i, i)), r.outputs[i].estimate.std_error,
                    1e-9 * r.outputs[i].estimate.std_error);
      }
      ASSERT_GT(variance, 0);
      squares += difference * difference / variance / runs;
      reduction += variance / alone / runs;
    }
    EXPECT_GE(squares, 0.4) << name(method);
    EXPECT_LE(squares, 1.75) << name(method);
    EXPECT_LE(reduction, 0.2) << name(method);
  }
}

TEST(VectorIntegral, UnknownError_CovarianceIsNotFinite) {
  const mc::VectorIntegrand f = [](Unit u, std::span<double> y) {
    y[0] = u[0];
    y[1] = 0;
  };
  const mc::VectorIntegral r = mc::integrate_unit(f, 2, 2, with(Method::plain, 2000));
  EXPECT_FALSE(std::isfinite(r.covariance(0, 1)));
  EXPECT_FALSE(std::isfinite(r.covariance(1, 1)));
  EXPECT_TRUE(std::isfinite(r.covariance(0, 0)));
}

TEST(BatchIntegrand, SameBitsAsPointByPoint) {
  const auto value = [](Unit u) { return std::exp(-40 * mc::sqr(u[0] - 0.3)) + u[1] * u[2]; };
  const auto other = [](Unit u) { return u[0] < 0.3 ? u[1] : 1.0; };
  const mc::VectorIntegrand one = [&](Unit u, std::span<double> y) {
    y[0] = value(u);
    y[1] = other(u);
  };
  std::atomic<std::size_t> most = 0;
  mc::BatchIntegrand many{[&](Unit points, std::span<double> y) {
    ASSERT_EQ(2 * points.size(), 3 * y.size());
    std::size_t largest = most;
    while (points.size() / 3 > largest && !most.compare_exchange_weak(largest, points.size() / 3)) {
    }
    for (std::size_t i = 0; 3 * i < points.size(); ++i) {
      y[2 * i] = value(points.subspan(3 * i, 3));
      y[2 * i + 1] = other(points.subspan(3 * i, 3));
    }
  }};
  for (const Method method : methods) {
    const mc::VectorIntegral a = mc::integrate_unit(one, 2, 3, with(method, 40'001));
    for (const auto& [asked, most_points] : {std::pair(0u, 256u), {1000u, 1024u}, {1u << 20, 4096u}}) {
      most = 0;
      many.max_points = asked;
      const mc::VectorIntegral b = mc::integrate_unit(many, 2, 3, with(method, 40'001));
      EXPECT_LE(most, most_points);
      EXPECT_GT(2 * most, std::min(most_points, 2048u)) << name(method) << " " << asked;
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(a.outputs[k].estimate.value, b.outputs[k].estimate.value) << name(method);
        EXPECT_EQ(a.outputs[k].estimate.std_error, b.outputs[k].estimate.std_error) << name(method);
      }
      EXPECT_EQ(a.correlation(0, 1), b.correlation(0, 1)) << name(method);
    }
  }
  EXPECT_THROW(mc::integrate_unit(mc::BatchIntegrand{}, 2, {}), mc::Error);
  const mc::BatchIntegrand nan{[](Unit, std::span<double> y) { y[0] = std::nan(""); }};
  EXPECT_THROW(mc::integrate_unit(nan, 2, {}), mc::Error);
}

TEST(IntegrateRounds, AddUpToTheWhole) {
  const auto peak = [](Unit u) { return 1 / ((1e-2 + mc::sqr(u[0] - 0.4)) * (1e-2 + mc::sqr(u[1] - 0.7))); };
  for (const Method method : methods) {
    const mc::Integral r = mc::integrate_unit(peak, 2, with(method, 60'000));
    ASSERT_GE(r.rounds.size(), 3u) << name(method);
    double chi2 = 0, dof = 0;
    std::uint64_t calls = 0;
    bool answer = false;
    for (const mc::IntegrateRound& round : r.rounds) {
      EXPECT_GE(round.calls, calls);
      calls = round.calls;
      answer = answer || (round.estimate.value == r.estimate.value && round.method == r.method);
      if (!std::isfinite(round.chi2)) continue;
      chi2 += round.chi2;
      dof += 1;
    }
    EXPECT_EQ(calls, r.calls) << name(method);
    EXPECT_NEAR(chi2, r.chi2, 1e-12 * r.chi2) << name(method);
    EXPECT_EQ(dof, r.chi2_dof) << name(method);
    EXPECT_TRUE(answer || method == Method::stratified) << name(method); // stratified averages all of its rounds
  }
}

} // namespace

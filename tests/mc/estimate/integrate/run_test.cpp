#include <mc/estimate/integrate/run.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace mc::detail;
namespace detail = mc::detail;

const std::function<double(std::span<const double>)> always_one = [](std::span<const double>) { return 1.0; };

TEST(Run, ExcessIsTheErrorOverTheWantedOne) {
  mc::IntegrateOptions o;
  o.rel_error = 0.01;
  o.abs_error = 0.05;
  detail::Run run{{{.one = &always_one}, 1, 2, o}};
  const Mean m{.value = 10, .error = 0.2};
  EXPECT_NEAR(run.excess({m}), 0.2 / 0.1, 1e-9);
  EXPECT_NEAR(run.excess({Mean{.value = 1, .error = 0.2}}), 0.2 / 0.05, 1e-9);
  Mean unknown = m;
  unknown.bar = mc::ErrorBar::undersampled;
  EXPECT_EQ(run.excess({unknown}), std::numeric_limits<double>::infinity());
}

TEST(Run, ConvergesAfterTheLeastCallsOnly) {
  mc::IntegrateOptions o;
  o.min_calls = 5000;
  detail::Run run{{{.one = &always_one}, 1, 2, o}};
  const Means exact = {Mean{.value = 1, .error = 1e-9}};
  EXPECT_FALSE(run.converged(exact));
  run.evaluator.calls = 5000;
  EXPECT_TRUE(run.converged(exact));
}

// Interlaced points double the rate in up to two dimensions; through a density they gain nothing.
TEST(Run, StreamsChooseTheirPoints) {
  mc::IntegrateOptions o;
  for (const int dim : {2, 3}) {
    detail::Run run{{{.one = &always_one}, 1, dim, o}};
    EXPECT_EQ(std::holds_alternative<mc::InterlacedSobol>(run.sobol_sets(Stream::rqmc, 0, 0, 1)[0]), dim == 2);
    EXPECT_TRUE(std::holds_alternative<mc::ScrambledSobol>(run.sobol_sets(Stream::adapted, 0, 0, 1)[0]));
    for (const Stream s : {Stream::rqmc, Stream::adapted, Stream::quantiles})
      EXPECT_EQ(mc::is_warped(run.sobol_sets(s, 0, 0, 1)[0]), s == Stream::rqmc);
  }
}

} // namespace

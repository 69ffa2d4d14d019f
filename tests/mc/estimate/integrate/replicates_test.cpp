#include <mc/estimate/integrate/replicates.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace mc::detail;
namespace detail = mc::detail;

const std::function<double(std::span<const double>)> exponential = [](std::span<const double> u) {
  return std::exp(u[0] + u[1] * u[2]);
};

const Means& double_length(Replicates& r) { return r.extend(std::max(Replicates::first_length, 2 * r.length())); }

TEST(Replicates, ExtendingInStepsGivesTheSameSums) {
  const mc::IntegrateOptions o;
  detail::Run run{{{.one = &exponential}, 1, 3, o}};
  Replicates steps(run, Stream::rqmc, 0, 5), once(run, Stream::rqmc, 0, 5);
  for (const std::uint64_t to : {64u, 128u, 256u, 512u, 1024u}) steps.extend(to);
  once.extend(1024);
  EXPECT_NEAR(steps.means()[0].value, once.means()[0].value, 1e-14);
  EXPECT_EQ(steps.means()[0].dof, 4);
  EXPECT_EQ(steps.add(3)[0].dof, 7);
  EXPECT_EQ(run.evaluator.calls, 5u * 1024 + 5u * 1024 + 3u * 1024);
  EXPECT_EQ(steps.calls(), 8u * 1024);
}

TEST(Replicates, RoundsOfAStreamAreIndependent) {
  const mc::IntegrateOptions o;
  detail::Run run{{{.one = &exponential}, 1, 3, o}};
  Replicates a(run, Stream::adapted, 0, 5), b(run, Stream::adapted, 1, 5), c(run, Stream::adapted, 0, 5);
  EXPECT_NE(a.extend(64)[0].value, b.extend(64)[0].value);
  EXPECT_EQ(a.means()[0].value, c.extend(64)[0].value);
}

// Dropped sequences must not remove their part of a heavy tail.
TEST(Replicates, KeepFirst_KeepsTheTailOfDroppedSequences) {
  const std::function<double(std::span<const double>)> heavy = [](std::span<const double> u) {
    return std::pow(1 - u[0], -0.9);
  };
  const mc::IntegrateOptions o;
  detail::Run run{{{.one = &heavy}, 1, 1, o}};
  Replicates r(run, Stream::rqmc, 0, 24);
  while (r.length() < 4096) double_length(r);
  const Mean before = r.means()[0];
  r.keep_first(12);
  const Mean after = double_length(r)[0];
  EXPECT_GT(after.tail[1], before.tail[1] / 4);
  EXPECT_EQ(after.dof, 11);
}

// Of an extension that was not asked for a record, none is kept.
TEST(Replicates, RecordIsThatOfTheLastExtension) {
  const mc::IntegrateOptions o;
  detail::Run run{{{.one = &exponential}, 1, 3, o}};
  Replicates r(run, Stream::rqmc, 0, 4);
  r.extend(64, true);
  EXPECT_EQ(r.record().weights.size(), 4u * 64);
  r.extend(256, true);
  EXPECT_EQ(r.record().weights.size(), 4u * 192);
  double_length(r);
  EXPECT_TRUE(r.record().weights.empty());
}

// The error falls like 1 / n^1.5 for a smooth integrand in one dimension, and like n^-1/2 for noise.
TEST(Replicates, RateIsThatOfTheIntegrand) {
  const std::function<double(std::span<const double>)> noise = [](std::span<const double> u) {
    return std::sin(1e9 * (u[0] + u[1] + u[2]));
  };
  const auto rate = [](const auto& f, std::uint64_t seed) {
    mc::IntegrateOptions o;
    o.seed = seed;
    detail::Run run{{{.one = &f}, 1, 3, o}};
    Replicates r(run, Stream::rqmc, 0, 24);
    while (r.length() < 8192) double_length(r);
    return r.rate();
  };
  double mean = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) mean += rate(noise, seed) / 16;
  EXPECT_GT(rate(exponential, 1), 1);
  EXPECT_NEAR(mean, 0.5, 0.05); // the standard deviation of a rate is .05
}

} // namespace

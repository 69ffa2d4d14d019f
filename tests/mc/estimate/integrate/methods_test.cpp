#include <mc/estimate/integrate/methods.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace mc::detail;
namespace detail = mc::detail;

const std::function<double(std::span<const double>)> f = [](std::span<const double> u) {
  return 1 / (1e-3 + mc::sqr(u[0] - 0.4));
};

// Each keeps to its calls, leaves its latest means behind and says which method it was.
TEST(Methods, KeepToTheCalls) {
  for (const std::uint64_t calls : {500u, 5000u, 77'777u}) {
    mc::IntegrateOptions o;
    o.max_calls = calls;
    o.rel_error = 0;
    const auto expect = [&](auto method, mc::Method name) {
      detail::Run run{{.one = &f}, 1, 2, o};
      std::optional<Outcome> last;
      const Outcome out = method(run, last);
      EXPECT_LE(run.calls, calls);
      EXPECT_GE(run.calls, calls / 2);
      EXPECT_EQ(out.method, name);
      EXPECT_EQ(out.stop, mc::Stop::max_calls);
      EXPECT_GT(out.means[0].error, 0);
    };
    expect(plain, mc::Method::plain);
    expect(stratified, mc::Method::stratified);
    expect([](detail::Run& run, auto& last) { return sequences(run, mc::Method::rqmc, last); }, mc::Method::rqmc);
    expect([](detail::Run& run, auto& last) { return sequences(run, mc::Method::vegas, last); }, mc::Method::vegas);
    expect([](detail::Run& run, auto& last) { return sequences(run, mc::Method::tree, last); }, mc::Method::tree);
  }
}

TEST(Methods, LearnFindsThePeak) {
  mc::IntegrateOptions o;
  o.max_calls = 100'000;
  detail::Run run{{.one = &f}, 1, 2, o};
  const Learned learned = learn(run, nullptr).value();
  EXPECT_FALSE(run.rounds.empty());
  EXPECT_LE(run.calls, 100'000u / 4);
  int inside = 0; // of 129 edges, those within .1 of the peak, where 20 % of a uniform grid's would be
  for (const double e : learned.density->grid.edges(0)) inside += std::abs(e - 0.4) < 0.1;
  EXPECT_GE(inside, 60);
}

// Of a smooth wave there is nothing to learn that points do not do better.
TEST(Methods, LearnGivesUp) {
  const std::function<double(std::span<const double>)> wave = [](std::span<const double> u) {
    return std::cos(0.97 + 2.76 * u[0] + 3.24 * u[1]);
  };
  mc::IntegrateOptions o;
  o.max_calls = 100'000;
  detail::Run run{{.one = &wave}, 1, 2, o};
  Sequences bare{.purpose = 0, .record = true};
  for (std::uint64_t to = 16; to <= 256; to *= 2) bare.extend(run, to);
  EXPECT_FALSE(learn(run, &bare).has_value());
  EXPECT_LE(run.calls, 24u * 256 + 5000);
}

} // namespace

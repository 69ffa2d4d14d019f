#include <integrands/composed_integrands.h>

#include <mc/estimate/integrate.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace {

carlo::UnitCubeIntegral draw(std::string_view name, std::uint64_t seed) {
  for (const carlo::IntegrandClass& kind : carlo::composed_integrand_classes())
    if (kind.name == name) return kind.draw(seed);
  throw std::invalid_argument("no such class");
}

// Plain Monte Carlo agrees with each closed form within 6 standard errors. For normal means alpha is 2e-9 for each of
// 400 integrands. Heavy tails are judged only where the error is known.
TEST(ComposedIntegrands, ClosedFormsAgreeWithPlainMonteCarlo) {
  for (const char* name : {"sum", "nested"}) {
    int judged = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const carlo::UnitCubeIntegral e = draw(name, seed);
      mc::IntegrateOptions o;
      o.method = mc::Method::plain;
      o.rel_error = 0;
      o.max_calls = 200'000; // hits every ridge
      o.seed = seed;
      const mc::Integral r = mc::integrate_unit(e.f, e.dim, o);
      if (r.error_bar != mc::ErrorBar::known) continue;
      ++judged;
      EXPECT_LE(std::abs(r.estimate.value - e.truth), 6 * r.estimate.std_error)
          << name << " " << seed << " " << e.title;
    }
    EXPECT_GE(judged, 150) << name;
  }
}

TEST(ComposedIntegrands, InfiniteVarianceHasAFiniteIntegral) {
  for (const char* name : {"sum_infinite", "nested_infinite"})
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const carlo::UnitCubeIntegral e = draw(name, seed);
      EXPECT_TRUE(std::isfinite(e.truth)) << name << " " << seed;
      for (const double u : {0.1, 0.5, 0.9})
        EXPECT_TRUE(std::isfinite(e.f(std::vector<double>(static_cast<std::size_t>(e.dim), u)))) << name << " " << seed;
    }
}

TEST(ComposedIntegrands, DimensionsRangeFrom1To8) {
  for (const char* name : {"sum", "nested"}) {
    std::set<int> dims;
    for (std::uint64_t seed = 0; seed < 400; ++seed) dims.insert(draw(name, seed).dim);
    EXPECT_EQ(*dims.begin(), 1) << name;
    EXPECT_EQ(*dims.rbegin(), 8) << name;
  }
}

} // namespace

// Defects in the test statistics of other renderers. Each test names a defect with a case that it accepts, and checks
// that libmc rejects the case. tests/mutants contains the wrong distributions.

#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/t_test.h>

#include <gtest/gtest.h>

namespace {

// hypothesis.h: the variance has a lower bound of 1e-5. A mean of 1.001e-4 with a deviation of 1e-6 passes as 1e-4
// after a million values, although it is 100 standard errors off.
TEST(PeerDefects, TTest_SmallVariance_IsNotFloored) {
  mc::Moments m;
  for (int i = 0; i < 1'000'000; ++i) m.add(1.001e-4 + (i % 2 ? 1e-6 : -1e-6));
  const mc::TTest t = mc::t_test(m, 1e-4);
  EXPECT_NEAR(t.t, 100, 0.01);
  EXPECT_LT(t.p, 1e-300);
}

// Mitsuba 3: the last group of pooled cells is dropped if it is incomplete, so 100000 samples pass where 1 is expected.
TEST(PeerDefects, ChiSquare_IncompletePool_IsCounted) {
  std::vector<double> expected(5000, 1000 - 1.0 / 5000);
  std::vector<std::uint64_t> observed(5000, 980);
  for (int i = 0; i < 100; ++i) {
    expected.push_back(0.01);
    observed.push_back(1000);
  }
  EXPECT_LT(mc::chi_square(observed, expected).p, 1e-300);
}

// Mitsuba 3: no samples and no expected samples pass with p = 1.
TEST(PeerDefects, ChiSquare_NoSamples_Throws) { EXPECT_THROW(mc::chi_square({0, 0, 0}, {0, 0, 0}), mc::Error); }

} // namespace

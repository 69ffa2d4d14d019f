// Errors measured with a given truth and with an estimated one.

#include <converge/measure.h>

#include <mc/core/types.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

namespace {

using carlo::UnitCubeIntegral, carlo::Measurement;

UnitCubeIntegral ramp(double truth) {
  UnitCubeIntegral e;
  e.name = e.title = "ramp";
  e.dim = 1;
  e.truth = truth;
  e.smoothness = {carlo::Smoothness::Class::smooth};
  e.min_fit_n = 16;
  e.f = [](UnitCubeIntegral::UnitPoint u) { return u[0]; };
  return e;
}

std::vector<carlo::SamplingMethod> methods(std::initializer_list<const char*> names) {
  std::vector<carlo::SamplingMethod> all;
  for (const char* name : names) all.push_back(carlo::sampling_method(name));
  return all;
}

// Var = 1 / (12 N) and 1 / (12 N^3). There are 14 intervals of 95 %, for 7 N and 2 methods. Fewer than 10 hits have
// probability 4e-4.
TEST(Measure, ErrorsMatchKnownVariances) {
  const auto list = methods({"random", "stratified"});
  for (const double truth : {0.5, std::numeric_limits<double>::quiet_NaN()}) {
    const Measurement m = measure_convergence(in_process_target(ramp(truth)), list, {.max_n = 1024, .seed = 3});
    ASSERT_EQ(m.curves.size(), 2u);
    int hits = 0;
    for (const carlo::ConvergenceCurve& c : m.curves)
      for (const mc::RmsError& e : c.errors) {
        const double exact = std::sqrt(1 / (12 * std::pow(e.n, c.method->name == "random" ? 1 : 3)));
        hits += e.lo <= exact && exact <= e.hi;
      }
    EXPECT_GE(hits, 10);
    EXPECT_TRUE(m.curves[0].agrees_with_theory() && m.curves[1].agrees_with_theory());
    EXPECT_EQ(m.truth_error > 0, std::isnan(truth));
    EXPECT_NEAR(m.truth, 0.5, 6 * m.truth_error);
    EXPECT_TRUE(m.truth_warning.empty());
  }
}

// The errors of x^-.45 have no fourth moment, so the band includes the tail estimate. Without the tail estimate 85 of
// 180 bands miss, with it 23.
TEST(Measure, HeavyTail_WidensBands) {
  UnitCubeIntegral e = ramp(1 / 0.55);
  e.f = [](UnitCubeIntegral::UnitPoint u) { return std::pow(u[0], -0.45); };
  const double variance = 1 / 0.1 - mc::sqr(1 / 0.55);
  int missed = 0, bands = 0;
  const auto random = methods({"random"});
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Measurement m = measure_convergence(in_process_target(e), random, {.max_n = 4096, .seed = seed});
    for (const mc::RmsError& error : m.curves[0].errors) {
      const double exact = std::sqrt(variance / error.n);
      missed += exact < error.lo || error.hi < exact;
      ++bands;
    }
  }
  EXPECT_EQ(bands, 90);
  EXPECT_LE(missed, 18);
}

// Each of 24 slopes may be off by twice its 95 % interval, four deviations. By chance one exceeds this in .15 % of
// runs.
TEST(Measure, NamedIntegralsConvergeAtTheirTheoreticalRates) {
  const auto list = methods({"random", "stratified", "sobol"});
  int known = 0;
  for (const UnitCubeIntegral& e : carlo::textbook_integrals())
    for (const carlo::ConvergenceCurve& c :
         measure_convergence(in_process_target(e), list, {.max_n = 1 << 14, .seed = 5}).curves) {
      if (!c.power_law || !c.theory) continue;
      ++known;
      const double half = c.power_law->slope - c.power_law->lo;
      EXPECT_TRUE(
          c.theory->is_consistent_with(c.power_law->slope - 2 * half, c.power_law->slope + 2 * half, c.fit_center))
          << e.name << ' ' << c.method->name << ": " << c.power_law->slope << " +- " << half;
    }
  EXPECT_EQ(known, 27);
}

// 49 shares of 16/49 do not add up to 16 in floating point.
TEST(Measure, NIsNotRounded) {
  const auto list = methods({"random"});
  const Measurement m = measure_convergence(in_process_target(ramp(0.5)), list, {.max_n = 64, .replicates = 49});
  ASSERT_EQ(m.curves[0].errors.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(m.curves[0].errors[static_cast<std::size_t>(i)].n, 16 << i);
  EXPECT_DOUBLE_EQ(m.curves[0].fit_center, 32);
}

// The reference is ten times as precise as the smallest error.
TEST(Measure, ReferenceIsMoreAccurateThanTheCurves) {
  const auto list = methods({"random", "sobol"});
  const Measurement m = measure_convergence(in_process_target(ramp(std::numeric_limits<double>::quiet_NaN())), list,
                                            {.max_n = 256, .seed = 4});
  EXPECT_LE(m.truth_error, 0.12 * m.curves[1].errors.back().rms);
  EXPECT_LT(m.curves[1].errors.back().lo, m.curves[1].errors.back().rms);
}

TEST(Measure, OnlyWrongTruthsAreWarnedAbout) {
  const auto list = methods({"random", "stratified", "sobol"});
  EXPECT_FALSE(measure_convergence(in_process_target(ramp(0.5001)), list, {.max_n = 1024}).truth_warning.empty());
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_EQ(measure_convergence(in_process_target(ramp(0.5)), list, {.max_n = 256, .replicates = 16, .seed = seed})
                  .truth_warning,
              "");
}

TEST(Measure, ConstantsAreExact) {
  UnitCubeIntegral e = ramp(2);
  e.f = [](UnitCubeIntegral::UnitPoint) { return 2; };
  const auto list = methods({"random"});
  const Measurement m = measure_convergence(in_process_target(e), list, {.max_n = 64});
  EXPECT_TRUE(m.curves[0].exact);
  EXPECT_FALSE(m.curves[0].power_law);
}

// Scaling by a power of two keeps all digits, with a given or an estimated truth. Only rounding errors count as exact.
TEST(Measure, ResultsAreInvariantToScale) {
  const auto list = methods({"random", "stratified", "sobol"});
  for (const double truth : {0.5, std::numeric_limits<double>::quiet_NaN()}) {
    const Measurement one = measure_convergence(in_process_target(ramp(truth)), list, {.max_n = 1024, .seed = 3});
    for (const int exponent : {-1000, -400, -43, 300, 1000}) {
      UnitCubeIntegral e = ramp(std::ldexp(truth, exponent));
      e.f = [exponent](UnitCubeIntegral::UnitPoint u) { return std::ldexp(u[0], exponent); };
      const Measurement m = measure_convergence(in_process_target(e), list, {.max_n = 1024, .seed = 3});
      EXPECT_EQ(m.truth, std::ldexp(one.truth, exponent));
      EXPECT_EQ(m.truth_error, std::ldexp(one.truth_error, exponent));
      for (std::size_t i = 0; i < list.size(); ++i) {
        EXPECT_FALSE(m.curves[i].exact) << exponent << list[i].name;
        ASSERT_TRUE(m.curves[i].power_law) << exponent << list[i].name;
        EXPECT_NEAR(m.curves[i].power_law->slope, one.curves[i].power_law->slope, 1e-9);
        EXPECT_EQ(m.curves[i].errors.back().rms, std::ldexp(one.curves[i].errors.back().rms, exponent));
        EXPECT_NEAR(std::ldexp(m.curves[i].errors.back().lo, -exponent), one.curves[i].errors.back().lo, 1e-14);
      }
    }
  }
}

TEST(Measure, WrongSmallTruth_IsWarnedAbout) {
  const auto list = methods({"random", "stratified", "sobol"});
  UnitCubeIntegral e = ramp(2.5e-13);
  e.f = [](UnitCubeIntegral::UnitPoint u) { return 1e-13 * u[0]; };
  EXPECT_NE(measure_convergence(in_process_target(e), list, {.max_n = 1024}).truth_warning, "");
  e.truth = 0;
  EXPECT_NE(measure_convergence(in_process_target(e), list, {.max_n = 1024}).truth_warning, "");
}

// The sum cancels at every N. Rounding is relative to the size of the summands, not of the sum.
TEST(Measure, CancellingIntegral_IsExactToRounding) {
  const auto list = methods({"lattice"});
  for (const double scale : {1e-200, 1.0, 1e200}) {
    UnitCubeIntegral e = ramp(0);
    e.f = [scale](UnitCubeIntegral::UnitPoint u) { return scale * std::sin(2 * 3.141592653589793 * u[0]); };
    EXPECT_TRUE(measure_convergence(in_process_target(e), list, {.max_n = 256}).curves[0].exact) << scale;
  }
}

// The twelfth step is the fifth of the second curve, after seven of the first: N = 16 to 256.
TEST(Measure, Interrupt_LosesOnlyTheCurrentN) {
  const auto list = methods({"random", "stratified", "sobol"});
  for (const double truth : {0.5, std::numeric_limits<double>::quiet_NaN()}) {
    std::atomic<bool> cancel = false;
    int steps = 0;
    const auto progress = [&](double, const std::string&) { cancel = ++steps == 12; };
    const Measurement m = measure_convergence(in_process_target(ramp(truth)), list,
                                              {.max_n = 1024, .seed = 6, .cancel = &cancel, .progress = progress});
    EXPECT_TRUE(m.interrupted);
    ASSERT_EQ(m.curves.size(), 2u);
    EXPECT_FALSE(m.curves[0].interrupted);
    EXPECT_TRUE(m.curves[1].interrupted);
    ASSERT_EQ(m.curves[1].errors.size(), 5u);
    EXPECT_EQ(m.curves[1].errors.back().n, 256);
    EXPECT_NEAR(m.curves[1].errors.back().rms, std::sqrt(1 / (12 * std::pow(256, 3))), 3e-5);
    EXPECT_EQ(m.truth_warning, "");
  }
}

// The interrupt cuts the 128 replicates of the reference. The replicates of the curve are used instead.
TEST(Measure, InterruptedReference_HasLargerError) {
  carlo::IntegralTarget target = carlo::in_process_target(ramp(std::numeric_limits<double>::quiet_NaN()));
  std::atomic<bool> cancel = false;
  target.run = [&cancel, e = target.integral](const carlo::ReplicateTask& task) {
    cancel = task.count == 128;
    return run_replicates(e, task);
  };
  const auto list = methods({"stratified"});
  const Measurement m = measure_convergence(target, list, {.max_n = 256, .replicates = 16, .cancel = &cancel});
  EXPECT_TRUE(m.interrupted);
  ASSERT_EQ(m.curves.size(), 1u);
  EXPECT_FALSE(m.curves[0].interrupted);
  EXPECT_NEAR(m.truth, 0.5, 6 * m.truth_error);
  EXPECT_LE(m.truth_error, m.curves[0].errors.back().rms);
}

TEST(Measure, InterruptBeforeReference_HasNoCurves) {
  std::atomic<bool> cancel = false;
  const auto progress = [&](double, const std::string&) { cancel = true; };
  const auto list = methods({"vegas", "random"});
  const Measurement m = measure_convergence(in_process_target(ramp(std::numeric_limits<double>::quiet_NaN())), list,
                                            {.max_n = 1 << 14, .cancel = &cancel, .progress = progress});
  EXPECT_TRUE(m.interrupted);
  EXPECT_TRUE(m.curves.empty());
}

// The infinite variance of x^-1/2, which diverges only logarithmically, is reported for 17 of 20 seeds. The infinite
// variance of x^-.7 is reported for all seeds, and none is reported for x^-.4.
TEST(Measure, InfiniteVariance_IsReported) {
  const auto list = methods({"random"});
  const auto named = [&](double power) {
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      UnitCubeIntegral e = ramp(std::numeric_limits<double>::quiet_NaN());
      e.f = [power](UnitCubeIntegral::UnitPoint u) { return std::pow(u[0], power); };
      count += measure_convergence(in_process_target(e), list, {.max_n = 4096, .replicates = 8, .seed = seed})
                   .heavy_tail.has_value();
    }
    return count;
  };
  EXPECT_GE(named(-0.5), 10);
  EXPECT_EQ(named(-0.7), 20);
  EXPECT_LE(named(-0.4), 1);
  EXPECT_EQ(named(1), 0);
}

// An estimated reference is doubted if a single replicate repeatedly causes over half of the variance. This is true for
// 1/x. It is false for smooth functions and for 1/sqrt(x), which has a barely infinite variance.
TEST(Measure, DivergentIntegral_ReferenceIsWarnedAbout) {
  const auto list = methods({"random", "stratified", "sobol"});
  const auto doubt = [&](double power) {
    UnitCubeIntegral e = ramp(std::numeric_limits<double>::quiet_NaN());
    e.f = [power](UnitCubeIntegral::UnitPoint u) { return std::pow(u[0], power); };
    return measure_convergence(in_process_target(e), list, {.max_n = 4096, .seed = 5}).truth_warning;
  };
  EXPECT_NE(doubt(-1).find("one holds over half of the variance"), std::string::npos) << doubt(-1);
  EXPECT_NE(doubt(-0.9), "");
  EXPECT_EQ(doubt(-0.5), "");
  EXPECT_EQ(doubt(2), "");
}

// Replicates of a jump can agree because all have the same number of points on one side. Such agreement is no evidence
// for the truth. The reference must have its stated error for jumps at places where most replicates agree.
TEST(Measure, ReplicatesThatAgreeByChance_AreNotTheReference) {
  const auto list = methods({"random", "stratified", "sobol", "lattice"});
  int off = 0;
  for (const double at : {0.5003, 0.50003, 0.2502, 0.12505, 0.7499})
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      UnitCubeIntegral e = ramp(std::numeric_limits<double>::quiet_NaN());
      e.f = [at](UnitCubeIntegral::UnitPoint u) { return u[0] < at ? 1.0 : 0.0; };
      const Measurement m =
          measure_convergence(in_process_target(e), list, {.max_n = 16384, .error_goal = 1e-4, .seed = seed});
      EXPECT_NEAR(m.truth, at, 1e-5) << at << " " << seed;
      off += std::abs(m.truth - at) > 3 * m.truth_error;
    }
  EXPECT_LE(off, 1) << "one of 20 beyond three standard errors";
}

// Stratified and Sobol' points integrate a jump at 1/2 exactly. The reference uses random points, the only ones with
// replicates that differ, so its error is larger.
TEST(Measure, ErrorBelowReferenceError_IsAnUpperBound) {
  const auto list = methods({"random", "stratified", "sobol"});
  UnitCubeIntegral e = ramp(std::numeric_limits<double>::quiet_NaN());
  e.f = [](UnitCubeIntegral::UnitPoint u) { return u[0] < 0.5 ? 1.0 : 0.0; };
  const Measurement m = measure_convergence(in_process_target(e), list, {.max_n = 1024});
  EXPECT_TRUE(m.curves[0].power_law && m.curves[0].has_measurable_error());
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_FALSE(m.curves[i].power_law || m.curves[i].exact || m.curves[i].has_measurable_error());
    for (const mc::RmsError& error : m.curves[i].errors) {
      EXPECT_TRUE(error.is_bound);
      EXPECT_EQ(error.lo, 0);
      EXPECT_EQ(error.rms, error.hi);
      EXPECT_GE(error.hi, 2 * m.truth_error);
    }
  }
}

// x^-.15 with stratified points: the errors come from the cell at 0 and have kurtosis 30. One set of replicates shows
// little of this tail. Neighbouring bands share their kurtosis: 385 of 420 bands of 95 % cover the error. With the
// kurtosis of each set alone 320 cover it.
TEST(Measure, BandsCoverErrorsOfHeavyTails) {
  constexpr double a = 0.15;
  const auto moment = [](double from, double to, double power) {
    return (std::pow(to, 1 - power) - std::pow(from, 1 - power)) / (1 - power);
  };
  const auto rms = [&](double n) {
    double variance = 0;
    for (double i = 0; i < n; ++i)
      variance += moment(i / n, (i + 1) / n, 2 * a) / n - mc::sqr(moment(i / n, (i + 1) / n, a));
    return std::sqrt(variance);
  };
  UnitCubeIntegral e = ramp(1 / (1 - a));
  e.f = [](UnitCubeIntegral::UnitPoint u) { return std::pow(std::max(u[0], 1e-300), -a); };
  const auto list = methods({"stratified"});
  int hold = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Measurement m = measure_convergence(in_process_target(e), list, {.max_n = 1024, .seed = seed});
    for (const mc::RmsError& error : m.curves[0].errors) {
      hold += error.lo <= rms(error.n) && rms(error.n) <= error.hi;
      ++all;
    }
  }
  EXPECT_EQ(all, 420);
  EXPECT_GE(hold, 385);
}

// With few replicates of a smooth integrand, one of eight may cause half of the variance by chance.
TEST(Measure, FewReplicates_GiveNoWarning) {
  const auto list = methods({"random"});
  UnitCubeIntegral e = ramp(std::numeric_limits<double>::quiet_NaN());
  e.f = [](UnitCubeIntegral::UnitPoint u) { return std::exp(2 * u[0]); };
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
    EXPECT_EQ(
        measure_convergence(in_process_target(e), list, {.max_n = 1024, .replicates = 8, .seed = seed}).truth_warning,
        "")
        << seed;
}

} // namespace

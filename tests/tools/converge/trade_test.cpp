// Choices on curves with exact power laws and fixed costs.

#include <converge/trade.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

namespace {

using carlo::ConvergenceCurve, carlo::Measurement, carlo::TradeCandidate, carlo::IntervalEstimate;

// RMS = c N^-e with a band of 10 %, N = 16 to 4096.
ConvergenceCurve power_law(const char* name, double c, double e) {
  ConvergenceCurve curve;
  curve.method = &carlo::sampling_method(name);
  for (double n = 16; n <= 4096; n *= 2) {
    const double rms = c * std::pow(n, -e);
    curve.errors.push_back({n, rms, 0.9 * rms, 1.1 * rms, 1e-8 * n});
  }
  return curve;
}

// 10 ns for each evaluation, 40 for a lattice; with an interval of 5 %.
IntervalEstimate clock(const ConvergenceCurve& c, double) {
  const double t = c.method->name == "lattice" ? 40e-9 : 10e-9;
  return {t, 0.95 * t, 1.05 * t};
}

// Outlives the candidates, which point into it.
const Measurement& measured() {
  static const Measurement all = [] {
    Measurement m;
    m.curves = {power_law("random", 1, 0.5), power_law("sobol", 1, 1), power_law("halton", 1.02, 1),
                power_law("lattice", 1, 1)};
    return m;
  }();
  return all;
}

TEST(Trade, EvaluationsToReachIsTheCrossingOfTheCurve) {
  const ConvergenceCurve c = power_law("sobol", 1, 1);
  const auto n = evaluations_to_reach(c, 1e-3);
  ASSERT_TRUE(n);
  EXPECT_NEAR(n->value, 1000, 1e-6);
  EXPECT_NEAR(n->lo, 900, 1e-6);
  EXPECT_NEAR(n->hi, 1100, 1e-6);
  EXPECT_FALSE(evaluations_to_reach(c, 1e-4));
  EXPECT_EQ(evaluations_to_reach(c, 1)->value, 16) << "it cannot take fewer";
  // A temporary dip does not reach the error.
  ConvergenceCurve dips = c;
  dips.errors[2].rms = 1e-9;
  EXPECT_NEAR(evaluations_to_reach(dips, 1e-3)->value, 1000, 1e-6);
  // If the upper edge does not fall so low, it is extrapolated with the rate of plain Monte Carlo.
  const auto last = evaluations_to_reach(c, 1.05 / 4096);
  EXPECT_GE(last->hi, 4096);
  EXPECT_LE(last->lo, last->value);
}

// A method reaches the error if its lower edge does. Its additional evaluations are computed as for plain Monte Carlo.
TEST(Trade, MethodWhoseBandReachesTheError_IsACandidate) {
  const ConvergenceCurve c = power_law("sobol", 1, 1);
  const auto n = evaluations_to_reach(c, 0.95 / 4096);
  ASSERT_TRUE(n);
  EXPECT_NEAR(n->value, 4096 / (0.95 * 0.95), 1);
  EXPECT_LE(n->lo, 4096);
}

// An uncertain error may be far below its value, but a low lower edge alone does not reach a goal.
TEST(Trade, WideBand_DoesNotReachEveryError) {
  ConvergenceCurve c = power_law("sobol", 1, 1);
  for (mc::RmsError& e : c.errors) e.lo = 0;
  EXPECT_FALSE(evaluations_to_reach(c, 0.49 / 4096));
  EXPECT_TRUE(evaluations_to_reach(c, 0.51 / 4096));
}

TEST(Trade, ExactMethod_IsTheOnlyBest) {
  Measurement m;
  m.curves = {power_law("random", 1, 0.5), power_law("sobol", 1, 1)};
  for (mc::RmsError& e : m.curves[1].errors) e.rms = e.lo = e.hi = 0;
  const carlo::CandidatesForTime f = candidates_for_time(m, 1e-5, clock);
  ASSERT_EQ(f.candidates.size(), 2u);
  EXPECT_EQ(curve_label(*f.candidates[0].curve), "sobol");
  EXPECT_EQ(count_ties(f.candidates, &TradeCandidate::error), 1u);
  EXPECT_FALSE(f.gain);
}

// A precise curve lies between two imprecise ones. The second imprecise curve still ties with the first.
TEST(Trade, TiesRankFirst) {
  Measurement m;
  m.curves = {power_law("sobol", 1, 1), power_law("lattice", 1.2, 1), power_law("halton", 1.4, 1)};
  for (const std::size_t vague : {0u, 2u})
    for (mc::RmsError& e : m.curves[vague].errors) {
      e.lo = 0.7 * e.rms;
      e.hi = 1.1 * e.rms;
    }
  for (mc::RmsError& e : m.curves[1].errors) e.lo = 0.99 * e.rms;
  const carlo::CandidatesForError f = candidates_for_error(m, 1e-3, [](const ConvergenceCurve&, double) {
    return IntervalEstimate{1e-8, 1e-8, 1e-8};
  });
  ASSERT_EQ(f.candidates.size(), 3u);
  EXPECT_EQ(curve_label(*f.candidates[0].curve), "sobol");
  EXPECT_EQ(curve_label(*f.candidates[1].curve), "halton");
  EXPECT_EQ(curve_label(*f.candidates[2].curve), "lattice");
  EXPECT_EQ(count_ties(f.candidates, &TradeCandidate::seconds), 2u);
}

TEST(Trade, RanksByCostForAnError) {
  const Measurement& m = measured();
  const carlo::CandidatesForError f = candidates_for_error(m, 1e-3, clock);
  ASSERT_EQ(f.candidates.size(), 3u);
  EXPECT_EQ(curve_label(*f.candidates[0].curve), "sobol");
  EXPECT_EQ(curve_label(*f.candidates[1].curve), "halton");
  EXPECT_EQ(curve_label(*f.candidates[2].curve), "lattice");
  EXPECT_NEAR(f.candidates[0].seconds.value, 1e-5, 1e-10);
  EXPECT_NEAR(f.candidates[0].seconds.lo, 1e-5 * 0.9 * 0.95, 1e-10);
  EXPECT_NEAR(f.candidates[0].seconds.hi, 1e-5 * 1.1 * 1.05, 1e-10);
  EXPECT_EQ(count_ties(f.candidates, &TradeCandidate::seconds), 2u) << "2 % apart, known to 15 %";
  // Plain Monte Carlo needs 1e6 evaluations, beyond the measured range: 1000 times the evaluations of the best method.
  ASSERT_EQ(f.nearest.size(), 1u);
  EXPECT_NEAR(f.gain->value, 1000, 1e-6);
  EXPECT_LT(f.gain->lo, 1000);
  EXPECT_GT(f.gain->hi, 1000);
}

// Each method takes its smallest N, 16; plain Monte Carlo does not take fewer.
TEST(Trade, ErrorReachedAtTheFewestN_HasNoGain) {
  const carlo::CandidatesForError f = candidates_for_error(measured(), 2, clock);
  ASSERT_EQ(f.candidates.size(), 4u);
  EXPECT_NEAR(f.gain->value, 1, 1e-9);
  EXPECT_LE(f.gain->lo, 1);
  EXPECT_GE(f.gain->hi, 1);
}

TEST(Trade, UnreachedError_ListsTheNearestMethods) {
  const carlo::CandidatesForError f = candidates_for_error(measured(), 1e-6, clock);
  EXPECT_TRUE(f.candidates.empty());
  EXPECT_FALSE(f.gain);
  ASSERT_EQ(f.nearest.size(), 4u);
  EXPECT_EQ(f.nearest.back().curve->method->name, "random");
}

TEST(Trade, RanksByErrorForATime) {
  const carlo::CandidatesForTime f = candidates_for_time(measured(), 1e-5, clock);
  ASSERT_EQ(f.candidates.size(), 4u);
  EXPECT_EQ(f.candidates[0].curve->method->name, "sobol");
  EXPECT_NEAR(f.candidates[0].error.value, 1e-3, 1e-9);
  EXPECT_LT(f.candidates[0].error.lo, 0.9e-3);
  EXPECT_GT(f.candidates[0].error.hi, 1.1e-3);
  EXPECT_NEAR(f.gain->value, std::sqrt(1000), 1e-6);
  EXPECT_TRUE(candidates_for_time(measured(), 1e-9, clock).candidates.empty());
}

// Beyond N = 4096, 41 us: plain Monte Carlo is extrapolated by its law. The errors of the other methods are upper
// bounds. The choice of the best does not depend on which curve ended earlier.
TEST(Trade, MethodsLimitedByMaxN_HaveAnUpperErrorBound) {
  const carlo::CandidatesForTime f = candidates_for_time(measured(), 4096e-6, clock);
  ASSERT_EQ(f.candidates.size(), 4u);
  EXPECT_EQ(curve_label(*f.candidates[0].curve), "sobol");
  EXPECT_EQ(count_ties(f.candidates, &TradeCandidate::error), 3u);
  EXPECT_NEAR(f.gain->value, 4096 / 640.0, 1e-9);
  for (const TradeCandidate& o : f.candidates) {
    const bool is_plain = o.curve->method->name == "random";
    EXPECT_EQ(o.is_largest_n, !is_plain);
    EXPECT_NEAR(o.n, is_plain ? 409600 : 4096, 1e-6);
    EXPECT_NEAR(o.error.value, is_plain ? 1 / 640.0 : o.curve->errors.back().rms, 1e-12);
    EXPECT_LT(o.error.lo, is_plain ? o.error.value : 0.05 * o.error.value);
  }
  for (const TradeCandidate& o : candidates_for_time(measured(), 1e-5, clock).candidates) EXPECT_FALSE(o.is_largest_n);
}

// From N = 1024 on, the error of the Sobol' points is only bounded by the error of the reference.
TEST(Trade, RatiosOfBoundsAreBounds) {
  Measurement m = measured();
  for (mc::RmsError& e : m.curves[1].errors) {
    if (e.n < 1024) continue;
    e.rms = e.hi = 1e-3;
    e.lo = 0;
    e.is_bound = true;
  }
  m.curves.resize(2);
  const carlo::CandidatesForError f = candidates_for_error(m, 1.5e-3, clock);
  ASSERT_EQ(f.candidates.size(), 1u);
  const IntervalEstimate seconds = reported_interval(f.candidates[0], &TradeCandidate::seconds);
  EXPECT_TRUE(seconds.is_upper_bound());
  EXPECT_GE(seconds.hi, 512 * 10e-9);
  EXPECT_LE(f.candidates[0].seconds.lo, 512 * 10e-9) << "512 points nearly come there, and 513 may";
  ASSERT_TRUE(f.gain);
  EXPECT_TRUE(f.gain->is_lower_bound());
  EXPECT_NEAR(f.gain->lo, 0.9 * 0.9 * 0.95 / 1.5e-3 / 1.5e-3 * 10e-9 / seconds.hi, 1e-3 * f.gain->lo);
  const carlo::CandidatesForTime s = candidates_for_time(m, 20e-6, clock);
  EXPECT_TRUE(s.candidates[0].error.is_upper_bound());
  EXPECT_EQ(s.candidates[0].error.hi, 1e-3);
  EXPECT_TRUE(s.gain && s.gain->is_lower_bound());
  // Also between a value and a bound.
  EXPECT_TRUE(candidates_for_time(m, 7e-6, clock).candidates[0].error.is_upper_bound());
  EXPECT_FALSE(candidates_for_time(m, 4e-6, clock).candidates[0].error.is_upper_bound());
  for (mc::RmsError& e : m.curves[0].errors) e.lo = 0;
  EXPECT_FALSE(candidates_for_time(m, 20e-6, clock).gain) << "of two bounds there is no ratio";
}

// Uses the seconds of a second run, or of the first if the second is interrupted. The fake clock advances with each
// call.
TEST(Trade, CandidatesAreTimedInterleaved) {
  carlo::IntegralTarget target;
  std::vector<std::string> order;
  std::atomic<bool> cancel = false;
  std::size_t most = 1000;
  target.run = [&](const carlo::ReplicateTask& task) {
    order.push_back(task.method->name);
    cancel = order.size() >= most;
    return carlo::Replicates{{0, 0, 0}, {1024, 1024, 1024}, {1, 1, 1024e-9 * static_cast<double>(order.size())}};
  };
  Measurement m;
  m.curves = {power_law("random", 1, 0.5), power_law("sobol", 1, 1)};
  for (ConvergenceCurve& c : m.curves)
    for (const mc::RmsError& e : c.errors) c.replicates.push_back({{}, {}, std::vector<double>(64, 7e-9 * e.n)});
  const std::vector<TradeCandidate> candidates = {{&m.curves[0], 1000, {}, {}}, {&m.curves[1], 1000, {}, {}}};
  const carlo::EvaluationCost again = interleaved_cost(target, m, candidates, 1, &cancel);
  ASSERT_EQ(order.size(), 18u);
  EXPECT_EQ(order[0], "random");
  EXPECT_EQ(order[1], "sobol");
  EXPECT_EQ(order[2], "random");
  EXPECT_NEAR(again(m.curves[0], 1000).value, 9e-9, 1e-15); // median of the calls 1, 3, ..., 17
  EXPECT_NEAR(again(m.curves[1], 1000).lo, 4e-9, 1e-15);    // from the calls 2, 4, ..., 18
  order.clear();
  most = 5;
  const carlo::EvaluationCost before = interleaved_cost(target, m, candidates, 1, &cancel);
  EXPECT_EQ(order.size(), 5u);
  EXPECT_NEAR(before(m.curves[1], 1000).value, 7e-9, 1e-15);
}

TEST(Trade, ParetoFrontHasNoDominatedPoints) {
  const Measurement& m = measured();
  const std::vector<TradeCandidate> front = pareto_front(m);
  for (std::size_t i = 0; i < front.size(); ++i) {
    EXPECT_TRUE(i == 0 || front[i].seconds.value > front[i - 1].seconds.value);
    for (const ConvergenceCurve& c : m.curves)
      for (const mc::RmsError& e : c.errors)
        EXPECT_FALSE(e.seconds < front[i].seconds.value && e.rms < front[i].error.value);
  }
  EXPECT_EQ(front.size(), 9u) << "sobol at every N";
}

} // namespace

#pragma once
/// Which way to take: the cheapest for an error, the most accurate for a time.

#include <converge/measure.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// A figure with its 95 % interval. Where lo is 0 and hi is not it is at most hi, as an error that is not told from the
/// reference's; where hi is infinite it is at least lo; more is not known then.
struct IntervalEstimate {
  double value = 0, lo = 0, hi = 0;

  bool is_upper_bound() const { return lo == 0 && hi > 0; }
  bool is_lower_bound() const { return std::isinf(hi); }
};

/// What a way needs, or gives.
struct TradeCandidate {
  const ConvergenceCurve* curve = nullptr; ///< of the measurement, which must outlive the offer
  double n = 0;                            ///< evaluations
  IntervalEstimate seconds;                ///< CPU, of one estimate
  IntervalEstimate error;                  ///< RMS
  bool is_largest_n = false;               ///< its largest measured N takes less than the seconds asked for
};

/// Every way that reaches an error, cheapest first, but that those which tie with the first stand before the others.
struct CandidatesForError {
  double goal = 0;
  std::vector<TradeCandidate> candidates;
  std::vector<TradeCandidate> nearest; ///< where none reaches it: how far each came, best first
  /// Plain Monte Carlo's seconds over those of the first; by its law N^-1/2, which holds exactly, from its largest N
  /// down to its fewest and beyond. 1 where it is the first.
  std::optional<IntervalEstimate> gain;
};

/// Every way within a time, most accurate first, ties likewise. Plain Monte Carlo goes on by its law beyond its largest
/// N. Any other way that ended before errs by no more than there: the lower edge of its error is where it would come if
/// it fell on as steeply as its slope allows, so that ways that ended sooner are not thought worse for it.
struct CandidatesForTime {
  double goal = 0;
  std::vector<TradeCandidate> candidates;
  std::optional<IntervalEstimate> gain; ///< plain Monte Carlo's error over that of the first
};

/// What there is to say of an offer: at most so much of the error of a way that ended, and of the seconds to an error
/// that is a bound.
IntervalEstimate reported_interval(const TradeCandidate& candidate, IntervalEstimate TradeCandidate::*criterion);

/// What was asked for, and the ways to it.
struct TradeResults {
  std::vector<CandidatesForError> by_error;
  std::vector<CandidatesForTime> by_time;
  std::vector<TradeCandidate> pareto_front; ///< as pareto_front
};

/// Seconds of one evaluation of a curve near n: the median of runs that were taken in turn with those of the other
/// ways, with its interval.
using EvaluationCost = std::function<IntervalEstimate(const ConvergenceCurve& curve, double n)>;

/// As they were measured, one way after another: the median of the replicates, and the order statistics that hold it
/// with 95 %.
IntervalEstimate measured_cost(const ConvergenceCurve& curve, double n);

/// Runs the first offers and plain Monte Carlo, where it is one of them, again near their N, in turn, so that a busy
/// moment falls on all alike. As they were measured for any other curve, and for all when it is interrupted.
EvaluationCost interleaved_cost(const IntegralTarget& target, const Measurement& m,
                                const std::vector<TradeCandidate>& candidates, std::uint64_t seed,
                                const std::atomic<bool>* cancel);

/// The N at which the curve and the two edges of its band come below an error: between the measured N by straight lines
/// in the logarithms, beyond the last by N^-1/2. Nothing where the lower edge does not come there within the measured
/// N, or the last error is more than twice as large: the way has not reached the error.
std::optional<IntervalEstimate> evaluations_to_reach(const ConvergenceCurve& curve, double error);

CandidatesForError candidates_for_error(const Measurement& m, double error, const EvaluationCost& evaluation_cost);
CandidatesForTime candidates_for_time(const Measurement& m, double seconds, const EvaluationCost& evaluation_cost);

/// How many of the first offers cannot be told from the best: their intervals, made wide enough for all offers at once,
/// overlap. The best is that which was luckiest, too.
std::size_t count_ties(const std::vector<TradeCandidate>& candidates, IntervalEstimate TradeCandidate::*criterion);

/// Points that no other is both cheaper and more accurate than, cheapest first.
std::vector<TradeCandidate> pareto_front(const Measurement& m);

/// The name of a curve's way, and whether it was given one point at a time.
std::string curve_label(const ConvergenceCurve& curve);

} // namespace carlo

#pragma once
/// Recommends methods: the cheapest for an error, the most accurate for a time.

#include <converge/measure.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// A value with its 95 % interval. If lo is 0 and hi is not, only the upper bound is known: for example, an error that
/// is not significantly larger than the reference's. If hi is infinite, only the lower bound is known.
struct IntervalEstimate {
  double value = 0, lo = 0, hi = 0;

  bool is_upper_bound() const { return lo == 0 && hi > 0; }
  bool is_lower_bound() const { return std::isinf(hi); }
};

/// Cost and error of a method at one N.
struct TradeCandidate {
  const ConvergenceCurve* curve = nullptr; ///< points into the measurement, which must outlive the candidate
  double n = 0;                            ///< evaluations
  IntervalEstimate seconds;                ///< CPU seconds of one estimate
  IntervalEstimate error;                  ///< RMS error
  bool is_largest_n = false;               ///< its largest measured N takes less than the requested seconds
};

/// Every method that reaches an error, cheapest first. Methods that tie with the first come before all others.
struct CandidatesForError {
  double goal = 0;
  std::vector<TradeCandidate> candidates;
  std::vector<TradeCandidate> nearest; ///< if no method reaches the goal: the smallest error of each method, best first
  /// Seconds of plain Monte Carlo divided by the seconds of the first candidate; 1 if plain Monte Carlo is the first.
  /// The seconds of plain Monte Carlo follow its exact law N^-1/2 from the error at its largest N, for any N down to
  /// its smallest.
  std::optional<IntervalEstimate> gain;
};

/// Every method within a time, most accurate first; ties come first as in CandidatesForError. Plain Monte Carlo is
/// extrapolated beyond its largest N by its law. Any other method that ended earlier is taken at its largest N; its
/// error there is an upper bound. The lower edge of that error is extrapolated with the steepest slope in the interval,
/// so that a curve that ended earlier is not ranked worse for it.
struct CandidatesForTime {
  double goal = 0;
  std::vector<TradeCandidate> candidates;
  std::optional<IntervalEstimate> gain; ///< error of plain Monte Carlo divided by the error of the first candidate
};

/// The interval to report for a candidate. It is an upper bound for the error of a curve that ended early, and for the
/// seconds to an error that is a bound.
IntervalEstimate reported_interval(const TradeCandidate& candidate, IntervalEstimate TradeCandidate::*criterion);

/// The requested goals and the candidates for each.
struct TradeResults {
  std::vector<CandidatesForError> by_error;
  std::vector<CandidatesForTime> by_time;
  std::vector<TradeCandidate> pareto_front; ///< result of pareto_front()
};

/// Seconds of one evaluation of a curve near n, with an interval: the median of runs that alternate with the runs of
/// the other methods.
using EvaluationCost = std::function<IntervalEstimate(const ConvergenceCurve& curve, double n)>;

/// Cost from the measurement itself, in which methods ran one after another: the median of the replicates, with the
/// order statistics that enclose it at 95 %.
IntervalEstimate measured_cost(const ConvergenceCurve& curve, double n);

/// Runs the first candidates again near their N, and plain Monte Carlo if it is a candidate. The runs alternate, so
/// that other load on the machine affects all of them equally. Any other curve uses measured_cost; after an interrupt
/// all do.
EvaluationCost interleaved_cost(const IntegralTarget& target, const Measurement& m,
                                const std::vector<TradeCandidate>& candidates, std::uint64_t seed,
                                const std::atomic<bool>* cancel);

/// The N at which the curve and the two edges of its band fall below an error. Between measured N it interpolates
/// linearly in the logarithms; beyond the last N it uses N^-1/2. Returns nothing if the lower edge does not reach the
/// error within the measured N, or if the last error is more than twice as large. Such a method has not reached the
/// error.
std::optional<IntervalEstimate> evaluations_to_reach(const ConvergenceCurve& curve, double error);

CandidatesForError candidates_for_error(const Measurement& m, double error, const EvaluationCost& evaluation_cost);
CandidatesForTime candidates_for_time(const Measurement& m, double seconds, const EvaluationCost& evaluation_cost);

/// Number of first candidates that are not significantly different from the best. Their intervals, widened to hold for
/// all candidates simultaneously, overlap. The widening is needed because the best is also the luckiest.
std::size_t count_ties(const std::vector<TradeCandidate>& candidates, IntervalEstimate TradeCandidate::*criterion);

/// The Pareto-optimal points, cheapest first: no other point is both cheaper and more accurate.
std::vector<TradeCandidate> pareto_front(const Measurement& m);

/// The name of a method, with a suffix if the integrand was called with one point at a time.
std::string method_label(const SamplingMethod& method);
std::string curve_label(const ConvergenceCurve& curve);

} // namespace carlo

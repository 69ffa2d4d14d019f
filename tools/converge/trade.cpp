#include <converge/trade.h>

#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/random/hash.h>
#include <mc/stats/chi_square.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace carlo {

namespace {

using BandEdge = double mc::RmsError::*;

constexpr double farthest = 2; ///< an uncertain error may have reached a goal smaller by this factor, but not by more

// The first N from which an edge of the band stays below the error, by linear interpolation in the logarithms.
std::optional<double> crossing(const std::vector<mc::RmsError>& errors, BandEdge edge, double error) {
  std::optional<std::size_t> first;
  for (std::size_t i = errors.size(); i-- > 0 && errors[i].*edge <= error;) first = i;
  if (!first) return {};
  const mc::RmsError& below = errors[*first];
  if (*first == 0) return below.n;
  const mc::RmsError& above = errors[*first - 1];
  if (!(below.*edge > 0)) return edge == &mc::RmsError::lo ? above.n : below.n;
  const double t = std::log(above.*edge / error) / std::log(above.*edge / (below.*edge));
  return above.n * std::pow(below.n / above.n, t);
}

// The error at n by linear interpolation in the logarithms; extrapolates from the first or last two points.
double error_at(const std::vector<mc::RmsError>& errors, BandEdge edge, double n) {
  if (errors.size() < 2) return errors.front().*edge;
  std::size_t i = 1;
  while (i + 1 < errors.size() && errors[i].n < n) ++i;
  const mc::RmsError &a = errors[i - 1], &b = errors[i];
  if (!(a.*edge > 0 && b.*edge > 0)) return edge == &mc::RmsError::lo ? 0 : b.*edge; // one of the neighbours is a bound
  return a.*edge * std::pow(b.*edge / (a.*edge), std::log(n / a.n) / std::log(b.n / a.n));
}

TradeCandidate candidate_at(const ConvergenceCurve& c, const IntervalEstimate& n,
                            const EvaluationCost& evaluation_cost) {
  const IntervalEstimate one = evaluation_cost(c, n.value);
  TradeCandidate candidate;
  candidate.curve = &c;
  candidate.n = n.value;
  candidate.seconds = {n.value * one.value, n.lo * one.lo, n.hi * one.hi};
  candidate.error = {error_at(c.errors, &mc::RmsError::rms, n.value), error_at(c.errors, &mc::RmsError::lo, n.value),
                     error_at(c.errors, &mc::RmsError::hi, n.value)};
  return candidate;
}

TradeCandidate largest_n_candidate(const ConvergenceCurve& c) {
  const mc::RmsError& e = c.errors.back();
  return {&c, e.n, {e.seconds, e.seconds, e.seconds}, {e.rms, e.lo, e.hi}};
}

const ConvergenceCurve* plain_mc_curve(const Measurement& m) {
  for (const ConvergenceCurve& c : m.curves)
    if (c.method->name == m.plain_mc && !c.method->scalar_calls && !c.exact) return &c;
  return nullptr;
}

// Nothing if neither edge is known.
std::optional<IntervalEstimate> ratio(const IntervalEstimate& a, const IntervalEstimate& b) {
  const IntervalEstimate r{a.value / b.value, a.lo / b.hi, a.hi / b.lo};
  return r.is_upper_bound() && r.is_lower_bound() ? std::nullopt : std::optional(r);
}

// The first candidates, and plain Monte Carlo if it is a candidate.
std::vector<TradeCandidate> contenders(const std::vector<TradeCandidate>& candidates, const std::string& plain_name) {
  constexpr std::size_t most = 6;
  std::vector<TradeCandidate> chosen(
      candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(std::min(most, candidates.size())));
  for (std::size_t i = most; i < candidates.size(); ++i)
    if (candidates[i].curve->method->name == plain_name) chosen.push_back(candidates[i]);
  return chosen;
}

// Seconds of one evaluation near a candidate's N. The first two of three replicates fill caches; the last is timed.
double remeasured_seconds(const IntegralTarget& target, const TradeCandidate& o, std::uint64_t seed,
                          std::uint64_t round, const std::atomic<bool>* cancel) {
  const std::vector<mc::RmsError>& errors = o.curve->errors;
  const double n = std::clamp(std::exp2(std::round(std::log2(o.n))), errors.front().n, errors.back().n);
  const Replicates r =
      target.run({o.curve->method, static_cast<std::uint64_t>(n), mc::hash(seed, 5), 3 * round, 3, 1, cancel});
  return r.seconds[2] / std::max(r.calls[2], 1.0);
}

/// Whether a candidate is not significantly different from the first one.
class TiesWithFirst {
 public:
  TiesWithFirst(const std::vector<TradeCandidate>& candidates, IntervalEstimate TradeCandidate::*criterion)
      : criterion_(criterion) {
    if (candidates.empty()) return;
    wider_ = mc::normal_quantile(0.05 / static_cast<double>(candidates.size())) / mc::normal_quantile(0.05);
    most_ = widened(candidates.front().*criterion, (candidates.front().*criterion).hi);
  }
  bool operator()(const TradeCandidate& o) const { return widened(o.*criterion_, (o.*criterion_).lo) <= most_; }

 private:
  double widened(const IntervalEstimate& r, double edge) const {
    return r.value > 0 ? r.value * std::pow(edge / r.value, wider_) : edge;
  }

  IntervalEstimate TradeCandidate::*criterion_;
  double wider_ = 1, most_ = 0;
};

// The candidate at the N that fits into a time, within the measured range.
TradeCandidate candidate_within(const ConvergenceCurve& c, const IntervalEstimate& range,
                                const EvaluationCost& evaluation_cost) {
  TradeCandidate candidate = candidate_at(c, range, evaluation_cost);
  // If evaluations take longer than the median, fewer of them fit into the time.
  const double most = c.errors.back().n;
  candidate.error.lo = std::min(candidate.error.lo, error_at(c.errors, &mc::RmsError::lo, std::min(range.hi, most)));
  candidate.error.hi = std::max(candidate.error.hi, error_at(c.errors, &mc::RmsError::hi, range.lo));
  return candidate;
}

// The candidate if the time suffices for more than the largest N. Plain Monte Carlo is extrapolated by its law; any
// other method stays at its largest N.
TradeCandidate candidate_beyond(const Measurement& m, const ConvergenceCurve& c, const IntervalEstimate& range,
                                const IntervalEstimate& one) {
  const mc::RmsError& last = c.errors.back();
  const auto fallen = [&](double error, double n, double slope) {
    return n > last.n ? error * std::pow(n / last.n, slope) : error;
  };
  if (&c == plain_mc_curve(m)) {
    const double seconds = range.value * one.value;
    return {&c,
            range.value,
            {seconds, seconds, seconds},
            {fallen(last.rms, range.value, -0.5), fallen(last.lo, range.hi, -0.5), fallen(last.hi, range.lo, -0.5)}};
  }
  const double steepest = std::min(c.power_law ? c.power_law->lo : -1, -0.5);
  const double rounded = std::min(last.lo, 1e-16 * m.magnitude); // rounding limits the error
  return {&c,
          last.n,
          {last.n * one.value, last.n * one.lo, last.n * one.hi},
          {last.rms, std::max(fallen(last.lo, range.hi, steepest), rounded), last.hi},
          !c.exact && last.rms > 0};
}

// Sorts by value, then moves the candidates that tie with the best to the front.
void rank(std::vector<TradeCandidate>& candidates, IntervalEstimate TradeCandidate::*criterion) {
  std::sort(candidates.begin(), candidates.end(), [criterion](const TradeCandidate& a, const TradeCandidate& b) {
    return (a.*criterion).value < (b.*criterion).value;
  });
  std::stable_partition(candidates.begin(), candidates.end(), TiesWithFirst(candidates, criterion));
}

} // namespace

IntervalEstimate reported_interval(const TradeCandidate& o, IntervalEstimate TradeCandidate::*criterion) {
  IntervalEstimate r = o.*criterion;
  if (criterion == &TradeCandidate::error ? o.is_largest_n : o.error.is_upper_bound()) r.lo = 0;
  return r;
}

IntervalEstimate measured_cost(const ConvergenceCurve& c, double n) {
  std::size_t i = 0;
  while (i + 1 < c.errors.size() && c.errors[i].n < n) ++i;
  std::vector<double> seconds = c.replicates[i].seconds;
  std::sort(seconds.begin(), seconds.end());
  const double count = static_cast<double>(seconds.size()), half = 0.98 * std::sqrt(count);
  const auto at = [&](double rank) {
    return seconds[static_cast<std::size_t>(std::clamp(rank, 0.0, count - 1))] / c.errors[i].n;
  };
  return {at(count / 2), at(count / 2 - half), at(count / 2 + half)};
}

EvaluationCost interleaved_cost(const IntegralTarget& target, const Measurement& m,
                                const std::vector<TradeCandidate>& candidates, std::uint64_t seed,
                                const std::atomic<bool>* cancel) {
  constexpr std::uint64_t rounds = 9;
  std::map<const ConvergenceCurve*, std::vector<double>> seconds;
  for (std::uint64_t round = 0; round < rounds; ++round)
    for (const TradeCandidate& o : contenders(candidates, m.plain_mc)) {
      if (cancel && *cancel) return measured_cost;
      try {
        seconds[o.curve].push_back(remeasured_seconds(target, o, seed, round, cancel));
      } catch (const mc::Error&) {
        return measured_cost; // other points than before met an error
      }
    }
  if (cancel && *cancel) return measured_cost; // the last run is invalid
  // The second and the eighth of nine values enclose the median with 96 % confidence.
  std::map<const ConvergenceCurve*, IntervalEstimate> medians;
  for (auto& [curve, all] : seconds) {
    std::sort(all.begin(), all.end());
    medians[curve] = {all[4], all[1], all[7]};
  }
  return [medians](const ConvergenceCurve& curve, double n) {
    const auto it = medians.find(&curve);
    return it == medians.end() ? measured_cost(curve, n) : it->second;
  };
}

std::string method_label(const SamplingMethod& method) {
  return method.name + (method.scalar_calls ? " (one by one)" : "");
}

std::string curve_label(const ConvergenceCurve& c) { return method_label(*c.method); }

std::optional<IntervalEstimate> evaluations_to_reach(const ConvergenceCurve& c, double error) {
  const auto lo = crossing(c.errors, &mc::RmsError::lo, error);
  if (!lo) return {};
  const mc::RmsError& last = c.errors.back();
  if (last.rms > farthest * error) return {};
  // An edge that does not fall so low is extrapolated with the rate of plain Monte Carlo.
  const auto needed = [&](BandEdge edge) {
    return crossing(c.errors, edge, error).value_or(last.n * mc::sqr(last.*edge / error));
  };
  const double n = needed(&mc::RmsError::rms);
  return IntervalEstimate{n, std::min(*lo, n), std::max(needed(&mc::RmsError::hi), n)};
}

std::size_t count_ties(const std::vector<TradeCandidate>& candidates, IntervalEstimate TradeCandidate::*criterion) {
  const auto told = std::find_if_not(candidates.begin(), candidates.end(), TiesWithFirst(candidates, criterion));
  return static_cast<std::size_t>(told - candidates.begin());
}

CandidatesForError candidates_for_error(const Measurement& m, double error, const EvaluationCost& evaluation_cost) {
  CandidatesForError result{error, {}, {}, {}};
  for (const ConvergenceCurve& c : m.curves) {
    if (const auto n = evaluations_to_reach(c, error))
      result.candidates.push_back(candidate_at(c, *n, evaluation_cost));
    else result.nearest.push_back(largest_n_candidate(c));
  }
  rank(result.candidates, &TradeCandidate::seconds);
  std::sort(result.nearest.begin(), result.nearest.end(),
            [](const TradeCandidate& a, const TradeCandidate& b) { return a.error.value < b.error.value; });
  if (const ConvergenceCurve* random = plain_mc_curve(m); random && !result.candidates.empty()) {
    const mc::RmsError& e = random->errors.back();
    const double fewest = random->errors.front().n;
    const auto needed = [&](double rms) { return std::max(e.n * mc::sqr(rms / error), fewest); };
    const IntervalEstimate n{needed(e.rms), e.is_bound ? 0 : needed(e.lo), needed(e.hi)};
    const IntervalEstimate one = evaluation_cost(*random, std::min(n.value, e.n));
    const TradeCandidate& best = result.candidates.front();
    result.gain = best.curve == random ? IntervalEstimate{1, 1, 1}
                                       : ratio({n.value * one.value, n.lo * one.lo, n.hi * one.hi},
                                               reported_interval(best, &TradeCandidate::seconds));
  }
  return result;
}

CandidatesForTime candidates_for_time(const Measurement& m, double seconds, const EvaluationCost& evaluation_cost) {
  CandidatesForTime result{seconds, {}, {}};
  for (const ConvergenceCurve& c : m.curves) {
    const double most = c.errors.back().n;
    IntervalEstimate one = evaluation_cost(c, most);
    const double n = std::min(most, seconds / one.value);
    if (n < c.errors.front().n) continue; // its smallest N does not fit into the time
    one = evaluation_cost(c, n);
    const IntervalEstimate range{seconds / one.value, seconds / one.hi, seconds / one.lo};
    result.candidates.push_back(range.value > most ? candidate_beyond(m, c, range, one)
                                                   : candidate_within(c, range, evaluation_cost));
  }
  rank(result.candidates, &TradeCandidate::error);
  for (const TradeCandidate& o : result.candidates) // no gain is reported if the best method is exact
    if (o.curve == plain_mc_curve(m) && result.candidates.front().error.value > 0)
      result.gain = ratio(o.error, reported_interval(result.candidates.front(), &TradeCandidate::error));
  return result;
}

std::vector<TradeCandidate> pareto_front(const Measurement& m) {
  std::vector<TradeCandidate> all;
  for (const ConvergenceCurve& c : m.curves)
    for (const mc::RmsError& e : c.errors)
      all.push_back({&c, e.n, {e.seconds, e.seconds, e.seconds}, {e.rms, e.lo, e.hi}});
  std::sort(all.begin(), all.end(), [](const TradeCandidate& a, const TradeCandidate& b) {
    return std::pair(a.seconds.value, a.error.value) < std::pair(b.seconds.value, b.error.value);
  });
  std::vector<TradeCandidate> front;
  for (const TradeCandidate& o : all)
    if (front.empty() || o.error.value < front.back().error.value) front.push_back(o);
  return front;
}

} // namespace carlo

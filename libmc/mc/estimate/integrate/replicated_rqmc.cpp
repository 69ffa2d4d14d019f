#include <mc/estimate/integrate/methods.h>
#include <mc/estimate/integrate/replicated_sequences.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace mc::detail {

namespace {

// Minimum number of replicates at the end of a run: at least eight if possible, because fewer do not determine their
// error well.
std::uint32_t min_replicates(std::uint32_t all) { return std::max((all + 2) / 3, std::min(all, 8u)); }

// Extends sequences and stores their results.
class SequenceExtender {
 public:
  SequenceExtender(IntegrationRun& r, Method method, std::optional<Outcome>& l) : out{{}, method}, run_(r), last_(l) {}

  Outcome out;

  // Largest power of two to which all replicates can be extended.
  std::uint64_t max_affordable_length(const ReplicatedSequences& s) const {
    const auto each = run_.calls_left() / s.count;
    return std::min(
        std::bit_floor(s.length + static_cast<std::uint64_t>(static_cast<double>(each) / s.calls_per_point())),
        ReplicatedSequences::max_length);
  }
  // Number of points, over all replicates, for which the remaining calls suffice.
  double points_left(const ReplicatedSequences& s) const {
    return static_cast<double>(run_.calls_left()) / s.calls_per_point();
  }
  static std::uint64_t next_length(const ReplicatedSequences& s, std::uint64_t end) {
    return std::max(std::min<std::uint64_t>(16, end), 2 * s.length);
  }
  bool extend_until_converged(ReplicatedSequences& s, std::uint64_t end) {
    for (std::uint64_t to = next_length(s, end); to <= end; to *= 2) {
      s.extend(run_, to);
      if (update_and_test(s)) return true;
    }
    return false;
  }
  // Uses up the calls: first extends all replicates, then follows best_end_plan().
  Outcome run_to_end(ReplicatedSequences& s) {
    const std::uint64_t most = max_affordable_length(s);
    if (extend_until_converged(s, std::clamp(common_length(s), std::min<std::uint64_t>(16, most), most)))
      return std::move(out);
    const EndPlan end = best_end_plan(s);
    if (end.count < s.count) s.keep_first(end.count);
    s.points_per_uniform_point = end.points_per_uniform_point;
    if (!extend_until_converged(s, end.length)) spend_remaining_calls(s);
    return std::move(out);
  }
  // Stores the results of the sequences as the outcome.
  void set_outcome(const ReplicatedSequences& s) {
    out.means = s.means;
    out.diagnostics = s.diagnostics();
    out.correlations = s.correlations(run_);
    run_.record(out.method, out.means);
    last_ = out;
  }
  // Stores the results and returns whether they have converged. Short sequences never count as converged. Their
  // replicates agree if all of them miss an important thousandth of the volume, or a place where the density is far too
  // low.
  bool update_and_test(const ReplicatedSequences& s) {
    set_outcome(s);
    if (s.length >= AxisProfile::most && run_.converged(out.means)) out.stop = last_->stop = StopReason::converged;
    return out.stop == StopReason::converged;
  }

 private:
  struct EndPlan {
    std::uint64_t length;
    std::uint32_t count;
    std::uint64_t points_per_uniform_point;
  };

  // Length to which all replicates are extended, so that the minimum number of them can still reach the largest
  // affordable length. Lies between a 32nd and an eighth of that length, and is at least 64 to show the convergence
  // rate. Replicates that already have this length are not extended together if some may be dropped, because points of
  // dropped replicates are wasted.
  std::uint64_t common_length(const ReplicatedSequences& s) const {
    const double all = s.count, points = points_left(s) + all * static_cast<double>(s.length);
    const double fewer = std::min<double>(min_replicates(run_.options.replicates), all);
    double longest = std::exp2(std::floor(std::log2(static_cast<double>(s.length) + points_left(s) / fewer)));
    const auto affords = [&](double length) { return all * length + fewer * (longest - length) <= points; };
    // shorter sequences hardly show the convergence rate
    const double least = std::min(std::max(longest / 32, 64.0), longest / 8);
    if (!affords(std::max(least, static_cast<double>(s.length)))) longest /= 2;
    if (static_cast<double>(s.length) >= least && all > fewer) return s.length;
    double length = longest / 8;
    while (length > 1 && !affords(length)) length /= 2;
    return static_cast<std::uint64_t>(length);
  }
  // Length, number and uniform part of the sequences that give the least variance with the remaining calls. Assumes
  // that the variance continues to fall at the observed rate, or at 1 / N if that is faster. If it falls fast, a
  // uniform part with an eighth of the points would dominate the variance.
  EndPlan best_end_plan(const ReplicatedSequences& s) const {
    EndPlan best{s.length, s.count, s.points_per_uniform_point};
    double least = std::numeric_limits<double>::infinity();
    const double fallen = std::max(convergence_rate(s) / std::log(2.0), 1.0),
                 uniform_share = s.uniform_variance_share();
    const auto falls = [&](std::uint64_t from, std::uint64_t to) {
      return std::pow(static_cast<double>(to) / static_cast<double>(from), -fallen);
    };
    for (std::uint64_t points_per_uniform_point = s.points_per_uniform_point;
         points_per_uniform_point > 0 && s.length > 0;
         points_per_uniform_point = uniform_share > 0 ? points_per_uniform_point / 2 : 0)
      // Replicates that are not extended keep their uniform part.
      for (std::uint64_t length = points_per_uniform_point < s.points_per_uniform_point ? 2 * s.length : s.length;
           length <= ReplicatedSequences::max_length; length *= 2) {
        const std::uint64_t uniform_length = s.uniform_points(length, points_per_uniform_point);
        const double replicates = replicates_at_end(s, length + uniform_length);
        if (replicates < min_replicates(run_.options.replicates)) break;
        double variance = (1 - uniform_share) * falls(s.length, length);
        if (uniform_share > 0) variance += uniform_share * falls(s.uniform_length, uniform_length);
        if (variance / replicates > least) continue;
        least = variance / replicates;
        best = {length, static_cast<std::uint32_t>(std::min<double>(replicates, s.count)), points_per_uniform_point};
      }
    return best;
  }
  // Number of replicates of `calls` calls each at the end: some of the present ones, or all of them and new ones.
  double replicates_at_end(const ReplicatedSequences& s, std::uint64_t calls) const {
    const double all = s.count, left = static_cast<double>(run_.calls_left()), each = static_cast<double>(calls),
                 longer = each - static_cast<double>(s.calls_per_replicate());
    if (left < all * longer) return std::floor(left / longer);
    return all + std::floor((left - all * longer) / each);
  }
  // Adds replicates of the current length.
  void spend_remaining_calls(ReplicatedSequences& s) {
    const std::uint64_t more = run_.calls_left() / std::max<std::uint64_t>(s.calls_per_replicate(), 1);
    if (more == 0 || s.length == 0) return;
    s.add_replicates(run_, static_cast<std::uint32_t>(more));
    update_and_test(s);
  }

  IntegrationRun& run_;
  std::optional<Outcome>& last_;
};

struct MethodCandidate {
  Method method;
  ReplicatedSequences sequences;
};

// Compares learned densities with the baseline sequences up to their length, and with each other, by the predicted
// errors at the final length. Uses the final number of replicates, because additional ones are not worth their calls.
class MethodSelector {
  static constexpr double clear = 3; // a larger lead decides early
  // Expected gain per doubling relative to the gain so far. Interlaced points gain more than others, baseline sequences
  // more than sequences behind a grid, and these more than sequences behind a tree, because its boxes have jumps.
  static constexpr double of_interlacing = 1, without_grid = 0.5, without_boxes = 1.5;

 public:
  // `last` is the length at the end of the run.
  MethodSelector(IntegrationRun& r, const ReplicatedSequences& b, std::uint64_t last)
      : run_(r), baseline_(b),
        doublings_(std::max(std::log2(static_cast<double>(last) / static_cast<double>(b.length)), 0.0)) {}

  std::optional<MethodCandidate> select(std::vector<MethodCandidate>& all) {
    for (std::uint64_t to = std::min<std::uint64_t>(16, baseline_.length); to <= baseline_.length; to *= 2) {
      for (MethodCandidate& c : all) c.sequences.extend(run_, to);
      if (to >= 64 && all.size() > 1 && std::abs(lead_over_grid(all)) > clear && !means_differ(all))
        eliminate(all, 1 - best(all));
    }
    const std::size_t first = best(all);
    const bool ahead = lead_over_baseline(all[first]) > 0;
    for (Round& r : run_.rounds) r.independent &= ahead;
    if (ahead) run_.mark_independent(Method::rqmc);
    if (all.size() > 1) eliminate(all, 1 - first);
    if (ahead) return std::move(all.front());
    eliminate(all, 0);
    return {};
  }

 private:
  // Removes a candidate. The final answer is independent of it.
  void eliminate(std::vector<MethodCandidate>& all, std::size_t i) {
    run_.record(all[i].method, all[i].sequences.means);
    run_.rounds.back().independent = true;
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
  }
  // Lead of a candidate in log variance, beyond the required margin.
  double lead_over_baseline(const MethodCandidate& c) const {
    if (has_fewer_known_errors(baseline_.means_history.back(), c.sequences.means_history.back())) return clear;
    return predicted_log_variance_ratio(baseline_, c.sequences, doublings_,
                                        run_.uses_interlaced_points() ? of_interlacing : without_grid) -
           required_margin(c.sequences.means_history.back());
  }
  double lead_over_grid(const std::vector<MethodCandidate>& all) const {
    return predicted_log_variance_ratio(all[0].sequences, all[1].sequences, doublings_, without_boxes) -
           required_margin(all[1].sequences.means_history.back());
  }
  // If the means differ, a candidate that misses an important region may look much better.
  static bool means_differ(const std::vector<MethodCandidate>& all) {
    return significantly_different(all[0].sequences.means_history.back(), all[1].sequences.means_history.back());
  }
  std::size_t best(const std::vector<MethodCandidate>& all) const {
    return all.size() > 1 && lead_over_grid(all) > 0 ? 1 : 0;
  }

  IntegrationRun& run_;
  const ReplicatedSequences& baseline_;
  double doublings_; // after the comparison
};

std::vector<MethodCandidate> make_candidates(const LearnedDensity& learned, std::uint32_t count) {
  std::vector<MethodCandidate> all;
  const auto propose = [&](Method method, std::uint64_t stream_id, std::shared_ptr<const AdaptedDensity> density) {
    all.push_back(
        {method,
         {.stream_id = stream_id, .count = count, .proposal = {std::move(density), learned.control_coefficients}}});
  };
  // The learning rounds use the stream ids in between.
  const AdaptedDensity& density = *learned.density;
  propose(Method::vegas, 1, std::make_shared<AdaptedDensity>(AdaptedDensity{density.grid}));
  if (density.tree && density.tree->leaves() > 1) propose(Method::tree, 30, learned.density);
  return all;
}

} // namespace

Outcome replicated_rqmc(IntegrationRun& run, Method method, std::optional<Outcome>& last) {
  SequenceExtender extender(run, method == Method::automatic ? Method::rqmc : method, last);
  ReplicatedSequences baseline{.stream_id = 0, .count = run.options.replicates, .record = method == Method::automatic};
  if (method == Method::rqmc) return extender.run_to_end(baseline);
  if (method == Method::automatic) {
    const std::uint64_t most = extender.max_affordable_length(baseline);
    if (extender.extend_until_converged(baseline, std::max<std::uint64_t>(most / 16, 1)))
      return std::move(extender.out);
    // Extends sequences that would have converged if they were longer.
    if (run.converged(baseline.means) && extender.extend_until_converged(baseline, std::min(most, AxisProfile::most)))
      return std::move(extender.out);
  }

  const std::optional<LearnedDensity> learned =
      learn_density(run, method == Method::automatic ? &baseline : nullptr, last);
  baseline.discard_records();
  if (!learned) return extender.run_to_end(baseline);
  extender.out.density = learned->density;
  const bool selecting = method == Method::automatic;
  std::vector<MethodCandidate> all =
      make_candidates(*learned, selecting ? min_replicates(run.options.replicates) : run.options.replicates);
  if (method != Method::automatic) {
    MethodCandidate& c = method == Method::vegas ? all.front() : all.back();
    return extender.run_to_end(c.sequences);
  }
  // With few calls, none remain for a comparison of the candidates. A point costs at most two calls.
  if (2 * all.size() * all.front().sequences.count * baseline.length > run.calls_left())
    return extender.run_to_end(baseline);
  std::optional<MethodCandidate> best =
      MethodSelector(run, baseline, extender.max_affordable_length(all.front().sequences)).select(all);
  if (!best) return extender.run_to_end(baseline);
  extender.out.method = best->method;
  // cannot end the run yet: the candidate was selected for the error measured here
  extender.set_outcome(best->sequences);
  return extender.run_to_end(best->sequences);
}

} // namespace mc::detail

#include <mc/estimate/integrate/methods.h>
#include <mc/estimate/integrate/replicated_sequences.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace mc::detail {

namespace {

// Replicates that a run ends with at least: eight where there are as many, fewer know their own error too badly.
std::uint32_t min_replicates(std::uint32_t all) { return std::max((all + 2) / 3, std::min(all, 8u)); }

// Sequences that grow, and what they say on the way.
class SequenceExtender {
 public:
  SequenceExtender(IntegrationRun& r, Method method, std::optional<Outcome>& l) : out{{}, method}, run_(r), last_(l) {}

  Outcome out;

  // The longest power of two that all replicates can reach.
  std::uint64_t max_affordable_length(const ReplicatedSequences& s) const {
    const auto each = run_.calls_left() / s.count;
    return std::min(
        std::bit_floor(s.length + static_cast<std::uint64_t>(static_cast<double>(each) / s.calls_per_point())),
        ReplicatedSequences::max_length);
  }
  // Points of all replicates that the calls left are enough for.
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
  // To the end of the calls: all replicates at first, then as many as best_end_plan says.
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
  // Makes what sequences say the outcome.
  void set_outcome(const ReplicatedSequences& s) {
    out.means = s.means;
    out.diagnostics = s.diagnostics();
    out.correlations = s.correlations(run_);
    run_.record(out.method, out.means);
    last_ = out;
  }
  // The same, and returns whether that is good enough. Short ones never are: they agree where none of them has met a
  // thousandth of the volume that decides, or a place where the density is far too low.
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

  // How long all replicates get so that the fewest still reach the greatest length that the calls allow; an eighth of
  // that at most, a 32nd at least, and 64 points, to see how the error falls. Those that are so long already grow no
  // longer together, where some may go: of a million calls 67 thousand went to the replicates that were dropped.
  std::uint64_t common_length(const ReplicatedSequences& s) const {
    const double all = s.count, points = points_left(s) + all * static_cast<double>(s.length);
    const double fewer = std::min<double>(min_replicates(run_.options.replicates), all);
    double longest = std::exp2(std::floor(std::log2(static_cast<double>(s.length) + points_left(s) / fewer)));
    const auto affords = [&](double length) { return all * length + fewer * (longest - length) <= points; };
    const double least = std::min(std::max(longest / 32, 64.0), longest / 8); // shorter ones hardly show the fall
    if (!affords(std::max(least, static_cast<double>(s.length)))) longest /= 2;
    if (static_cast<double>(s.length) >= least && all > fewer) return s.length;
    double length = longest / 8;
    while (length > 1 && !affords(length)) length /= 2;
    return static_cast<std::uint64_t>(length);
  }
  // How long sequences should get, how many of them, and how dense their uniform part, for the calls that are left:
  // what leaves least variance, if it goes on falling as it did, and no slower than that of independent points. Where
  // it falls fast a uniform part of an eighth of the points has most of the variance.
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
      // Replicates that do not grow keep the uniform part they have.
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
  // How many replicates of so many calls there will be: some of those there are, or all of them and others.
  double replicates_at_end(const ReplicatedSequences& s, std::uint64_t calls) const {
    const double all = s.count, left = static_cast<double>(run_.calls_left()), each = static_cast<double>(calls),
                 longer = each - static_cast<double>(s.calls_per_replicate());
    if (left < all * longer) return std::floor(left / longer);
    return all + std::floor((left - all * longer) / each);
  }
  // More replicates, as long as those there are.
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

// Lets what was learned run against the baseline sequences as far as these went, and against each other, at the length that
// they would end with. As many replicates race as end: what others would say is worth less than their calls.
class MethodSelector {
  static constexpr double clear = 3; // a decision by more than this is made on the way
  // Of what was gained for each doubling so far, the part that those which follow gain more: of interlaced points than
  // of others, of baseline ones than of those behind a grid, of these than of those behind a tree, whose boxes are jumps.
  static constexpr double of_interlacing = 1, without_grid = 0.5, without_boxes = 1.5;

 public:
  // `last`: the length that they would end with.
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
  // The answer is independent of one that is out.
  void eliminate(std::vector<MethodCandidate>& all, std::size_t i) {
    run_.record(all[i].method, all[i].sequences.means);
    run_.rounds.back().independent = true;
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
  }
  // By how much one is ahead, beyond doubt, in the logarithm of the variance.
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
  // The one that has not met what counts may look better by far.
  static bool means_differ(const std::vector<MethodCandidate>& all) {
    return significantly_different(all[0].sequences.means_history.back(), all[1].sequences.means_history.back());
  }
  std::size_t best(const std::vector<MethodCandidate>& all) const {
    return all.size() > 1 && lead_over_grid(all) > 0 ? 1 : 0;
  }

  IntegrationRun& run_;
  const ReplicatedSequences& baseline_;
  double doublings_; // after the contest
};

std::vector<MethodCandidate> make_candidates(const LearnedDensity& learned, std::uint32_t count) {
  std::vector<MethodCandidate> all;
  const auto propose = [&](Method method, std::uint64_t stream_id, std::shared_ptr<const AdaptedDensity> density) {
    all.push_back(
        {method,
         {.stream_id = stream_id, .count = count, .proposal = {std::move(density), learned.control_coefficients}}});
  };
  // The rounds of learning have the stream ids between.
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
    // What would have converged but for its length gets it.
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
  // Of few calls none are left to hold against each other what was learned; a point costs two calls at most.
  if (2 * all.size() * all.front().sequences.count * baseline.length > run.calls_left())
    return extender.run_to_end(baseline);
  std::optional<MethodCandidate> best =
      MethodSelector(run, baseline, extender.max_affordable_length(all.front().sequences)).select(all);
  if (!best) return extender.run_to_end(baseline);
  extender.out.method = best->method;
  extender.set_outcome(best->sequences); // not yet good enough: it was chosen for the error that it shows here
  return extender.run_to_end(best->sequences);
}

} // namespace mc::detail

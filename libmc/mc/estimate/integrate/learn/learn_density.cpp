#include <mc/estimate/integrate/learn/density_learner.h>
#include <mc/estimate/integrate/methods.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
// Values of DensityLearner::log_second_moment(). Above `wide`, rare large values may be missing. Below `narrow`, none
// are.
constexpr double wide = 2, narrow = 1;
constexpr double small_lead = 0.5; // in units of log_variance_gain()

// Advantage of a round over the baseline sequences: logarithm of the ratio of their variances, summed over the outputs.
// Scales the variance of the sequences to the number of points of the round by 1 / N. Compares at the length closest to
// the round and at the last length. Takes the result more favourable for the round, because a variance from few points
// is often too small.
double log_variance_gain(const Means& round, std::uint64_t points, const ReplicatedSequences& baseline) {
  std::size_t at = 0;
  for (std::uint64_t length = 16; 2 * length <= points && at + 1 < baseline.means_history.size(); length *= 2) ++at;
  const auto lead = [&](std::size_t k) {
    const double more = std::log(static_cast<double>(points) / std::ldexp(16.0, static_cast<int>(k)));
    return log_variance_ratio(baseline.means_history[k], round) -
           more * static_cast<double>(baseline.means_history[k].size());
  };
  return std::max(lead(at), lead(baseline.means_history.size() - 1));
}

// Evaluates a round of `points` points per replicate from a density. Stores the result in `last` unless that is null.
Means evaluate_round(IntegrationRun& run, std::shared_ptr<const AdaptedDensity> density, std::uint64_t stream_id,
                     std::uint64_t points, DensityLearner* learner, std::optional<Outcome>* last) {
  const Proposal proposal{.density = std::move(density)};
  const std::vector<Sums> sums = run.evaluate_all(run.sobol_sets(stream_id, 0, run.options.replicates), 0, points,
                                                  proposal, learner ? Keep::points : Keep::sums);
  if (learner) learner->learn(sums);
  std::vector<ReplicateHistory> histories;
  // Only the last round is compared with the answer, because its density is the best. Earlier rounds may have missed
  // too much of the integrand to have a valid error.
  for (Round& r : run.rounds) r.independent = false;
  run.record(proposal.density->tree ? Method::tree : Method::vegas, run.means(sums, points, histories), true);
  const Means& means = run.rounds.back().means;
  if (last)
    *last = {.means = means,
             .method = run.options.method, // vegas or tree, for either kind of density
             .diagnostics = merged_diagnostics(sums),
             .correlations = correlations(run.replicate_means(sums, {}, proposal)),
             .density = proposal.density};
  return means;
}

// Whether some output is undersampled or all zero.
bool is_undersampled(const Means& means) {
  return std::any_of(means.begin(), means.end(), [](const Mean& m) {
    return m.reported_error_bar() == ErrorBar::undersampled || m.reported_error_bar() == ErrorBar::all_zero;
  });
}

// Whether some error is unknown.
bool has_unknown_error(const Means& means) {
  return std::any_of(means.begin(), means.end(),
                     [](const Mean& m) { return m.reported_error_bar() != ErrorBar::known; });
}

// Whether a round of `calls` calls pays off. Assumes that the log variance continues to fall with the log of the number
// of points as in the last round. That gain must exceed the loss of these calls for integration, where the variance is
// O(1 / N).
//   fell : decrease in the last round, which had `last` points.
//   points_so_far : number of all points.
bool is_worthwhile(double fell, double last, double points_so_far, double calls, double left) {
  if (calls >= left) return false;
  return last >= points_so_far ||
         fell / -std::log1p(-last / points_so_far) * std::log1p(calls / points_so_far) > -std::log1p(-calls / left);
}

std::vector<double> values(const Means& means) {
  std::vector<double> all;
  for (const Mean& m : means) all.push_back(m.value);
  return all;
}

// Test of a density that the caller gave.
struct DensityTrial {
  LearnedDensity given;
  bool fits = true;
};
// Tests the given density on points drawn from it and on uniform points. Uniform points are the points of the baseline
// sequences or an additional round. The learner learns from all of them and continues from the given density.
DensityTrial try_density(IntegrationRun& run, const ReplicatedSequences* baseline, std::uint64_t points,
                         DensityLearner& learner, std::optional<Outcome>* latest) {
  constexpr std::uint64_t uniform_stream = 20, given_stream = 21; // not used by learning rounds
  DensityTrial all{{run.options.density, std::vector<double>(run.outputs)}};
  if (points == 0) return all;
  if (!baseline)
    evaluate_round(run, std::make_shared<AdaptedDensity>(learner.density()), uniform_stream, points, &learner, latest);
  const auto used = std::make_shared<AdaptedDensity>(*run.options.density);
  if (run.options.method == Method::vegas) used->tree.reset();
  learner.set_density(*used);
  all.given.control_coefficients = values(evaluate_round(run, used, given_stream, points, &learner, latest));
  all.fits = learner.fits(*used);
  return all;
}
} // namespace

std::optional<LearnedDensity> learn_density(IntegrationRun& run, const ReplicatedSequences* baseline,
                                            std::optional<Outcome>& last) {
  const std::uint64_t least = std::min<std::uint64_t>(run.options.max_calls / 4, 1 << 13),
                      room = run.max_recorded_calls();
  const std::uint64_t budget = std::clamp<std::uint64_t>(run.options.max_calls / 32, least, std::max(room / 4, least));
  std::optional<Outcome>* latest = baseline ? nullptr : &last;
  DensityLearner learner(run);
  if (baseline) learner.learn(baseline->sums);
  std::vector<double> control_coefficients(run.outputs);
  if (run.options.density) {
    DensityTrial given = try_density(run, baseline, budget / 4 / run.options.replicates, learner, latest);
    if (given.fits) return std::move(given.given);
    control_coefficients = std::move(given.given.control_coefficients);
  }
  // Rounds have a quarter, a quarter and a half of the budget. The baseline sequences or the test of a given density
  // may replace the first. Further rounds double in size while the values are widely spread and a round pays off. Takes
  // up to twice as many calls if rare large values may be missing and no baseline sequences with a known error
  // contradict.
  std::uint64_t calls = budget / 4, spent = 0;
  const std::uint64_t before_all = baseline ? baseline->length * baseline->count : 0;
  double lead = 0;
  // comparison with the baseline sequences is meaningful only if both errors are known
  bool comparable = false;
  const bool first_round_done =
      run.options.density || (baseline && run.calls >= calls && learner.log_second_moment() < wide);
  for (std::uint64_t k = first_round_done ? 1 : 0; calls / run.options.replicates >= 8; ++k) {
    const std::uint64_t points = calls / run.options.replicates;
    const double before = learner.log_second_moment();
    const Means round =
        evaluate_round(run, std::make_shared<AdaptedDensity>(learner.density()), 2 + k, points, &learner, latest);
    control_coefficients = values(round);
    spent += calls;
    if (baseline) lead = log_variance_gain(round, points, *baseline);
    comparable = baseline && !has_unknown_error(baseline->means_history.back()) && !has_unknown_error(round);
    // Gives up if it is worse than the baseline sequences although no rare large values can be missing.
    if (comparable && k > 0 && learner.log_second_moment() < wide &&
        lead < -required_margin(baseline->means_history.back()) - 0.5)
      return {};
    const auto now = static_cast<double>(points * run.options.replicates),
               points_so_far = static_cast<double>(before_all + spent);
    if (k >= 1) calls *= 2;
    const bool searching =
                   (!baseline || is_undersampled(baseline->means_history.back())) && learner.log_second_moment() > wide,
               helps = is_worthwhile(before - learner.log_second_moment(), now, points_so_far,
                                     static_cast<double>(calls), static_cast<double>(run.calls_left())) ||
                       lead > (learner.log_second_moment() > wide ? 0.2 : 0.7);
    const std::uint64_t most = std::min(run.options.max_calls / 5 * (searching ? 2 : 1), room);
    if (k >= 2 && (learner.log_second_moment() < 0.5 || !(searching || helps) || spent + calls > most)) break;
  }
  // A small lead does not justify the calls for a comparison.
  if (comparable && learner.log_second_moment() < narrow && lead < small_lead) return {};
  return LearnedDensity{std::make_shared<AdaptedDensity>(learner.density()), std::move(control_coefficients)};
}

} // namespace mc::detail

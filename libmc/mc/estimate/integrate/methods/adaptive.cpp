#include <mc/core/error.h>
#include <mc/core/memory.h>
#include <mc/core/types.h>
#include <mc/estimate/integrate/corrections/pooled_variance.h>
#include <mc/estimate/integrate/methods/methods.h>
#include <mc/sampler/sobol.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace mc::detail {

namespace {
constexpr std::uint64_t first_attempt = 4096;     // calls before the first density is learned
constexpr double worth_an_attempt = 4;            // times the calls so far that must be missing
constexpr double early = 64;                      // times the calls so far: while more are missing, the rate of
                                                  // interlaced points is not yet known
constexpr double evenness = 0.5;                  // error of evenly spread points over that of independent ones
constexpr double advantage = 1.25;                // by which a new density must be forecast to win: forecasts err
constexpr double worth_another = 1.5;             // fall of the error that promises more
constexpr double least_rate = 0.4, most_rate = 1; // that are trusted
constexpr double interlaced_rate = 1.5;           // the same for interlaced points

// Approximate time of a call [ns].
double call_time(const Run& run, bool adapted) {
  const double d = run.evaluator.dim;
  return run.options().call_ns + (adapted ? 12 + 4 * d : 5 + 0.7 * d);
}
constexpr double learning_time = 10; // of a recorded coordinate [ns], for each attempt

Stream stream_of(const Proposal& proposal) { return proposal.density ? Stream::adapted : Stream::rqmc; }

// The errors of the primary outputs at a number of calls, how fast they fall, and what a call costs.
struct Forecast {
  std::vector<double> errors; // infinite where not known
  double calls, rate, ns;

  // Calls until every error is reached, and what remains at the end if that is later.
  double needed(const std::vector<double>& wanted) const {
    double most = calls;
    for (std::size_t k = 0; k < errors.size(); ++k)
      most = std::max(most, calls * std::pow(wanted[k] > 0 ? errors[k] / wanted[k] : infinity<double>, 1 / rate));
    return most;
  }
  double log_error_after(double more) const {
    double sum = 0;
    for (const double e : errors) sum += std::log(std::max(e, 1e-300)) - rate * std::log(std::max(more / calls, 1.0));
    return sum;
  }
};

std::vector<double> wanted_errors(const Run& run, const Means& means) {
  std::vector<double> wanted;
  for (std::size_t k = 0; k < run.primary(); ++k) wanted.push_back(run.wanted_error(means[k]));
  return wanted;
}

Forecast forecast(const Run& run, const Replicates& r) {
  Forecast f{{},
             static_cast<double>(r.calls()),
             std::clamp(r.rate(), least_rate, run.interlaced(stream_of(r.proposal())) ? interlaced_rate : most_rate),
             call_time(run, r.proposal().density != nullptr)};
  for (std::size_t k = 0; k < run.primary(); ++k) {
    const Mean& m = r.means()[k];
    const bool blind =
        m.bar == ErrorBar::all_zero || m.bar == ErrorBar::undersampled || m.bar == ErrorBar::too_few_points;
    f.errors.push_back(blind ? infinity<double> : half_width(m));
  }
  return f;
}

// The same number of calls through another density. Evenly spread points err less than independent ones; through
// another density they gain as much as now, but not more than by a half.
Forecast forecast(const Run& run, const Replicates& r, const Forecast& now, const Proposal& next,
                  const Samples& samples) {
  Forecast f{{}, now.calls, std::min(now.rate, most_rate), call_time(run, true)};
  const std::vector<double> before = variances(r.proposal(), samples), after = variances(next, samples);
  for (std::size_t k = 0; k < run.primary(); ++k) {
    const double gain = now.errors[k] / std::sqrt(before[k] / now.calls);
    f.errors.push_back(std::sqrt(after[k] / now.calls) * (gain > 0 ? std::clamp(gain, evenness, 1.0) : 1.0));
  }
  return f;
}

// Whether to start anew with another density: earlier at the wanted errors, or with lower errors at the end.
bool pays(const Run& run, const Forecast& stay, const Forecast& change, double spent,
          const std::vector<double>& wanted) {
  const double left = static_cast<double>(run.evaluator.remaining());
  const double longer = stay.needed(wanted) - stay.calls, anew = change.needed(wanted) - spent;
  if (longer > left && anew > left)
    return change.log_error_after(spent + left) + std::log(advantage) * static_cast<double>(stay.errors.size()) <
           stay.log_error_after(stay.calls + left);
  if (anew > left) return false;
  const double learning = spent > 0 ? 0 : learning_time * run.evaluator.dim * stay.calls;
  return longer > left || advantage * (anew * change.ns + learning) < longer * stay.ns;
}

Proposal proposal_of(AdaptedDensity&& density, const Means& means) {
  Proposal p{.density = std::make_shared<AdaptedDensity>(std::move(density))};
  for (const Mean& m : means) p.control_coefficients.push_back(m.value);
  return p;
}

// A density to start anew with. If forced it is learned from all points, else from half of them, and it must pay on the
// other half. automatic tries a tree where few points dominated the sum.
std::optional<Proposal> better_proposal(const Run& run, const Replicates& r, const Record& record, Method method,
                                        bool forced, bool hard) {
  const auto samples = [&](Samples::Half half) { return Samples{record, run.evaluator.dim, run.primary(), half}; };
  const bool must_grow = method == Method::tree, may_grow = must_grow || (method == Method::automatic && hard);
  const Samples::Half learned = forced && must_grow == may_grow ? Samples::Half::both : Samples::Half::first;
  const AdaptedDensity from =
      r.proposal().density ? *r.proposal().density : AdaptedDensity{ImportanceGrid(run.evaluator.dim)};
  const Forecast now = forecast(run, r);
  const std::vector<double> wanted = wanted_errors(run, r.means());
  std::optional<Proposal> best;
  double least = infinity<double>;
  for (const bool grow_tree : {false, true}) {
    if (grow_tree ? !may_grow : must_grow) continue;
    Proposal next = proposal_of(adapted(from, samples(learned), grow_tree), r.means());
    if (learned == Samples::Half::both) return next;
    const Forecast change = forecast(run, r, now, next, samples(Samples::Half::second));
    const double error = change.log_error_after(change.calls) + (grow_tree && !hard ? std::log(advantage) : 0);
    if (error < least && (forced || pays(run, now, change, 0, wanted))) {
      best = std::move(next);
      least = error;
    }
  }
  return best;
}

bool any_value(const Replicates& r) {
  return std::ranges::any_of(r.means(), [](const Mean& m) { return m.bar != ErrorBar::all_zero; });
}

Method method_of(const Replicates& r) {
  if (!r.proposal().density) return Method::rqmc;
  return r.proposal().density->tree ? Method::tree : Method::vegas;
}

// Throws MemoryError where the recorded points need more memory than is allowed.
//   copies : the record, the mixture, and units under way or the record of the fallback. A tree sorts coordinates.
void require_memory(const Run& run, Method wanted) {
  constexpr double copies = 2.6;
  const double points = double(std::min(Keep{}.most_recorded, run.options().max_calls / 6)); // recorded at a time
  const double dim = double(run.evaluator.dim), numbers = copies * (dim + double(run.primary()) + 1);
  const double sorted = wanted == Method::vegas ? 0 : dim;
  mc::require_memory(points * (numbers + sorted) * sizeof(double),
                     fmt::format("integrate: {} dimensions and {} outputs", run.evaluator.dim, run.primary()),
                     "the method plain needs less");
}

// Replicates through a sequence of densities, the first of which is uniform or the caller's. Whenever the calls have
// doubled, a new density may replace the present one. It starts new replicates; the others are compared with the
// answer.
Outcome run_adaptive(Run& run, Method wanted) {
  require_memory(run, wanted);
  const std::uint32_t count = run.options().replicates;
  const bool stays = wanted == Method::automatic; // with uniform points, where no density pays
  std::uint64_t round = 0, attempt = std::min(first_attempt, run.options().max_calls / 4);
  double last = infinity<double>; // error of the density before, for one call
  bool hard = false;              // few points dominated the sum
  MixtureRecord points;
  std::optional<Replicates> fallback; // through the density before, until as many calls show which is better
  const auto replicates = [&](Proposal proposal) {
    const Stream stream = stream_of(proposal);
    return Replicates(run, stream, round++, count, std::move(proposal));
  };
  Replicates r = replicates({.density = run.options().density});
  const auto method = [&] { return stays ? method_of(r) : wanted; };
  while (extend_or_add(run, r, 2 * r.calls() >= attempt)) { // the points before an attempt are recorded
    run.record(method(), r.means());
    run.last = r.outcome(method());
    // The points of the answer must have had the chance to meet a tail.
    if (run.converged(r.means()) && r.calls() >= std::min(run.options().min_calls, run.options().max_calls / 2)) {
      run.last->stop = StopReason::converged;
      break;
    }
    if (fallback && r.calls() >= fallback->calls()) {
      Forecast before = forecast(run, *fallback), now = forecast(run, r);
      // Rates of so few lengths are noisy: their difference would outweigh that of the errors.
      before.rate = now.rate = (before.rate + now.rate) / 2;
      if (!pays(run, before, now, now.calls, wanted_errors(run, r.means()))) {
        r = std::move(*fallback);
        fallback.reset();
        run.last = r.outcome(method());
        attempt = 8 * r.calls();
        continue;
      }
      fallback.reset();
    }
    if (r.record().weights.empty() || !any_value(r)) continue;
    const Forecast now = forecast(run, r);
    const double calls = static_cast<double>(r.calls()), left = static_cast<double>(run.evaluator.remaining());
    const double missing = std::min(now.needed(wanted_errors(run, r.means())) - calls, left);
    const double error = now.log_error_after(calls) + 0.5 * std::log(calls) * static_cast<double>(run.primary());
    const bool must = !(stays || r.proposal().density), improving = error < last - std::log(worth_another);
    const bool forced = must || !std::isfinite(error) || (r.proposal().density && improving);
    hard = hard || !std::isfinite(error);
    std::optional<Proposal> next;
    if (!forced && missing > early * calls && run.interlaced(stream_of(r.proposal()))) {
      attempt = 2 * r.calls();
      continue;
    }
    if ((must && left >= calls) || missing >= worth_an_attempt * calls) {
      points.add(r.record(), r.proposal(), run.evaluator.dim);
      next = better_proposal(run, r, points.record(), wanted, forced, hard);
    }
    if (!next) attempt = 4 * r.calls();
    else if (std::isfinite(error) || run.evaluator.calls > MixtureRecord::most) attempt = 2 * r.calls();
    else attempt = std::max(first_attempt, run.evaluator.calls / 4);
    if (!next) continue;
    last = error;
    run.rounds.back().learning = run.rounds.back().independent = true;
    if (!forced) fallback = std::move(r);
    r = replicates(std::move(*next));
  }
  return *run.last;
}
} // namespace

Outcome run_vegas(Run& run) { return run_adaptive(run, Method::vegas); }
Outcome run_tree(Run& run) { return run_adaptive(run, Method::tree); }
Outcome run_automatic(Run& run) {
  if (static_cast<std::uint32_t>(run.evaluator.dim) > Sobol::dimensions) return run_plain(run);
  return run_adaptive(run, Method::automatic);
}

} // namespace mc::detail

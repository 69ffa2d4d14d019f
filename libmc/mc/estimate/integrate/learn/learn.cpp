#include <mc/estimate/integrate/learn/learner.h>
#include <mc/estimate/integrate/methods.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
// Learner::width() from which on the rare large values may not have been met yet, and up to which all have been.
constexpr double wide = 2, narrow = 1;
constexpr double small_lead = 0.5; // as ahead() says

// How much better a round is than the bare sequences: the logarithm of their variance over its own, summed over the
// outputs. For that their variance is taken to the number of points of the round, as if it fell like 1 / N. It is so
// compared at the length next to the round's and at their last, and what speaks more for the round counts: a variance
// that few points show is often too small.
double ahead(const Means& round, std::uint64_t points, const Sequences& bare) {
  std::size_t at = 0;
  for (std::uint64_t length = 16; 2 * length <= points && at + 1 < bare.history.size(); length *= 2) ++at;
  const auto by = [&](std::size_t k) {
    const double more = std::log(static_cast<double>(points) / std::ldexp(16.0, static_cast<int>(k)));
    return log_ratio(bare.history[k], round) - more * static_cast<double>(bare.history[k].size());
  };
  return std::max(by(at), by(bare.history.size() - 1));
}

// A round of so many points of each replicate, drawn from a density; `last`, if any, becomes what it says.
Means seen_through(Run& run, std::shared_ptr<const AdaptedDensity> density, std::uint64_t purpose, std::uint64_t points,
                   Learner* learner, std::optional<Outcome>* last) {
  const Proposal proposal{.density = std::move(density)};
  const std::vector<Sums> sums = run.evaluate_all(run.sobol_sets(purpose, 0, run.o.replicates), 0, points, proposal,
                                                  learner ? Keep::points : Keep::sums);
  if (learner) learner->learn(sums);
  std::vector<Evidence> evidence;
  // Only the last round is held against the answer: it knew best where the integrand is. Earlier ones may have met too
  // little of it to know their own error.
  for (Round& r : run.rounds) r.independent = false;
  run.record(proposal.density->tree ? Method::tree : Method::vegas, run.means(sums, points, evidence), true);
  const Means& means = run.rounds.back().means;
  if (last)
    *last = {.means = means,
             .method = run.o.method, // vegas or tree, whichever kind of density this round was drawn from
             .seen = seen_in(sums),
             .correlations = correlations(run.replicate_means(sums, {}, proposal)),
             .density = proposal.density};
  return means;
}

// Whether too little of some output was met to know its error.
bool unresolved(const Means& means) {
  return std::any_of(means.begin(), means.end(),
                     [](const Mean& m) { return m.told() == ErrorBar::hardly_met || m.told() == ErrorBar::unseen; });
}

// Whether some error is not known.
bool vague(const Means& means) {
  return std::any_of(means.begin(), means.end(), [](const Mean& m) { return m.told() != ErrorBar::known; });
}

// Whether a round of so many calls pays: the logarithm of the variance, if it goes on falling with that of the number
// of points as it did in the last round, then falls further than it rises for want of these calls, as 1 / N.
//   fell : in the last round, of so many calls; `seen` is the number of all points so far
bool pays(double fell, double last, double seen, double calls, double left) {
  if (calls >= left) return false;
  return last >= seen || fell / -std::log1p(-last / seen) * std::log1p(calls / seen) > -std::log1p(-calls / left);
}

std::vector<double> values(const Means& means) {
  std::vector<double> all;
  for (const Mean& m : means) all.push_back(m.value);
  return all;
}

// The density that the caller gave, and whether it may be used as it is.
struct Tried {
  Learned given;
  bool fits = true;
};
// Tries it on a round of points drawn from it, and on uniform points: those of the bare sequences or, without them, a
// round as long. The learner learns from both, and goes on from that density.
Tried tried(Run& run, const Sequences* bare, std::uint64_t points, Learner& learner, std::optional<Outcome>* said) {
  constexpr std::uint64_t of_uniform = 20, of_given = 21; // purposes that no round of learning has
  Tried all{{run.o.density, std::vector<double>(run.outputs)}};
  if (points == 0) return all;
  if (!bare) seen_through(run, std::make_shared<AdaptedDensity>(learner.density()), of_uniform, points, &learner, said);
  const auto used = std::make_shared<AdaptedDensity>(*run.o.density);
  if (run.o.method == Method::vegas) used->tree.reset();
  learner.start_from(*used);
  all.given.centre = values(seen_through(run, used, of_given, points, &learner, said));
  all.fits = learner.fits(*used);
  return all;
}
} // namespace

std::optional<Learned> learn(Run& run, const Sequences* bare, std::optional<Outcome>& last) {
  const std::uint64_t least = std::min<std::uint64_t>(run.o.max_calls / 4, 1 << 13), room = run.recordable();
  const std::uint64_t budget = std::clamp<std::uint64_t>(run.o.max_calls / 32, least, std::max(room / 4, least));
  std::optional<Outcome>* said = bare ? nullptr : &last;
  Learner learner(run);
  if (bare) learner.learn(bare->sums);
  std::vector<double> centre(run.outputs);
  if (run.o.density) {
    Tried given = tried(run, bare, budget / 4 / run.o.replicates, learner, said);
    if (given.fits) return std::move(given.given);
    centre = std::move(given.given.centre);
  }
  // Rounds of a quarter, a quarter and a half of the budget, the first of which the bare sequences may stand for, or
  // what a density was tried by; after that of twice the calls, as long as the values are spread widely and it pays.
  // Where they are spread so widely that rare large ones may be left to be found, and no bare sequences that know their
  // error say otherwise, up to twice as many calls.
  std::uint64_t calls = budget / 4, spent = 0;
  const std::uint64_t before_all = bare ? bare->length * bare->count : 0;
  double by = 0;
  bool judged = false; // by bare sequences: where one of the two does not know its error, neither says which is better
  const bool begun = run.o.density || (bare && run.calls >= calls && learner.width() < wide);
  for (std::uint64_t k = begun ? 1 : 0; calls / run.o.replicates >= 8; ++k) {
    const std::uint64_t points = calls / run.o.replicates;
    const double before = learner.width();
    const Means round =
        seen_through(run, std::make_shared<AdaptedDensity>(learner.density()), 2 + k, points, &learner, said);
    centre = values(round);
    spent += calls;
    if (bare) by = ahead(round, points, *bare);
    judged = bare && !vague(bare->history.back()) && !vague(round);
    // Hopeless: worse than the bare sequences although no rare large values are left to be found.
    if (judged && k > 0 && learner.width() < wide && by < -doubt(bare->history.back()) - 0.5) return {};
    const auto now = static_cast<double>(points * run.o.replicates), seen = static_cast<double>(before_all + spent);
    if (k >= 1) calls *= 2;
    const bool searching = (!bare || unresolved(bare->history.back())) && learner.width() > wide,
               helps = pays(before - learner.width(), now, seen, static_cast<double>(calls),
                            static_cast<double>(run.left())) ||
                       by > (learner.width() > wide ? 0.2 : 0.7);
    const std::uint64_t most = std::min(run.o.max_calls / 5 * (searching ? 2 : 1), room);
    if (k >= 2 && (learner.width() < 0.5 || !(searching || helps) || spent + calls > most)) break;
  }
  // A small lead is not worth the calls of a contest: the bare sequences make it up with them.
  if (judged && learner.width() < narrow && by < small_lead) return {};
  return Learned{std::make_shared<AdaptedDensity>(learner.density()), std::move(centre)};
}

} // namespace mc::detail

#include <mc/estimate/integrate/learner.h>
#include <mc/estimate/integrate/methods.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
// By how much the logarithm of the variance of a round lies below that of the bare sequences, for as many points, at
// the length next to it or at their last, whichever says more for the round: what few points met looks too good in
// either.
double ahead(const Means& round, std::uint64_t points, const Sequences& bare) {
  std::size_t at = 0;
  for (std::uint64_t length = 16; 2 * length <= points && at + 1 < bare.history.size(); length *= 2) ++at;
  const auto by = [&](std::size_t k) {
    const double more = std::log(static_cast<double>(points) / std::ldexp(16.0, static_cast<int>(k)));
    return log_ratio(bare.history[k], round) - more * static_cast<double>(round.size());
  };
  return std::max(by(at), by(bare.history.size() - 1));
}

// A round of learning from so many points of each replicate.
Means learn_round(Run& run, Learner& learner, std::uint64_t purpose, std::uint64_t points) {
  const Proposal proposal{.density = std::make_shared<AdaptedDensity>(learner.density())};
  const std::vector<Sums> sums =
      run.evaluate_all(run.sobol_sets(purpose, 0, run.o.replicates), 0, points, proposal, true);
  learner.learn(sums);
  std::vector<Evidence> evidence;
  run.rounds.push_back(run.means(sums, points, evidence));
  run.report(run.rounds.back());
  return run.rounds.back();
}
} // namespace

std::optional<Learned> learn(Run& run, const Sequences* bare) {
  const std::uint64_t least = std::min<std::uint64_t>(run.o.max_calls / 4, 1 << 13), room = run.recordable();
  const std::uint64_t budget = std::clamp<std::uint64_t>(run.o.max_calls / 32, least, std::max(room / 4, least));
  const std::uint64_t most = std::min(run.o.max_calls / 5, room);
  Learner learner(run);
  if (bare) learner.learn(bare->sums);
  Learned learned;
  // Rounds of a quarter, a quarter and a half of the budget; after that of twice the calls, as long as the values are
  // spread widely and it helps.
  std::uint64_t calls = budget / 4, spent = 0;
  for (std::uint64_t k = 0; calls / run.o.replicates >= 8; ++k) {
    const std::uint64_t points = calls / run.o.replicates;
    const double before = learner.width();
    const Means round = learn_round(run, learner, 2 + k, points);
    learned.centre.clear();
    for (const Mean& m : round) learned.centre.push_back(m.value);
    spent += calls;
    const double by = bare ? ahead(round, points, *bare) : 0;
    // Hopeless: worse than the bare sequences although no rare large values are left to be found.
    if (bare && k > 0 && learner.width() < 2 && by < -doubt(bare->history.back()) - 0.5) return {};
    if (k >= 1) calls *= 2;
    const bool helps = learner.width() < 0.85 * before || by > 0.7;
    if (k >= 2 && (learner.width() < 0.5 || !helps || spent + calls > most)) break;
  }
  learned.centre.resize(run.outputs);
  learned.density = learner.density();
  return learned;
}

} // namespace mc::detail

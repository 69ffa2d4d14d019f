#include <mc/core/types.h>
#include <mc/estimate/integrate/methods/methods.h>
#include <mc/random/hash.h>

#include <algorithm>

namespace mc::detail {

namespace {
constexpr std::uint64_t first_points = 64; // of each replicate in the first round

// A round of jittered points in every replicate.
Outcome jittered_round(Run& run, std::uint64_t points, std::uint64_t round, std::vector<SampledValues>& sampled,
                       std::vector<SpreadHistory>& histories, std::vector<std::uint64_t>& infinite) {
  std::vector<PointSet> sets;
  for (std::uint32_t r = 0; r < run.options().replicates; ++r)
    sets.emplace_back(JitteredBoxes{hash(run.options().seed, static_cast<std::uint64_t>(Stream::stratified), round, r),
                                    static_cast<std::uint32_t>(points)});
  const std::vector<Sums> sums = run.evaluator.evaluate(sets, 0, points, {}, {}, sampled);
  std::vector<std::vector<double>> values(run.evaluator.outputs);
  Outcome result{.means = {}, .method = Method::stratified};
  for (std::size_t k = 0; k < values.size(); ++k) {
    for (const Sums& s : sums) {
      sampled[k].merge(s.sampled[k]);
      values[k].push_back(s.outputs[k].mean());
      if (!s.infinite.empty()) infinite[k] += s.infinite[k].count;
    }
    result.means.push_back(mean_of_replicates(values[k], static_cast<double>(points), sampled[k], run.evaluator.dim,
                                              histories[k], run.tuning));
    if (infinite[k] > 0) result.means.back().bar = ErrorBar::infinite_variance;
  }
  result.correlations = correlations(values);
  return result;
}
} // namespace

// Independent rounds, weighted by the square of their number of points: equal weights would let early rounds dominate
// an error that falls faster than N^-1/2; weights by the measured variances would bias the mean.
Outcome run_stratified(Run& run) {
  const std::size_t outputs = run.evaluator.outputs;
  Outcome out{.means = {}, .method = Method::stratified, .infinite = std::vector<std::uint64_t>(outputs)};
  std::vector<SampledValues> sampled(outputs);
  std::vector<SpreadHistory> histories(outputs);
  const std::uint64_t replicates = run.options().replicates;
  double weight = 0;
  const std::uint64_t all = run.evaluator.remaining() / replicates; // too few for two rounds go into one
  for (std::uint64_t points = all < 3 * first_points ? std::max<std::uint64_t>(all, 1) : first_points, round = 0;;
       ++round) {
    Outcome now = jittered_round(run, points, round, sampled, histories, out.infinite);
    run.record(Method::stratified, now.means);
    const double square = sqr(static_cast<double>(points)), share = square / (weight + square);
    weight += square;
    if (round == 0) {
      out.means = now.means;
      out.correlations = now.correlations;
    } else {
      run.rounds.back().compare(out.means);
      out.correlations = combine_independent(out.correlations, out.means, now.correlations, now.means, share);
      for (std::size_t k = 0; k < outputs; ++k) {
        // Rounds of zeros have no error; it is that of half as many points once another value is known.
        if (out.means[k].bar == ErrorBar::all_zero) out.means[k].error = 2 * now.means[k].error;
        out.means[k] = combine_independent(out.means[k], now.means[k], share);
      }
    }
    if (run.converged(out.means)) out.stop = StopReason::converged;
    // The last round takes all that is left, rather than leave too little for another doubling.
    const std::uint64_t left = std::min<std::uint64_t>(run.evaluator.remaining() / replicates, 0xffffffffu);
    if (out.stop == StopReason::converged || left < points) return out;
    points = left < 4 * points ? left : 2 * points;
    run.last = out;
  }
}

} // namespace mc::detail

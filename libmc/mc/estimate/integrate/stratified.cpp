#include <mc/estimate/integrate/methods.h>

#include <algorithm>

namespace mc::detail {

// Combines independent rounds with weights (number of points)^2. With weights proportional to the number, early rounds
// would dominate an error that falls faster than N^-1/2. With measured variances as weights, the mean would be biased.
Outcome stratified(IntegrationRun& run, std::optional<Outcome>& last) {
  Outcome out{{}, Method::stratified};
  double weight = 0;
  std::vector<ReplicateHistory> histories;
  for (std::uint64_t points = std::min<std::uint64_t>(64, run.calls_left() / run.options.replicates), round = 0;;
       ++round) {
    std::vector<PointSet> sets;
    for (std::uint32_t r = 0; r < run.options.replicates; ++r)
      sets.emplace_back(JitteredBoxes{hash(run.options.seed, round, r), static_cast<std::uint32_t>(points)});
    const std::vector<Sums> sums = run.evaluate_all(sets, 0, points);
    // the tail uses the values of all rounds
    const Means now = run.means(sums, points, histories, {}, {}, out.diagnostics);
    run.record(Method::stratified, now);
    out.diagnostics.resize(run.outputs);
    for (const Sums& s : sums)
      for (std::size_t k = 0; k < run.outputs; ++k) out.diagnostics[k].merge(s.diagnostics[k]);
    const double square = sqr(static_cast<double>(points)), share = square / (weight + square);
    weight += square;
    const Correlations together = correlations(run.replicate_means(sums));
    if (round == 0) {
      out.means = now;
      out.correlations = together;
    } else {
      run.add_chi2(run.rounds.back(), out.means);
      out.correlations = combine_independent(out.correlations, out.means, together, now, share);
      for (std::size_t k = 0; k < run.outputs; ++k) {
        // Earlier rounds had only zeros. Their error is set to the error of half as many points.
        if (out.means[k].error_bar == ErrorBar::all_zero) out.means[k].error = 2 * now[k].error;
        out.means[k] = combine_independent(out.means[k], now[k], share);
      }
    }
    if (run.converged(out.means)) out.stop = StopReason::converged;
    // The last round takes all remaining calls if they do not suffice for another doubling after it.
    const std::uint64_t left = std::min<std::uint64_t>(run.calls_left() / run.options.replicates, 0xffffffffu);
    if (out.stop == StopReason::converged || left < points) return out;
    points = left < 4 * points ? left : 2 * points;
    last = out;
  }
}

} // namespace mc::detail

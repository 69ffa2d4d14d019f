#include <mc/estimate/integrate/methods.h>

#include <algorithm>

namespace mc::detail {

// Independent rounds, weighed by the square of their number of points: by the number alone, the early rounds would
// dominate an error that falls faster than N^-1/2; by the measured variances, the mean would be biased.
Outcome stratified(Run& run, std::optional<Outcome>& last) {
  Outcome out{{}, Method::stratified};
  double weight = 0;
  std::vector<Evidence> evidence;
  for (std::uint64_t points = std::min<std::uint64_t>(64, run.left() / run.o.replicates), round = 0;; ++round) {
    std::vector<PointSet> sets;
    for (std::uint32_t r = 0; r < run.o.replicates; ++r)
      sets.emplace_back(JitteredBoxes{hash(run.o.seed, round, r), static_cast<std::uint32_t>(points)});
    const std::vector<Sums> sums = run.evaluate_all(sets, 0, points);
    const Means now = run.means(sums, points, evidence, {}, {}, out.seen); // a tail is that of all rounds
    run.record(Method::stratified, now);
    out.seen.resize(run.outputs);
    for (const Sums& s : sums)
      for (std::size_t k = 0; k < run.outputs; ++k) out.seen[k].merge(s.seen[k]);
    const double square = sqr(static_cast<double>(points)), share = square / (weight + square);
    weight += square;
    const Correlations together = correlations(run.replicate_means(sums));
    if (round == 0) {
      out.means = now;
      out.correlations = together;
    } else {
      run.compare(run.rounds.back(), out.means);
      out.correlations = combined(out.correlations, out.means, together, now, share);
      for (std::size_t k = 0; k < run.outputs; ++k) {
        // Rounds of zeros only: once something is seen, their error is that of half as many points.
        if (out.means[k].bar == ErrorBar::unseen) out.means[k].error = 2 * now[k].error;
        out.means[k] = combined(out.means[k], now[k], share);
      }
    }
    if (run.converged(out.means)) out.stop = Stop::converged;
    // The last round takes all that is left rather than leave a rest that is too small for another doubling.
    const std::uint64_t left = std::min<std::uint64_t>(run.left() / run.o.replicates, 0xffffffffu);
    if (out.stop == Stop::converged || left < points) return out;
    points = left < 4 * points ? left : 2 * points;
    last = out;
  }
}

} // namespace mc::detail

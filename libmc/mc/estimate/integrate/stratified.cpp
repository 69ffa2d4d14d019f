#include <mc/estimate/integrate/methods.h>

#include <algorithm>

namespace mc::detail {

// Independent rounds, weighed by the square of their number of points: by the number alone, the early rounds would
// dominate an error that falls faster than N^-1/2; by the measured variances, the mean would be biased.
Outcome stratified(Run& run, std::optional<Outcome>& last) {
  Outcome out{Means(run.outputs), Method::stratified};
  double weight = 0;
  for (std::uint64_t points = std::min<std::uint64_t>(64, run.left() / run.o.replicates), round = 0;; ++round) {
    std::vector<PointSet> sets;
    for (std::uint32_t r = 0; r < run.o.replicates; ++r)
      sets.emplace_back(Stratified(static_cast<std::uint32_t>(points), hash(run.o.seed, round, r),
                                   static_cast<std::uint32_t>(std::min(run.dim, 8))));
    const Means now = run.means(run.evaluate_all(sets, 0, points));
    if (round > 0) run.compare(now, out.means);
    const double square = sqr(static_cast<double>(points)), share = square / (weight + square);
    weight += square;
    for (std::size_t k = 0; k < run.outputs; ++k) {
      const Mean& all = out.means[k];
      const Mean a{all.value, sqr(1 - share) * all.variance, std::max(all.dof, 1.0)},
          b{now[k].value, sqr(share) * now[k].variance, now[k].dof};
      out.means[k] = {a.value + share * (b.value - a.value), a.variance + b.variance, welch(a, b)};
    }
    run.report(out.means);
    if (run.converged(out.means)) out.stop = Stop::converged;
    // The last round takes all that is left rather than leave a rest that is too small for another doubling.
    const std::uint64_t left = std::min(run.left() / run.o.replicates, (std::uint64_t{1} << 32) - 1);
    if (out.stop == Stop::converged || left < points) return out;
    points = left < 4 * points ? left : 2 * points;
    last = out;
  }
}

} // namespace mc::detail

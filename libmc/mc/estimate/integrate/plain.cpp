#include <mc/estimate/integrate/methods.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
// Of independent values. What they share of a heavy tail, and what equal values leave unseen, as in replicated().
Mean of_values(const ScaledMoments& m, const Seen& seen, std::span<const double> batch_means) {
  const Magnitudes& all = seen.values;
  const double n = static_cast<double>(all.count()), size = std::max(std::abs(all.lo()), std::abs(all.hi()));
  if (size == 0) return {0, 0, n - 1, 0, ErrorBar::unseen};
  const double index = all.tail_index(), beyond = index < 20 ? std::pow(n, 2 / index - 1) : 0;
  const double spread = m.std_error() / std::sqrt(1 - std::min(beyond, 0.9));
  const double unseen = seen.constant() ? 1.5 * size / n : 0.0;
  const double skew = skew_of_mean(skewness(batch_means), static_cast<double>(batch_means.size()));
  return {m.mean(), std::max({spread, unseen, ulp(m.mean())}), n - 1, skew, bar_of(seen), 0, seen.constant()};
}

// Of those batches that have values.
std::vector<std::vector<double>> batch_means(const Sums& total) {
  std::vector<std::vector<double>> means(total.outputs.size());
  for (std::size_t i = 0; i < total.batches.size(); ++i)
    if (total.batches[i].moments().count() > 0) means[i / Sums::batch_count].push_back(total.batches[i].mean());
  return means;
}
} // namespace

Outcome plain(Run& run, std::optional<Outcome>& last) {
  Sums total;
  // Rounds of 1024 points, then each of as many as all before it.
  for (std::uint64_t first = 0;;) {
    const std::uint64_t count = std::min(std::max<std::uint64_t>(first, 1024), run.left());
    total.merge(run.evaluate_all({Independent{run.o.seed}}, first, count, {}, Keep::batches).front());
    Outcome out{{}, Method::plain};
    const std::vector<std::vector<double>> batches = batch_means(total);
    for (std::size_t k = 0; k < run.outputs; ++k)
      out.means.push_back(of_values(total.outputs[k], total.seen[k], batches[k]));
    out.seen = total.seen;
    out.correlations = correlations(batches);
    run.record(Method::plain, out.means);
    if (run.converged(out.means)) out.stop = Stop::converged;
    if (out.stop == Stop::converged || run.left() == 0) return out;
    last = out;
    first += count;
  }
}

} // namespace mc::detail

#include <mc/estimate/integrate/methods.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
// Mean of independent values. Treats heavy tails and equal values as mean_of_replicates() does.
Mean of_values(const ScaledMoments& m, const IntegrandDiagnostics& diagnostics, std::span<const double> batch_means) {
  const OctaveHistogram& all = diagnostics.values;
  const double n = static_cast<double>(all.count()), size = std::max(std::abs(all.lo()), std::abs(all.hi()));
  if (size == 0) return {0, 0, n - 1, 0, ErrorBar::all_zero};
  const double index = all.tail_index(), unsampled_variance_share = index < 20 ? std::pow(n, 2 / index - 1) : 0;
  const double spread = m.std_error() / std::sqrt(1 - std::min(unsampled_variance_share, 0.9));
  const double unsampled_bound = diagnostics.constant() ? 1.5 * size / n : 0.0;
  const double skew = skew_of_mean(skewness(batch_means), static_cast<double>(batch_means.size()));
  return {m.mean(),
          std::max({spread, unsampled_bound, ulp(m.mean())}),
          n - 1,
          skew,
          error_bar_of(diagnostics),
          0,
          diagnostics.constant()};
}

// Means of the batches that contain values, for each output.
std::vector<std::vector<double>> batch_means(const Sums& total) {
  std::vector<std::vector<double>> means(total.outputs.size());
  for (std::size_t i = 0; i < total.batches.size(); ++i)
    if (total.batches[i].moments().count() > 0) means[i / Sums::batch_count].push_back(total.batches[i].mean());
  return means;
}
} // namespace

Outcome plain(IntegrationRun& run, std::optional<Outcome>& last) {
  Sums total;
  // The first round has 1024 points; each further round doubles the total.
  for (std::uint64_t first = 0;;) {
    const std::uint64_t count = std::min(std::max<std::uint64_t>(first, 1024), run.calls_left());
    total.merge(run.evaluate_all({Independent{run.options.seed}}, first, count, {}, Keep::batches).front());
    Outcome out{{}, Method::plain};
    const std::vector<std::vector<double>> batches = batch_means(total);
    for (std::size_t k = 0; k < run.outputs; ++k)
      out.means.push_back(of_values(total.outputs[k], total.diagnostics[k], batches[k]));
    out.diagnostics = total.diagnostics;
    out.correlations = correlations(batches);
    run.record(Method::plain, out.means);
    if (run.converged(out.means)) out.stop = StopReason::converged;
    if (out.stop == StopReason::converged || run.calls_left() == 0) return out;
    last = out;
    first += count;
  }
}

} // namespace mc::detail

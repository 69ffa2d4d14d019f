#include <mc/estimate/integrate/corrections/skewness.h>
#include <mc/estimate/integrate/methods/methods.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc::detail {

namespace {
// The mean of independent values, with the corrections for skewness and tail. Their variance is known from all values,
// so that none is pooled.
Mean mean_of_values(const Run& run, const ScaledMoments& m, const Extremes& extremes,
                    std::span<const double> batch_means, std::span<const std::array<double, 2>> shapes,
                    const TailFindings& tails) {
  const double count = static_cast<double>(extremes.count());
  const double size = std::max(std::abs(extremes.lo()), std::abs(extremes.hi()));
  Mean mean{.value = m.mean(),
            .dof = count - 1,
            .skew = skew_of_mean(batch_means, run.tuning),
            .bar = judge(extremes, tails.contribution, shapes, run.evaluator.dim, run.tuning)};
  mean.constant = is_constant(extremes);
  mean.tail_index = 1 / std::max(tail_shape(shapes, run.tuning), 0.0);
  mean.error = std::max({m.std_error(), mean.constant ? run.tuning.unseen_value * size / count : 0.0,
                         std::numeric_limits<double>::epsilon() * std::abs(mean.value)});
  if (!mean.constant) mean.tail = tails.contribution;
  return mean;
}

// The means of the batches that have values, for each output.
std::vector<std::vector<double>> batch_means(const Sums& total) {
  std::vector<std::vector<double>> means(total.outputs.size());
  for (std::size_t i = 0; i < total.batches.size(); ++i)
    if (total.batches[i].moments().count() > 0) means[i / Sums::batch_count].push_back(total.batches[i].mean());
  return means;
}
} // namespace

// Rounds of 1024 points, then each of as many as all before it.
Outcome run_plain(Run& run) {
  Sums total;
  std::vector<std::vector<std::array<double, 2>>> shapes(run.evaluator.outputs);
  for (std::uint64_t first = 0;;) {
    const std::uint64_t count = std::min(std::max<std::uint64_t>(first, 1024), run.evaluator.remaining());
    const std::uint64_t seed = run.options().seed;
    total.merge(
        run.evaluator.evaluate({Independent{seed}}, first, count, {}, {.batches = true}, total.sampled).front());
    Outcome out{.means = {}, .method = Method::plain};
    const std::vector<std::vector<double>> batches = batch_means(total);
    for (std::size_t k = 0; k < run.evaluator.outputs; ++k) {
      const TailFindings tails = tails_of(total.sampled[k], std::numeric_limits<double>::infinity(), run.tuning);
      shapes[k].push_back(tails.shape);
      out.means.push_back(
          mean_of_values(run, total.outputs[k], total.sampled[k].averaged, batches[k], shapes[k], tails));
      out.infinite.push_back(total.infinite.empty() ? 0 : total.infinite[k].count);
      if (out.infinite.back() > 0) out.means.back().bar = ErrorBar::infinite_variance;
    }
    out.correlations = correlations(batches);
    run.record(Method::plain, out.means);
    if (run.converged(out.means)) out.stop = StopReason::converged;
    if (out.stop == StopReason::converged || run.evaluator.remaining() == 0) return out;
    run.last = out;
    first += count;
  }
}

} // namespace mc::detail

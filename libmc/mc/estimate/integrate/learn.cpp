#include <mc/estimate/integrate/methods.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mc::detail {

Learned learn(Run& run) {
  const std::uint64_t least = std::min<std::uint64_t>(run.o.max_calls / 4, 1 << 13);
  const std::uint64_t budget = std::clamp<std::uint64_t>(run.o.max_calls / 32, least, 1 << 18);
  Learned learned{ImportanceGrid(run.dim), std::vector<double>(run.outputs)};
  Learning learning{std::vector<double>(run.outputs, 1.0), 1};
  constexpr std::array<std::uint64_t, 5> share = {16, 16, 8, 4, 2};
  const std::uint32_t r = run.o.replicates;
  for (std::size_t k = 0; k < share.size(); ++k) {
    const std::uint64_t points = budget / share[k] / r;
    if (points < 8) continue;
    const std::vector<Sums> sums =
        run.evaluate_all(run.sobol_sets(2 + k, 0, r), 0, points, {.grid = &learned.grid}, &learning);
    std::vector<Evidence> evidence;
    run.rounds.push_back(run.means(sums, points, evidence));
    run.report(run.rounds.back());
    Sums total;
    for (const Sums& s : sums) total.merge(s);
    learned.grid.refine(total.power, points * r);
    double widest = 0; // the variance of the logarithm, were the values log-normal
    for (std::size_t j = 0; j < run.outputs; ++j) {
      const double mean = total.outputs[j].mean(), variation = total.outputs[j].variation();
      learned.centre[j] = mean;
      // Outputs of different size count alike from the second round on.
      const double size = std::hypot(mean, variation);
      learning.scale[j] = size > 0 && std::isfinite(1 / size) ? 1 / size : 0;
      if (mean != 0) widest = std::max(widest, std::log1p(sqr(variation / mean)));
    }
    learning.power = std::min(2.0, std::sqrt(8 / std::max(widest, 1e-3)));
  }
  return learned;
}

} // namespace mc::detail

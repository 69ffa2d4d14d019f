#include <mc/estimate/integrate/methods.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mc::detail {

ImportanceGrid learn(Run& run, std::vector<double>& scale) {
  const std::uint64_t least = std::min<std::uint64_t>(run.o.max_calls / 4, 1 << 13);
  const std::uint64_t budget = std::clamp<std::uint64_t>(run.o.max_calls / 32, least, 1 << 18);
  ImportanceGrid grid(run.dim);
  constexpr std::array<std::uint64_t, 5> share = {16, 16, 8, 4, 2};
  const std::uint32_t r = run.o.replicates;
  for (std::size_t k = 0; k < share.size(); ++k) {
    const std::uint64_t points = budget / share[k] / r;
    if (points < 8) continue;
    const std::vector<Sums> sums = run.evaluate_all(run.sobol_sets(2 + k, 0, r), 0, points, &grid, scale);
    std::vector<Evidence> evidence;
    run.rounds.push_back(run.means(sums, points, evidence));
    run.report(run.rounds.back());
    Sums total;
    for (const Sums& s : sums) total.merge(s);
    grid.refine(total.power, points * r);
    // Outputs of different size count alike from the second round on.
    for (std::size_t j = 0; j < run.outputs; ++j) {
      const double size = std::hypot(total.outputs[j].mean(), total.outputs[j].variation());
      scale[j] = size > 0 && std::isfinite(1 / size) ? 1 / size : 0;
    }
  }
  return grid;
}

} // namespace mc::detail

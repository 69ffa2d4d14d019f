#include <mc/estimate/integrate/sequences.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

Means Sequences::extend(Run& run, std::uint64_t to) {
  if (sets.empty()) sets = run.sobol_sets(purpose, 0, run.o.replicates);
  sums.resize(sets.size());
  const std::vector<Sums> more = run.evaluate_all(sets, length, to - length, grid);
  for (std::size_t r = 0; r < sums.size(); ++r) sums[r].merge(more[r]);
  length = to;
  history.push_back(run.means(sums, length, evidence));
  return history.back();
}

Means Sequences::widen(Run& run, std::uint32_t count) {
  const auto have = static_cast<std::uint32_t>(sets.size());
  const std::vector<PointSet> more = run.sobol_sets(purpose, have, have + count);
  const std::vector<Sums> theirs = run.evaluate_all(more, 0, length, grid);
  sets.insert(sets.end(), more.begin(), more.end());
  sums.insert(sums.end(), theirs.begin(), theirs.end());
  return run.means(sums, length, evidence);
}

std::vector<Magnitudes> Sequences::seen() const {
  Sums total;
  for (const Sums& s : sums) total.merge(s);
  return total.magnitudes;
}

double advantage(const Sequences& a, const Sequences& b, double doublings) {
  const std::size_t steps = std::min<std::size_t>(std::min(a.history.size(), b.history.size()) - 1, 3);
  const auto error = [](const Sequences& s, std::size_t back, std::size_t k) {
    return 2 * std::log(s.history[s.history.size() - 1 - back][k].error + 1e-300);
  };
  double sum = 0;
  for (std::size_t k = 0; k < a.history.back().size(); ++k) {
    const double now = error(a, 0, k) - error(b, 0, k), then = error(a, steps, k) - error(b, steps, k);
    sum += now + (steps > 0 ? (now - then) * doublings / static_cast<double>(steps) : 0);
  }
  return sum;
}

} // namespace mc::detail

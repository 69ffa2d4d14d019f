#include <mc/estimate/integrate/sequences.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
constexpr std::uint64_t of_uniform = 1000; // added to the purpose

// Sets [first, last) of a purpose with their points [from, to).
void add(Run& run, std::uint64_t purpose, std::uint32_t first, std::uint32_t last, std::uint64_t from, std::uint64_t to,
         const Proposal& proposal, std::vector<PointSet>& sets, std::vector<Sums>& sums) {
  if (sets.size() < last) {
    const std::vector<PointSet> more = run.sobol_sets(purpose, static_cast<std::uint32_t>(sets.size()), last);
    sets.insert(sets.end(), more.begin(), more.end());
    sums.resize(sets.size());
  }
  if (from == to) return;
  const std::vector<Sums> more =
      run.evaluate_all({sets.begin() + first, sets.begin() + last}, from, to - from, proposal);
  for (std::uint32_t r = first; r < last; ++r) sums[r].merge(more[r - first]);
}

// Both parts of the mixture, or the one there is.
Means grown(Run& run, Sequences& s, std::uint32_t first, std::uint32_t last, std::uint64_t from, std::uint64_t to) {
  Proposal part = s.proposal;
  if (part.grid) part.part = Proposal::Part::of_grid;
  add(run, s.purpose, first, last, from, to, part, s.sets, s.sums);
  if (part.grid) {
    part.part = Proposal::Part::of_uniform;
    add(run, s.purpose + of_uniform, first, last, (from + 7) / 8, (to + 7) / 8, part, s.uniform_sets, s.uniform_sums);
  }
  return run.means(s.sums, s.length, s.evidence, s.uniform_sums, s.proposal);
}
} // namespace

Means Sequences::extend(Run& run, std::uint64_t to) {
  const std::uint64_t from = length;
  length = to;
  history.push_back(grown(run, *this, 0, run.o.replicates, from, to));
  return history.back();
}

Means Sequences::widen(Run& run, std::uint32_t count) {
  const auto have = static_cast<std::uint32_t>(sets.size());
  return grown(run, *this, have, have + count, 0, length);
}

std::vector<Magnitudes> Sequences::seen() const {
  Sums total;
  for (const Sums& s : sums) total.merge(s);
  for (const Sums& s : uniform_sums) total.merge(s);
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

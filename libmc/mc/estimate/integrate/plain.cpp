#include <mc/estimate/integrate/methods.h>

#include <algorithm>

namespace mc::detail {

Outcome plain(Run& run, std::optional<Outcome>& last) {
  Sums total;
  for (std::uint64_t first = 0, count = 1024;; first += count, count = first) {
    count = std::min(count, run.left());
    total.merge(run.evaluate_all({Independent{run.o.seed}}, first, count).front());
    Outcome out{{}, Method::plain};
    for (const Moments& m : total.outputs)
      out.means.push_back({m.mean(), sqr(m.std_error()), static_cast<double>(m.count() - 1)});
    run.report(out.means);
    if (run.converged(out.means)) out.stop = Stop::converged;
    if (out.stop == Stop::converged || run.left() == 0) return out;
    last = out;
  }
}

} // namespace mc::detail

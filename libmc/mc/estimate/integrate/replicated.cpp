#include <mc/estimate/integrate/methods.h>
#include <mc/estimate/integrate/sequences.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace mc::detail {

namespace {
// What an advantage must exceed to be more than the chance of variances that few replicates estimate, the more the more
// skewed they are: where few points met what counts, either may look good.
double doubt(const Sequences& a, const Sequences& b) {
  double sum = 0;
  for (const Sequences* s : {&a, &b})
    for (const Mean& m : s->history.back()) sum += 0.35 + 10 * std::abs(m.skew);
  return sum;
}
} // namespace

Outcome sequences(Run& run, Method method, std::optional<Outcome>& last) {
  Outcome out{{}, method == Method::vegas ? Method::vegas : Method::rqmc};
  const auto affordable = [&](const Sequences& s) {
    return std::min(std::bit_floor(s.length + static_cast<std::uint64_t>(
                                                  static_cast<double>(run.left() / run.o.replicates) / s.cost())),
                    Sequences::longest);
  };
  const auto done = [&] {
    run.report(out.means);
    if (run.converged(out.means)) out.stop = Stop::converged;
    last = out;
    return out.stop == Stop::converged;
  };
  const auto next = [](const Sequences& s, std::uint64_t end) {
    return std::max(std::min<std::uint64_t>(16, end), 2 * s.length);
  };
  const auto grow = [&](Sequences& s, std::uint64_t end) {
    for (std::uint64_t to = next(s, end); to <= end; to *= 2) {
      out.means = s.extend(run, to);
      out.seen = s.seen();
      if (done()) return true;
    }
    return false;
  };

  Sequences chosen{.purpose = 0};
  if (method == Method::rqmc && grow(chosen, affordable(chosen))) return out;
  if (method == Method::automatic && grow(chosen, std::max<std::uint64_t>(affordable(chosen) / 16, 1))) return out;
  std::optional<Learned> learned;
  if (method != Method::rqmc) {
    learned = learn(run);
    Sequences guided{.purpose = 1, .proposal = {&learned->grid, learned->centre}};
    if (method == Method::vegas) chosen = std::move(guided);
    else {
      const std::uint64_t end = std::min(chosen.length, affordable(guided));
      if (end == 0) return out; // nothing is left to hold the grid against the bare sequences with
      for (std::uint64_t to = next(guided, end); to <= end; to *= 2) guided.extend(run, to);
      // Interlaced points may start worse and fall faster, so where there are any the two compete at the length they
      // would end with.
      const double doublings =
          run.interlaced() ? std::log2(static_cast<double>(affordable(guided)) / static_cast<double>(end)) : 0;
      if (!run.disagree(chosen.history.back(), guided.history.back()) &&
          advantage(chosen, guided, doublings) > doubt(chosen, guided)) {
        run.rounds.push_back(chosen.history.back());
        out.means = guided.history.back();
        out.seen = guided.seen();
        out.method = Method::vegas;
        chosen = std::move(guided);
        if (done()) return out;
      } else run.rounds = {guided.history.back()};
    }
    if (grow(chosen, affordable(chosen))) return out;
  }
  // What is left is too little for twice the length, but may do for more replicates.
  if (const std::uint64_t more = run.left() / std::max<std::uint64_t>(chosen.calls_each(), 1); more > 0) {
    out.means = chosen.widen(run, static_cast<std::uint32_t>(more));
    out.seen = chosen.seen();
    done();
  }
  return out;
}

} // namespace mc::detail

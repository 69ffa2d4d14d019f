#include <mc/estimate/integrate/methods/methods.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace mc::detail {

namespace {
constexpr std::uint32_t fewest_replicates = 8; // fewer know their own spread too badly
constexpr std::uint64_t longest = std::uint64_t{1} << 32;

// Replicates to add so that the errors reach the wanted ones; 0 unless that is cheaper than to double the length.
std::uint32_t missing_replicates(const Run& run, const Replicates& r) {
  const double excess = run.excess(r.means()), more = std::ceil(r.count() * (excess * excess - 1));
  return excess > 1 && more <= 0.5 * r.count() ? static_cast<std::uint32_t>(more) : 0;
}
} // namespace

bool extend_or_add(Run& run, Replicates& r, bool record) {
  const std::uint64_t left = run.evaluator.remaining();
  if (r.length() == 0) {
    r.extend(std::bit_floor(std::clamp<std::uint64_t>(left / r.count(), 1, Replicates::first_length)), record);
    return true;
  }
  const std::uint64_t most = left / r.length();
  if (most == 0) return false;
  const std::uint32_t missing = missing_replicates(run, r);
  if (missing > 0 && missing <= most) {
    r.add(missing);
    return true;
  }
  const bool may_double = 2 * r.length() <= longest;
  if (r.count() <= most && may_double) {
    r.extend(2 * r.length(), record);
    return true;
  }
  // The last calls. Error relative to the present one: n^-rate / sqrt(replicates).
  const double now = r.count(), more = static_cast<double>(most);
  const double longer = std::exp2(-r.rate()) * std::sqrt(now / more), wider = std::sqrt(now / (now + more));
  if (most >= std::min(fewest_replicates, r.count()) && most < r.count() && longer < wider && may_double) {
    r.keep_first(static_cast<std::uint32_t>(most));
    r.extend(2 * r.length());
  } else r.add(static_cast<std::uint32_t>(most));
  return true;
}

Outcome run_rqmc(Run& run) {
  Replicates r(run, Stream::rqmc, 0, run.options().replicates);
  while (extend_or_add(run, r)) {
    run.record(Method::rqmc, r.means());
    run.last = r.outcome(Method::rqmc);
    if (!run.converged(r.means())) continue;
    run.last->stop = StopReason::converged;
    break;
  }
  return *run.last;
}

} // namespace mc::detail

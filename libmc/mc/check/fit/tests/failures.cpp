#include <mc/check/fit/tests/fit_test.h>
#include <mc/stats/binomial.h>

#include <fmt/format.h>

#include <algorithm>

namespace mc {

// Tests the rate of failures against 1 - mass. The error of the integral is conceded; if it is large, the check of the
// mass is inconclusive.
FitTest failures_test(const FitSetup&, double share) {
  return {.judge = [share](const FitCounts& counts) {
    const double failed = static_cast<double>(counts.draws.failed.count),
                 draws = static_cast<double>(counts.draws.draws);
    const double mass = counts.mass.value, expected = std::clamp(1 - mass, 0.0, 1.0), rate = failed / draws;
    const double slack = counts.mass.error + counts.setup.subject.mass_tolerance;
    const double conceded = rate > expected ? std::min(expected + slack, rate) : std::max(expected - slack, rate);
    return Findings{{statistical_check(
        "failure rate", binomial_tail(failed, draws, conceded), failed, share, counts.setup.options.alpha,
        Fault::failure,
        fmt::format("{} of {} samples failed, {:.1f} expected since the density integrates to {:.8g} +- {:.2g}",
                    counts.draws.failed.count, counts.draws.draws, expected * draws, mass, counts.mass.error))}};
  }};
}

} // namespace mc

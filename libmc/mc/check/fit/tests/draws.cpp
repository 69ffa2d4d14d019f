#include <mc/check/fit/tests/fit_test.h>

namespace mc {

// Laws of every sample, including the pilot.
FitTest draws_law(const FitSetup&, double) {
  return {.judge = [](const FitCounts& counts) {
    const auto& [subject, options, pilot] = counts.setup;
    return Findings{check_draws(subject, merge(counts.draws, pilot.stats), options.open_interval)};
  }};
}

} // namespace mc

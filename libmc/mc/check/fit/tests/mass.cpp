#include <mc/check/fit/tests/fit_test.h>

namespace mc {

// The claimed density and the outcomes integrate to 1; to at most 1 if the subject may fail.
FitTest mass_test(const FitSetup&, double share) {
  return {.judge = [share](const FitCounts& counts) {
    return Findings{{test_mass(counts.setup.subject, counts.mass, share, counts.setup.options.alpha)}};
  }};
}

} // namespace mc

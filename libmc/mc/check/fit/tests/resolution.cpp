#include <mc/check/fit/tests/fit_test.h>

namespace mc {

// Law: the coordinates along each axis have enough distinct values for a test.
FitTest resolution_law(const FitSetup&, double) {
  return {.judge = [](const FitCounts& counts) {
    return Findings{find_unresolved(counts.setup.subject, counts.setup.pilot)};
  }};
}

} // namespace mc

#pragma once
/// Correct and wrong subjects for which earlier checkers gave the wrong verdict.

#include <mc/check/random_subjects.h>

namespace checker_bench {

struct RegressionSubject {
  Subject subject;
  bool right;
};

/// Returns tables of any texture with and without their breaks, narrow lobes, heavy tails, singularities and jumps
/// along curves. Also faults finer than the cells, thinner than the bins, or rare among the samples.
std::vector<RegressionSubject> regression_subjects();

} // namespace checker_bench

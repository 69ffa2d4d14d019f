#pragma once
/// Samplers from elsewhere on which earlier checkers erred, right ones and wrong ones.

#include <mc/check/random_subjects.h>

namespace checker_bench {

struct RegressionSubject {
  Subject subject;
  bool right;
};

/// Tables of any texture with and without their breaks, narrow lobes, heavy tails, singularities, jumps along curves;
/// and faults that are finer than any cell, thinner than any layer, or rarer than any share of the samples.
std::vector<RegressionSubject> regression_subjects();

} // namespace checker_bench

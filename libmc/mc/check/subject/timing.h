#pragma once
/// What one sample costs.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace mc {

/// Time of one sample(input) -> number [ns]: the best of eight rounds over the inputs, so that a busy machine does not
/// show.
template <class Input, class Sample> double ns_per_sample(const std::vector<Input>& inputs, Sample sample) {
  double best = HUGE_VAL, sum = 0;
  for (int round = 0; round < 8; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (const Input& input : inputs) sum += sample(input);
    const std::chrono::duration<double, std::nano> passed = std::chrono::steady_clock::now() - start;
    best = std::min(best, passed.count() / static_cast<double>(inputs.size()));
  }
  volatile double keep = sum;
  (void)keep;
  return best;
}

/// Inputs enough to time, few enough to stay in the first cache.
constexpr int timing_inputs = 1 << 12;

} // namespace mc

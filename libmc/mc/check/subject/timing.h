#pragma once
/// Time of one sample.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace mc {

/// Returns the time of one sample(input) [ns]: the minimum over eight rounds through all inputs, which excludes
/// interruptions by other processes. Every sample is stored whole, so that the compiler leaves out no part of it.
template <class Input, class Sample> double ns_per_sample(const std::vector<Input>& inputs, Sample sample) {
  double best = HUGE_VAL;
  for (int round = 0; round < 8; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (const Input& input : inputs) {
      const auto result = sample(input);
      asm volatile("" : : "r"(&result) : "memory");
    }
    const std::chrono::duration<double, std::nano> passed = std::chrono::steady_clock::now() - start;
    best = std::min(best, passed.count() / static_cast<double>(inputs.size()));
  }
  return best;
}

/// Number of inputs: enough for the clock, few enough for the first-level cache.
constexpr int timing_inputs = 1 << 12;

} // namespace mc

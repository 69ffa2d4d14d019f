#pragma once
/// Sorting of many numbers.

#include <vector>

namespace mc {

/// Sorts numbers in ascending order; none may be NaN. Takes linear time if they spread evenly over their range. Each
/// level of clustering below 2^-24 of the range costs one more pass.
void sort_numbers(std::vector<double>& values);

} // namespace mc

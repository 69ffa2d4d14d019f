#pragma once
/// Sorting many numbers.

#include <vector>

namespace mc {

/// Sorts numbers that are not NaN, ascending: in linear time where they spread evenly over their range, in n log n
/// where they crowd.
void sort_numbers(std::vector<double>& values);

} // namespace mc

#pragma once
/// Sorting many numbers.

#include <vector>

namespace mc {

/// Sorts numbers that are not NaN, ascending: in linear time where they spread evenly over their range, and once more
/// for each 24 bits below it at which many crowd.
void sort_numbers(std::vector<double>& values);

} // namespace mc

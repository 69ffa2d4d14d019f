#pragma once
/// Reads point sets of the user.

#include <input/csv.h>

namespace carlo {

/// The points of a file, one in each row.
///   throws : Error for a file that read_csv refuses, for fewer points than `least` or more than `most`, for more
///            columns than `most_columns`, or "file:line: ..." for a coordinate outside of [0, 1).
CsvTable read_points(const std::string& file, std::size_t least, std::size_t most, std::size_t most_columns);

} // namespace carlo

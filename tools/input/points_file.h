#pragma once
/// Point sets of the user.

#include <input/csv.h>

namespace carlo {

/// The points of a file, a row each.
///   throws : Error for a file that read_csv refuses, fewer points than `least` or more than `most`, more columns than
///            `most_columns`, or "file:line: ..." for a coordinate outside of [0, 1)
CsvTable read_points(const std::string& file, std::size_t least, std::size_t most, std::size_t most_columns);

} // namespace carlo

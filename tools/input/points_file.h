#pragma once
/// Reads point sets of the user.

#include <input/csv.h>

#include <cstddef>
#include <string>

namespace carlo {

/// Limits for a file of points, and the range of its coordinates.
struct PointsFileOptions {
  std::size_t least, most, most_columns;
  /// "LO:HI": every coordinate lies in [LO, HI] and is mapped to [0, 1). "auto": each column has the range of its
  /// values. Empty: coordinates lie in [0, 1).
  std::string rescale = {};
};

/// Help for an option with this range.
inline constexpr const char* rescale_help =
    "Range of the coordinates of the file, both ends included, as in 0:1 or -1:1; auto takes the least and the largest "
    "value of each column. Default: [0, 1).";

/// Points, one in each row, and a line about how they were rescaled; empty if they were not.
struct PointsFile {
  CsvTable table;
  std::string note;
};

/// Reads the points. A coordinate at the upper end of its range becomes 1 - 2^-53.
///   throws : Error for a file that read_csv refuses, for fewer points than `least` or more than `most`, for more
///            columns than `most_columns`, or "file:line: ..." for a coordinate outside of its range. Error that names
///            --rescale for a bad range, or a column of equal values with "auto".
PointsFile read_points(const std::string& file, const PointsFileOptions& options);

} // namespace carlo

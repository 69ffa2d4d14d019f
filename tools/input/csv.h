#pragma once
/// Tables of numbers as text.

#include <cstdint>
#include <string>
#include <vector>

namespace carlo {

/// Rows of finite numbers, all of the same length.
struct CsvTable {
  std::size_t columns = 0;
  std::vector<double> values;       ///< row by row
  std::vector<std::int16_t> digits; ///< for each value: the exponent of 10 of its last digit, including zeros that were
                                    ///< omitted at the end
  /// The same exponent for numbers slightly closer to 0. It is smaller by one if the value is a power of 10 and the
  /// column has a fixed number of significant digits.
  std::vector<std::int16_t> digits_below;
  std::vector<std::uint32_t> lines; ///< for each row: its line in the file, from 1

  std::size_t rows() const { return lines.size(); }
  /// Keeps the rows 0, step, 2 step, ...
  void keep_every(std::size_t step);
  const double* row(std::size_t i) const { return values.data() + i * columns; }
};

/// Reads numbers separated by commas, semicolons or blanks, with or without quotation marks. It skips empty lines,
/// comments from # to the end of the line, and a comma at the end of a row. It skips a first line of column names: its
/// first field begins with a letter or _ and is no number.
///   throws : Error "file:line: ..." for anything but a finite number, a decimal comma, commas mixed with semicolons,
///            an empty field, an unclosed quotation mark, or a row of another length. Error "file: ..." for a file that
///            is missing, is not text, or contains no numbers.
CsvTable read_csv(const std::string& file);

} // namespace carlo

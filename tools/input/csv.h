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
  std::vector<std::int16_t> digits; ///< of each value: its last digit, with zeros left out, stands for 10^this
  /// The same a little nearer to 0: one less below a power of 10 where it is significant digits that are printed.
  std::vector<std::int16_t> digits_below;
  std::vector<std::uint32_t> lines; ///< of the file, from 1, that each row stands in

  std::size_t rows() const { return lines.size(); }
  const double* row(std::size_t i) const { return values.data() + i * columns; }
};

/// Numbers separated by commas or semicolons, or by blanks, in quotation marks or not. Left out are empty lines, what
/// follows a # to the end of the line, a comma at the end of a row, and a first line whose first field, in quotation
/// marks or not, begins with a letter or _ and is no number: the names of the columns.
///   throws : Error "file:line: ..." for what is no finite number, a decimal comma, commas beside semicolons, an empty
///            field, a quotation mark without its other or a row of another length; "file: ..." for a file that is
///            missing, is no text or holds no numbers
CsvTable read_csv(const std::string& file);

} // namespace carlo

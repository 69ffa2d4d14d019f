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
  std::vector<std::uint32_t> lines; ///< of the file, from 1, that each row stands in

  std::size_t rows() const { return lines.size(); }
  const double* row(std::size_t i) const { return values.data() + i * columns; }
};

/// Numbers separated by commas, semicolons or blanks; empty lines and lines that begin with # are left out, and so is a
/// first line that begins with a letter or a quotation mark: the names of the columns.
///   throws : Error "file:line: ..." for what is no finite number, an empty field or a row of another length; "file:
///            ..." for a file that is missing or holds no numbers
CsvTable read_csv(const std::string& file);

} // namespace carlo

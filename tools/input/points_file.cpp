#include <input/points_file.h>

#include <mc/core/error.h>

namespace carlo {

CsvTable read_points(const std::string& file, std::size_t least, std::size_t most, std::size_t most_columns) {
  CsvTable table = read_csv(file);
  mc::require(table.columns <= most_columns, "{}: {} columns; at most {} dimensions are supported", file, table.columns,
              most_columns);
  mc::require(table.rows() >= least && table.rows() <= most, "{}: {} points; {} to {} are needed", file, table.rows(),
              least, most);
  for (std::size_t i = 0; i < table.values.size(); ++i)
    mc::require(table.values[i] >= 0 && table.values[i] < 1, "{}:{}: coordinate {} is {}; it must lie in [0, 1)", file,
                table.lines[i / table.columns], i % table.columns + 1, table.values[i]);
  return table;
}

} // namespace carlo

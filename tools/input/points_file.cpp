#include <input/points_file.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace carlo {

namespace {

struct Range {
  double lo, hi;
};

Range parse_range(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::optional<double> lo = colon == text.npos ? std::nullopt : mc::parse_double(text.substr(0, colon)),
                              hi = colon == text.npos ? std::nullopt : mc::parse_double(text.substr(colon + 1));
  mc::require(lo && hi && std::isfinite(*hi - *lo) && *lo < *hi,
              "--rescale '{}' must be LO:HI with numbers LO < HI, as in 0:1, or auto", text);
  return {*lo, *hi};
}

std::vector<Range> ranges_of(const std::string& file, const CsvTable& table, const std::string& rescale) {
  if (rescale != "auto") return std::vector<Range>(table.columns, parse_range(rescale));
  std::vector<Range> ranges(table.columns, {HUGE_VAL, -HUGE_VAL});
  for (std::size_t i = 0; i < table.values.size(); ++i) {
    Range& r = ranges[i % table.columns];
    r.lo = std::min(r.lo, table.values[i]);
    r.hi = std::max(r.hi, table.values[i]);
  }
  for (std::size_t k = 0; k < ranges.size(); ++k)
    mc::require(ranges[k].lo < ranges[k].hi && std::isfinite(ranges[k].hi - ranges[k].lo),
                "{}: --rescale auto: column {} has the range {} to {}; give LO:HI", file, k + 1, ranges[k].lo,
                ranges[k].hi);
  return ranges;
}

// Returns the note.
std::string rescale_points(const std::string& file, CsvTable& table, const std::string& rescale) {
  const std::vector<Range> ranges = ranges_of(file, table, rescale);
  std::size_t ends = 0;
  for (std::size_t i = 0; i < table.values.size(); ++i) {
    const Range& r = ranges[i % table.columns];
    double& x = table.values[i];
    mc::require(x >= r.lo && x <= r.hi, "{}:{}: coordinate {} is {}; it must lie in [{}, {}] of --rescale", file,
                table.lines[i / table.columns], i % table.columns + 1, x, r.lo, r.hi);
    const double u = (x - r.lo) / (r.hi - r.lo);
    ends += u >= 1;
    x = std::min(u, 1 - 0x1p-53);
  }
  const std::string from =
      rescale == "auto" ? "the range of each column" : fmt::format("[{}, {}]", ranges[0].lo, ranges[0].hi);
  return fmt::format("{}: {} rescaled to [0, 1); {} coordinate{} at the upper end became 1 - 2^-53", file, from, ends,
                     ends == 1 ? "" : "s");
}

} // namespace

PointsFile read_points(const std::string& file, const PointsFileOptions& o) {
  CsvTable table = read_csv(file);
  mc::require(table.columns <= o.most_columns, "{}: {} columns; at most {} dimensions are supported", file,
              table.columns, o.most_columns);
  mc::require(table.rows() >= o.least && table.rows() <= o.most, "{}: {} points; {} to {} are needed", file,
              table.rows(), o.least, o.most);
  if (!o.rescale.empty()) {
    const std::string note = rescale_points(file, table, o.rescale);
    return {std::move(table), note};
  }
  const auto is_inside = [](double x) { return x >= 0 && x < 1; };
  const auto bad = std::find_if_not(table.values.begin(), table.values.end(), is_inside);
  if (bad == table.values.end()) return {std::move(table), {}};
  const auto at = static_cast<std::size_t>(bad - table.values.begin());
  const auto [least, most] = std::minmax_element(table.values.begin(), table.values.end());
  const std::string range = *least >= 0 && *most <= 1 ? "0:1" : fmt::format("{}:{}", *least, *most);
  throw mc::Error(fmt::format("{}:{}: coordinate {} is {}; it must lie in [0, 1); for points in another range give "
                              "--rescale, as in --rescale={}",
                              file, table.lines[at / table.columns], at % table.columns + 1, *bad, range));
}

} // namespace carlo

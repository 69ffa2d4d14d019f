#include <integrands/expression_integral.h>
#include <integrate/sweep.h>
#include <report/plot.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace carlo {

namespace {

constexpr std::size_t most_points = 500;

// The values of LO:HI:STEP.
std::vector<double> values_of(const std::string& text, const std::string& range) {
  std::vector<double> parts;
  for (const std::string_view part : mc::split(range, ':')) {
    parts.push_back(mc::with_context(fmt::format("--set '{}'", text), [&] { return parse_number(std::string(part)); }));
    mc::require(std::isfinite(parts.back()), "--set '{}': {} must be finite", text, part);
  }
  mc::require(parts.size() == 3, "--set '{}' must be NAME=VALUE or NAME=LO:HI:STEP, e.g. a=1:3:0.5", text);
  const double lo = parts[0], hi = parts[1], step = parts[2];
  const double steps = std::floor((hi - lo) / step + 1e-9); // HI belongs to the range although STEP is rounded
  mc::require(step != 0 && steps >= 0, "--set '{}': the step {} does not lead from {} to {}", text, step, lo, hi);
  mc::require(steps < most_points, "--set '{}': {:.0f} values; at most {} are possible", text, steps + 1, most_points);
  std::vector<double> values(static_cast<std::size_t>(steps) + 1);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = lo + static_cast<double>(k) * step;
  return values;
}

// One value at one point of the sweep.
struct Row {
  const SweptValues* swept;
  double value, std_error;
  mc::Estimate::Interval interval;
  mc::ErrorBar error_bar;
  std::optional<double> correlation; // with the row before
};

// An integral or a derived value at all points.
struct Series {
  std::string title;
  std::vector<Row> rows;
};

std::vector<Series> series_of(const IntegrateResults& found) {
  const std::size_t integrals = found.integrands_per_point(), derived = found.derived.size() / found.points.size();
  std::vector<Series> all;
  for (std::size_t i = 0; i < integrals; ++i) {
    Series s{found.integrands[i].title, {}};
    for (std::size_t p = 0; p < found.points.size(); ++p) {
      const std::size_t k = p * integrals + i;
      const mc::Integral& r = found.results.outputs[k];
      s.rows.push_back(
          {&found.points[p], r.estimate.value, r.estimate.std_error, r.interval, r.error_bar, std::nullopt});
      if (p > 0) s.rows.back().correlation = found.results.correlation(k - integrals, k);
    }
    all.push_back(std::move(s));
  }
  for (std::size_t i = 0; i < derived; ++i) {
    Series s{found.derived[i].expression, {}};
    for (std::size_t p = 0; p < found.points.size(); ++p) {
      const DerivedValue& d = found.derived[p * derived + i];
      s.rows.push_back({&found.points[p], d.value, d.std_error, d.interval, d.error_bar, std::nullopt});
    }
    all.push_back(std::move(s));
  }
  return all;
}

std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, "\"");
  return '"' + text + '"';
}

} // namespace

std::vector<SweepPoint> sweep_points(const std::vector<std::string>& settings) {
  std::vector<SweepPoint> points(1);
  for (const std::string& text : settings) {
    const auto definition = split_definition("--set", text);
    const bool is_range = definition.second.find(':') != std::string::npos;
    const std::vector<double> values = is_range ? values_of(text, definition.second) : std::vector<double>{0};
    const std::size_t count = values.size() * points.size();
    mc::require(count <= most_points, "--set: {} combinations of values; at most {} are possible", count, most_points);
    std::vector<SweepPoint> more;
    for (const SweepPoint& point : points)
      for (const double value : values) {
        more.push_back(point);
        more.back().settings.push_back(is_range ? fmt::format("{}={}", definition.first, value) : text);
        if (is_range) more.back().swept.emplace_back(definition.first, value);
      }
    points = std::move(more);
  }
  return points;
}

std::string sweep_table(const IntegrateResults& found) {
  std::string text;
  for (const Series& series : series_of(found)) {
    text += series.title + "\n";
    for (const auto& swept : found.points.front()) text += fmt::format("{:>10}  ", swept.first);
    text += fmt::format("{:<14}   {:<8}  {:<32}  {}\n", "value", "error", "95 % interval",
                        "correlation with the row above");
    for (const Row& row : series.rows) {
      for (const auto& swept : *row.swept) text += fmt::format("{:>10.6g}  ", swept.second);
      const std::string interval = fmt::format("[{:.8g}, {:.8g}]", row.interval.lo, row.interval.hi);
      text += std::isfinite(row.std_error)
                  ? fmt::format("{:<14.8g} ± {:<8.2g}  {:<32}", row.value, row.std_error, interval)
                  : fmt::format("{:<14.8g} ± {:<8}  {:<32}", row.value, "?", name(row.error_bar));
      text += row.correlation ? fmt::format("  {:.3f}\n", *row.correlation) : "\n";
    }
  }
  return text +
         "All rows use the same points. Their errors are correlated: differences are more accurate than values.\n";
}

std::string sweep_csv(const IntegrateResults& found) {
  std::string text;
  for (const auto& swept : found.points.front()) text += swept.first + ",";
  text += "series,title,value,std_error,lo,hi,error_bar,correlation_with_row_before\n";
  std::size_t number = 0;
  for (const Series& series : series_of(found)) {
    ++number;
    for (const Row& row : series.rows) {
      for (const auto& swept : *row.swept) text += fmt::format("{},", swept.second);
      const auto known = [&](double x) { return std::isfinite(x) ? fmt::format("{:.17g}", x) : std::string(); };
      text += fmt::format("{},{},{:.17g},{},{},{},{},{}\n", number, quoted(series.title), row.value,
                          known(row.std_error), known(row.interval.lo), known(row.interval.hi), name(row.error_bar),
                          row.correlation ? known(*row.correlation) : "");
    }
  }
  return text;
}

std::string sweep_script(const IntegrateResults& found) {
  const std::vector<Series> all = series_of(found);
  const SweptValues& names = found.points.front();
  std::string text = plot_header("sweep", 900, 640);
  text += fmt::format("set datafile missing NaN\nset xlabel \"{}\" noenhanced\n"
                      "set ylabel \"integral, 95 % intervals\"\nset key outside right Left reverse samplen 2\nplot",
                      names.front().first);
  const std::size_t column = names.size() + 1; // of the series
  std::vector<std::string> curves;
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const SweptValues& point : found.points) {
      std::string condition = fmt::format("${} == {}", column, k + 1), title = all[k].title;
      for (std::size_t i = 1; i < point.size(); ++i) {
        condition += fmt::format(" && strcol({}) eq \"{}\"", i + 1, point[i].second);
        title += fmt::format(", {} = {:.6g}", point[i].first, point[i].second);
      }
      std::replace(title.begin(), title.end(), '"', '\'');
      std::replace(title.begin(), title.end(), '\\', '/');
      std::string curve =
          fmt::format(" \"sweep.csv\" skip 1 using ({} ? $1 : NaN):{}:{}:{} with yerrorlines pt 7 ps 0.5 lw 1.5 title "
                      "\"{}\" noenhanced",
                      condition, column + 2, column + 4, column + 5, title);
      if (std::find(curves.begin(), curves.end(), curve) == curves.end()) curves.push_back(std::move(curve));
    }
  return text + fmt::format("{}\n", fmt::join(curves, ", \\\n    "));
}

} // namespace carlo

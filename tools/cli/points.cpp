#include <input/points_file.h>
#include <options/subcommand.h>
#include <quality/output.h>
#include <report/plot.h>
#include <report/projections.h>
#include <report/report_json.h>
#include <sampling/point_sets.h>
#include <terminal/columns.h>
#include <terminal/interrupt.h>
#include <terminal/message.h>
#include <terminal/progress.h>
#include <terminal/result_writer.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/random/hash.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace carlo {
namespace {

using nlohmann::json;

struct PointsCommandOptions {
  std::string set;
  std::string file;  ///< a user's own points instead
  std::string scale; ///< the range of their coordinates; empty: [0, 1)
  bool list = false;
  std::uint64_t count = 1024;
  int dim = 2;
  int randomisations = 16;
  std::uint64_t seed = 1;
  int threads = 0;
  std::string output = "out/points";
  std::string command;
};

constexpr std::uint64_t most_points = 32768; // the work grows as their square
constexpr int most_dimensions = 16;
constexpr int axes_drawn = 8; // by projections_svg: more would be too small to read

PointSets randomised(const PointSet& set, std::uint64_t n, const PointsCommandOptions& o) {
  return {static_cast<std::size_t>(o.randomisations), static_cast<std::size_t>(o.dim), [&set, &o, n](std::size_t r) {
            return set.make(static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(o.dim),
                            r == 0 ? o.seed : mc::hash(o.seed, static_cast<std::uint64_t>(r)));
          }};
}

void line(const char* name, const std::string& one, const std::string& all, const std::string& random,
          const std::string& jittered) {
  fmt::print("{:<24} {:>14} {:>12} {:>14} {:>14}\n", name, one, all, random, jittered);
}

std::string number(double x) { return fmt::format("{:.6g}", x); }

std::string bounds(const mc::StarDiscrepancy& s) {
  return s.exact() ? number(s.lower) : fmt::format("{:.3g}-{:.3g}", s.lower, s.upper);
}

void print(const QualityRow& r, int dim, std::size_t sets) {
  line("", "this set", fmt::format("mean of {}", sets), "random", "jittered");
  const auto l2 = [&](const char* name, double mc::L2Discrepancies::*value) {
    line(name, number(r.first_l2.*value), number(r.l2.*value), number(r.random.l2.*value),
         number(r.jittered.l2.*value));
  };
  l2("L2-star discrepancy", &mc::L2Discrepancies::star);
  l2("periodic L2 discrepancy", &mc::L2Discrepancies::periodic);
  l2("centered discrepancy", &mc::L2Discrepancies::centered);
  l2("wrap-around discrepancy", &mc::L2Discrepancies::wraparound);
  l2("mixture discrepancy", &mc::L2Discrepancies::mixture);
  const bool exact = r.star.exact() && r.random.star.exact() && r.jittered.star.exact();
  line(exact ? "star discrepancy" : "star discrepancy, bounds", bounds(r.star), "", bounds(r.random.star),
       bounds(r.jittered.star));
  line("smallest distance", number(r.first_distance.plain), "", "", "");
  line("  periodic", number(r.first_distance.periodic), number(r.distance), number(r.random.distance),
       number(r.jittered.distance));
  const auto mean_t = [](const std::optional<double>& t) { return t ? fmt::format("{:.2f}", *t) : std::string(); };
  line("t of the net", r.t ? fmt::format("{}", *r.t) : "-", "", mean_t(r.random.t), mean_t(r.jittered.t));
  if (dim >= 2)
    line("power up to sqrt(N) / 2", "", number(low_frequency_power(r.power, r.n)),
         number(low_frequency_power(r.random.power, r.n)), number(low_frequency_power(r.jittered.power, r.n)));
  if (r.t) fmt::print("a ({}, {}, {})-net in base 2\n", *r.t, std::countr_zero(r.n), dim);
  else fmt::print("no t: {}\n", std::has_single_bit(r.n) ? "too many boxes" : "the number of points is no power of 2");
  fmt::print("{}",
             wrapped(fmt::format("Means of L2 discrepancies are root mean squares. For random and jittered points the "
                                 "star discrepancy is the mean of {} sets, the distance and t of {}, as are centered, "
                                 "wrap-around and mixture discrepancy of jittered points; the other values are "
                                 "expectations by formula.",
                                 reference_stars, reference_sets),
                     80));
}

std::string points_csv(mc::PointList p) {
  std::string text;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t k = 0; k < p.dim; ++k) text += fmt::format("{}{}", p[i][k], k + 1 < p.dim ? "," : "\n");
  return text;
}

// Work limits for the star discrepancy. It is exact where that takes some seconds at most. Otherwise bounds are
// computed with less work, and with a tenth of it for the many reference sets.
StarDiscrepancyBudget star_discrepancy_budget(std::uint64_t n, std::size_t dim, bool last) {
  constexpr std::uint64_t thorough = 2'000'000'000, quick = 300'000'000, little = 100'000'000;
  if (mc::exact_star_steps(n, dim) < 0.6 * static_cast<double>(quick)) return {last ? thorough : quick, quick};
  return {last ? thorough : little, little / 10};
}

// The rows of the curves by increasing number of points, and the first point set of the last row.
struct QualityRun {
  std::vector<QualityRow> rows;
  std::vector<double> first;
  std::size_t sets = 1; // number of randomisations
  bool interrupted = false;
};

QualityRun measure_all(const PointsCommandOptions& o, int& dim) {
  QualityRun m;
  if (!o.file.empty()) {
    const PointsFile read = read_points(o.file, {2, most_points, most_dimensions, o.scale});
    const CsvTable& table = read.table;
    if (!read.note.empty()) fmt::print("{}\n", read.note);
    dim = static_cast<int>(table.columns);
    m.first = table.values;
    const StarDiscrepancyBudget work = star_discrepancy_budget(table.rows(), table.columns, true);
    m.rows = {measure_quality({1, table.columns, [&](std::size_t) { return m.first; }}, o.threads, work)};
    return m;
  }
  const PointSet& set = point_set(o.set);
  std::vector<std::uint64_t> counts;
  for (std::uint64_t n = 16; n < o.count; n *= 2) counts.push_back(n);
  counts.push_back(o.count);
  const Interrupt interrupt;
  ProgressLine progress;
  for (const std::uint64_t n : counts) {
    if (*interrupt.flag()) {
      m.interrupted = true;
      break;
    }
    progress.show(static_cast<double>(n * n) / static_cast<double>(4 * o.count * o.count), fmt::format("N = {}", n));
    const PointSets sets = randomised(set, n, o);
    m.sets = sets.count;
    m.first = sets.make(0);
    const StarDiscrepancyBudget work = star_discrepancy_budget(n, static_cast<std::size_t>(dim), n == o.count);
    m.rows.push_back(measure_quality(sets, o.threads, work));
  }
  return m;
}

void write(const PointsCommandOptions& o, const std::filesystem::path& folder, const QualityRun& m, int dim) {
  ResultWriter results;
  const mc::PointList first{m.first, static_cast<std::size_t>(dim)};
  const std::string title = fmt::format("{}, {} dimensions", o.file.empty() ? o.set : std::string("points"), dim);
  const auto file = [&](const char* name) { return (folder / name).string(); };
  results.write(file("points.csv"), false, points_csv(first));
  results.write(file("quality.csv"), false, quality_csv(m.rows));
  results.write(file("spectrum.csv"), false, spectrum_csv(m.rows));
  if (dim >= 2) results.write(file("points.svg"), false, projections_svg(first));
  else remove_plot(folder, "points");
  json all = {{"command", o.command},
              {"commit", commit},
              {"seed", o.seed},
              {"set", o.set},
              {"dimension", dim},
              {"randomisations", m.sets},
              {"reference_sets", reference_sets},
              {"rows", json::array()}};
  for (const QualityRow& r : m.rows) all["rows"].push_back(to_json(r));
  if (m.interrupted) all["interrupted"] = true;
  results.write(file("quality.json"), false, json_text(all));
  results.write(file("quality.gp"), false, quality_script(title, m.rows));
  results.attempt([&] {
    if (!draw_plot(folder, "quality", {"quality.csv", "spectrum.csv"}))
      warn("gnuplot is not installed; data and scripts are written, but no plots");
  });
  results.finish();
}

std::vector<Option> rows(PointsCommandOptions& o) {
  const Exclusion own{"--points-file", "the file determines its points"};
  return in_groups({
      {common_options,
       {
           {"SET", "", &o.set, "Point set by name, see --list."},
           {"-n,--count", "N", &o.count, "Number of points, 2 to 32768. The curves lead from 16 to N.", false, {own}},
           {"-d,--dim", "N", &o.dim, "Dimensions, 1 to 16.", false, {own}},
           input_file({"--points-file", "FILE", &o.file,
                       "Measure the points of this file instead: one point a row, coordinates in [0, 1)."}),
           {"--rescale", "LO:HI", &o.scale, rescale_help},
           output_folder({"-o,--output", "FOLDER", &o.output,
                          "Folder for points.csv, points.svg (all pairs of the first 8 axes), quality.csv, .json, .svg "
                          "and .png, and "
                          "spectrum.csv."},
                         {"points.csv", "points.svg", "quality.csv", "quality.json", "quality.gp", "quality.svg",
                          "quality.png", "spectrum.csv"}),
           {"--list", "", &o.list, "List the point sets, and stop."},
       }},
      {expert_options,
       {
           {"--randomisations",
            "N",
            &o.randomisations,
            "Independent randomisations behind each mean, 1 to 1000.",
            false,
            {own}},
           {"--seed", "N", &o.seed, "Seed of the random numbers. The same seed gives the same points.", false, {own}},
           {"--threads", "N", &o.threads, "Threads; 0 is all processors."},
       }},
  });
}

int run_points(const PointsCommandOptions& o) {
  if (o.list) {
    for (const PointSet& s : point_sets()) fmt::print("{:<18} {}\n", s.name, s.title);
    return exit_ok;
  }
  mc::require(o.set.empty() != o.file.empty(), "points: give a point set (see --list) or --points-file");
  mc::require(o.scale.empty() || !o.file.empty(), "points: --rescale is for a --points-file");
  mc::require(o.count >= 2 && o.count <= most_points, "points: -n {} must lie in [2, {}]", o.count, most_points);
  mc::require(o.dim >= 1 && o.dim <= most_dimensions, "points: -d {} must lie in [1, {}]", o.dim, most_dimensions);
  mc::require(o.randomisations >= 1 && o.randomisations <= 1000, "points: --randomisations {} must lie in [1, 1000]",
              o.randomisations);
  if (o.file.empty()) point_set(o.set);
  const std::filesystem::path folder = mc::make_output_folder(o.output, "points.csv");
  int dim = o.dim;
  const QualityRun m = measure_all(o, dim);
  if (m.rows.empty()) return exit_interrupted;
  fmt::print("{}: {} points in {} dimension{}\n", o.file.empty() ? o.set : o.file, m.rows.back().n, dim,
             dim == 1 ? "" : "s");
  print(m.rows.back(), dim, m.sets);
  if (dim > axes_drawn)
    fmt::print("points.svg shows the first {} of {} axes, {} of {} pairs\n", axes_drawn, dim,
               axes_drawn * (axes_drawn - 1) / 2, dim * (dim - 1) / 2);
  const std::filesystem::path written = result_folder(folder, "quality.json", m.interrupted);
  write(o, written, m, dim);
  fmt::print("{}data and pictures: {}\n", m.interrupted ? "interrupted; " : "", written.string());
  return m.interrupted ? exit_interrupted : exit_ok;
}

} // namespace

Subcommand points_subcommand() {
  return make_subcommand<PointsCommandOptions>(
      {.name = "points",
       .summary = "Measure how evenly a point set fills the unit cube: pictures, discrepancies, distances, spectrum",
       .examples = {{"carlo points sobol -n 1024 -d 2", "measures 1024 points of the Sobol' sequence in the plane"},
                    {"carlo points --list", "names the point sets"},
                    {"carlo points --points-file mine.csv -o out", "measures the points of a file"}},
       .sections =
           {{"Measures",
             {{"discrepancy", "Largest (star) or root-mean-square (L2) difference between the share of points in "
                              "a box and its volume. Smaller is more even."},
              {"centered, ...", "Centered, wrap-around and mixture discrepancy: also the uniformity of projections. "
                                "SciPy prints their squares."},
              {"t of the net", "Least t for which the points are a (t, m, d)-net in base 2. Smaller is more even."},
              {"power", "Mean power of the spectrum at frequencies up to sqrt(N) / 2; 1 for independent points. "
                        "Smaller means smaller errors of smooth integrands."}}}}},
      rows, run_points);
}

} // namespace carlo

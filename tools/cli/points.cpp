#include <input/points_file.h>
#include <options/subcommand.h>
#include <report/plot.h>
#include <report/projections.h>
#include <report/report_json.h>
#include <sampling/point_sets.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/parallel.h>
#include <mc/points/discrepancy.h>
#include <mc/points/net.h>
#include <mc/points/spectrum.h>
#include <mc/points/star_discrepancy.h>
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

struct PointsOptions {
  std::string set;
  std::string file; ///< a user's own points instead
  bool list = false;
  std::uint64_t count = 1024;
  int dim = 2;
  int randomisations = 16;
  std::uint64_t seed = 1;
  int threads = 0;
  std::string output = "out/points";
  std::string command;
};

constexpr std::uint64_t most_points = 32768; // pairs of points are looked at
constexpr int most_dimensions = 16;
constexpr int axes_drawn = 8; // by projections_svg: more would be too small to look at

// What is told of one set.
struct Quality {
  double l2_star, l2_periodic;
  mc::SmallestDistance distance;
};

Quality quality_of(mc::PointList points) {
  return {mc::l2_star_discrepancy(points), mc::periodic_l2_discrepancy(points), mc::smallest_distance(points)};
}

// One number of points: the first set in full, and the root mean squares of all randomisations.
struct Row {
  std::uint64_t n = 0;
  Quality first{};
  mc::StarDiscrepancy star;
  double l2_star = 0, l2_periodic = 0; ///< root mean squares
  double distance = 0;                 ///< mean, periodic
};

using Sets = std::vector<std::vector<double>>;

Row measure(const Sets& sets, std::size_t dim, int threads, std::uint64_t star_work) {
  std::vector<Quality> all(sets.size());
  mc::parallel_for(sets.size(), threads, [&](std::size_t r) { all[r] = quality_of({sets[r], dim}); });
  Row row;
  row.n = sets[0].size() / dim;
  row.first = all[0];
  row.star = mc::star_discrepancy({sets[0], dim}, star_work);
  const double count = static_cast<double>(sets.size());
  for (const Quality& q : all) {
    row.l2_star += q.l2_star * q.l2_star / count;
    row.l2_periodic += q.l2_periodic * q.l2_periodic / count;
    row.distance += q.distance.periodic / count;
  }
  row.l2_star = std::sqrt(row.l2_star);
  row.l2_periodic = std::sqrt(row.l2_periodic);
  return row;
}

Sets randomised(const PointSet& set, std::uint64_t n, const PointsOptions& o) {
  Sets sets;
  for (int r = 0; r < o.randomisations; ++r)
    sets.push_back(set.make(static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(o.dim),
                            r == 0 ? o.seed : mc::hash(o.seed, static_cast<std::uint64_t>(r))));
  return sets;
}

double root(double x) { return std::sqrt(x); }

std::string csv(const std::vector<Row>& rows, int dim) {
  std::string text = "n,l2_star,l2_star_random,l2_star_jittered,l2_periodic,l2_periodic_random,l2_periodic_jittered,"
                     "star_lower,star_upper,distance_periodic\n";
  for (const Row& r : rows) {
    const double n = static_cast<double>(r.n), random = root(mc::random_mean_square(n, dim));
    text += fmt::format("{},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}\n", r.n, r.l2_star,
                        random, root(mc::jittered_star_mean_square(n, dim)), r.l2_periodic, random,
                        root(mc::jittered_periodic_mean_square(n, dim)), r.star.lower, r.star.upper, r.distance);
  }
  return text;
}

// Four panels over N, and one over the frequency where there is a spectrum. Without a distance above 0 that of the
// distance has no logarithmic axis, on which gnuplot would find nothing to draw.
std::string script(const std::string& title, bool any_distance, bool spectrum) {
  std::string s = plot_head("quality", 1100, 800);
  s += fmt::format("set multiplot layout 2,3 title \"{}\" font \",15\"\nset key left bottom Left reverse samplen 2\n"
                   "set logscale xy\nset format y \"10^{{%L}}\"\nset xlabel \"points N\"\n",
                   title);
  const auto panel = [&](const char* label, int column) {
    s += fmt::format("set ylabel \"{}\"\nplot \"quality.csv\" skip 1 using 1:{} with linespoints pt 7 ps 0.5 lc rgb "
                     "\"#4477aa\" title \"this set\", \"\" skip 1 using 1:{} with lines dt 2 lc rgb \"#ee6677\" title "
                     "\"random\", \"\" skip 1 using 1:{} with lines dt 3 lc rgb \"#228833\" title \"jittered\"\n",
                     label, column, column + 1, column + 2);
  };
  panel("L2-star discrepancy, RMS", 2);
  panel("periodic L2 discrepancy, RMS", 5);
  s += "set ylabel \"star discrepancy, bounds\"\nplot \"quality.csv\" skip 1 using 1:8 with linespoints pt 7 ps 0.5 lc "
       "rgb \"#4477aa\" title \"lower\", \"\" skip 1 using 1:9 with lines lc rgb \"#4477aa\" title \"upper\"\n";
  if (!any_distance) s += "unset logscale y\nset format y \"%g\"\nset yrange [0:1]\n";
  s += "set ylabel \"smallest distance, periodic, mean\"\nplot \"quality.csv\" skip 1 using 1:10 with linespoints pt 7 "
       "ps 0.5 lc rgb \"#4477aa\" title \"this set\"\n";
  if (spectrum)
    s += "unset logscale\nset format y \"%g\"\nset yrange [0:2]\nset xlabel \"frequency\"\nset ylabel \"power, x and "
         "y\"\nplot \"spectrum.csv\" skip 1 using 1:2 with lines lw 1.5 lc rgb \"#4477aa\" title \"this set\", \"\" "
         "skip 1 using 1:3 with lines dt 3 lc rgb \"#228833\" title \"jittered\", 1 dt 2 lc rgb \"#ee6677\" title "
         "\"random\"\n";
  return s + "unset multiplot\n";
}

std::vector<double> mean_spectrum(const Sets& sets, std::size_t dim, int rings, int threads) {
  std::vector<std::vector<double>> all(sets.size());
  mc::parallel_for(sets.size(), threads, [&](std::size_t r) {
    all[r] = mc::radial_power_spectrum({sets[r], dim}, rings);
  });
  std::vector<double> mean(static_cast<std::size_t>(rings), 0.0);
  for (const auto& one : all)
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += one[k] / static_cast<double>(sets.size());
  return mean;
}

void print(const Row& r, std::optional<int> t, int dim, std::size_t sets) {
  const double n = static_cast<double>(r.n), random = root(mc::random_mean_square(n, dim));
  fmt::print("{:<24} {:>12} {:>12} {:>12} {:>12}\n", "", "this set", fmt::format("RMS of {}", sets), "random",
             "jittered");
  const auto line = [](const char* name, double one, double rms, double chance, double jittered) {
    fmt::print("{:<24} {:>12.6g} {:>12.6g} {:>12.6g} {:>12.6g}\n", name, one, rms, chance, jittered);
  };
  line("L2-star discrepancy", r.first.l2_star, r.l2_star, random, root(mc::jittered_star_mean_square(n, dim)));
  line("periodic L2 discrepancy", r.first.l2_periodic, r.l2_periodic, random,
       root(mc::jittered_periodic_mean_square(n, dim)));
  if (r.star.exact()) fmt::print("{:<24} {:>12.6g}\n", "star discrepancy", r.star.lower);
  else fmt::print("{:<24} {:>12} between {:.6g} and {:.6g}\n", "star discrepancy", "", r.star.lower, r.star.upper);
  fmt::print("{:<24} {:>12.6g} plain, {:.6g} periodic\n", "smallest distance", r.first.distance.plain,
             r.first.distance.periodic);
  if (t)
    fmt::print("{:<24} {:>12} ({}, {}, {})-net in base 2\n", "t of the net", *t, *t,
               std::countr_zero(static_cast<std::uint64_t>(r.n)), dim);
  else
    fmt::print("{:<24} {:>12} {}\n", "t of the net", "-",
               std::has_single_bit(r.n) ? "too many boxes to look at" : "the number of points is no power of 2");
}

json to_json(const Row& r) {
  return {{"n", r.n},
          {"l2_star", r.first.l2_star},
          {"l2_star_rms", r.l2_star},
          {"l2_periodic", r.first.l2_periodic},
          {"l2_periodic_rms", r.l2_periodic},
          {"star_lower", r.star.lower},
          {"star_upper", r.star.upper},
          {"distance", r.first.distance.plain},
          {"distance_periodic", r.first.distance.periodic}};
}

std::string points_csv(mc::PointList p) {
  std::string text;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t k = 0; k < p.dim; ++k) text += fmt::format("{}{}", p[i][k], k + 1 < p.dim ? "," : "\n");
  return text;
}

// The rows of the curves, fewest points first, and the sets of the last.
struct MeasuredSets {
  std::vector<Row> rows;
  Sets sets;
  bool interrupted = false;
};

MeasuredSets measure_all(const PointsOptions& o, int& dim) {
  constexpr std::uint64_t quick = 100'000'000, thorough = 1'000'000'000;
  MeasuredSets m;
  if (!o.file.empty()) {
    const CsvTable table = read_points(o.file, 2, most_points, most_dimensions);
    dim = static_cast<int>(table.columns);
    m.sets = {table.values};
    m.rows = {measure(m.sets, static_cast<std::size_t>(dim), o.threads, thorough)};
    return m;
  }
  const PointSet& set = point_set(o.set);
  std::vector<std::uint64_t> counts;
  for (std::uint64_t n = 16; n < o.count; n *= 2) counts.push_back(n);
  counts.push_back(o.count);
  const Interrupt interrupt;
  Progress progress;
  for (const std::uint64_t n : counts) {
    if (*interrupt.flag()) {
      m.interrupted = true;
      break;
    }
    progress.show(static_cast<double>(n * n) / static_cast<double>(4 * o.count * o.count), fmt::format("N = {}", n));
    m.sets = randomised(set, n, o);
    m.rows.push_back(measure(m.sets, static_cast<std::size_t>(dim), o.threads, n == o.count ? thorough : quick));
  }
  return m;
}

void write(const PointsOptions& o, const std::filesystem::path& folder, const MeasuredSets& m, int dim,
           std::optional<int> t) {
  const mc::PointList first{m.sets[0], static_cast<std::size_t>(dim)};
  const std::string title = fmt::format("{}, {} dimensions", o.file.empty() ? o.set : std::string("points"), dim);
  const auto file = [&](const char* name) { return (folder / name).string(); };
  mc::write_file(file("points.csv"), points_csv(first));
  mc::write_file(file("quality.csv"), csv(m.rows, dim));
  if (dim >= 2) mc::write_file(file("points.svg"), projections_svg(first));
  json all = {{"command", o.command},
              {"commit", commit},
              {"seed", o.seed},
              {"set", o.set},
              {"dimension", dim},
              {"randomisations", m.sets.size()},
              {"t", t ? json(*t) : json()},
              {"rows", json::array()}};
  for (const Row& r : m.rows) all["rows"].push_back(to_json(r));
  if (dim >= 2) {
    const double n = static_cast<double>(first.size());
    const int rings = std::clamp(static_cast<int>(std::lround(2 * std::sqrt(n))), 4, 128);
    const std::vector<double> power = mean_spectrum(m.sets, first.dim, rings, o.threads),
                              jittered = mc::jittered_radial_spectrum(std::sqrt(n), rings);
    std::string text = "frequency,power,jittered\n";
    for (std::size_t k = 0; k < power.size(); ++k)
      text += fmt::format("{},{:.9g},{:.9g}\n", k + 1, power[k], jittered[k]);
    mc::write_file(file("spectrum.csv"), text);
    all["spectrum"] = power;
  }
  if (m.interrupted) all["interrupted"] = true;
  mc::write_file(file("quality.json"), json_text(all));
  const bool any_distance = std::any_of(m.rows.begin(), m.rows.end(), [](const Row& r) { return r.distance > 0; });
  mc::write_file(file("quality.gp"), script(title, any_distance, dim >= 2));
  if (!draw_plot(folder, "quality", {"quality.csv", "spectrum.csv"}))
    std::fprintf(stderr, "carlo: warning: gnuplot is not installed; data and scripts are written, but no plots\n");
}

std::vector<Option> rows(PointsOptions& o) {
  return {
      {"SET", "", &o.set, "Point set by name, see --list"},
      {"--points-file", "FILE", &o.file, "Look at these points instead: a row each, coordinates in [0, 1)"},
      {"--list", "", &o.list, "List the point sets, and stop"},
      {"-n,--count", "N", &o.count, "Points; the curves lead from 16 to here"},
      {"-d,--dim", "N", &o.dim, "Dimensions, 1 to 16"},
      {"--randomisations", "N", &o.randomisations, "Independent ones behind each root mean square"},
      {"--seed", "N", &o.seed, "Seed"},
      {"--threads", "N", &o.threads, "Threads, 0 for all of the machine's"},
      {"-o,--output", "FOLDER", &o.output,
       "Folder for points.csv, points.svg (all pairs of the first 8 axes), quality.csv, .json, .svg, .png and "
       "spectrum.csv"},
  };
}

int points(const PointsOptions& o) {
  if (o.list) {
    for (const PointSet& s : point_sets()) fmt::print("{:<18} {}\n", s.name, s.title);
    return exit_ok;
  }
  mc::require(o.set.empty() != o.file.empty(), "points: give a point set (see --list) or --points-file");
  mc::require(o.count >= 2 && o.count <= most_points, "points: -n {} must lie in [2, {}]", o.count, most_points);
  mc::require(o.dim >= 1 && o.dim <= most_dimensions, "points: -d {} must lie in [1, {}]", o.dim, most_dimensions);
  mc::require(o.randomisations >= 1 && o.randomisations <= 1000, "points: --randomisations {} must lie in [1, 1000]",
              o.randomisations);
  if (o.file.empty()) point_set(o.set);
  const std::filesystem::path folder = mc::output_folder(o.output, "points.csv");
  int dim = o.dim;
  const MeasuredSets m = measure_all(o, dim);
  if (m.rows.empty()) return exit_interrupted;
  const std::optional<int> t = mc::net_quality({m.sets[0], static_cast<std::size_t>(dim)});
  fmt::print("{}: {} points in {} dimension{}\n", o.file.empty() ? o.set : o.file, m.rows.back().n, dim,
             dim == 1 ? "" : "s");
  print(m.rows.back(), t, dim, m.sets.size());
  if (dim > axes_drawn)
    fmt::print("points.svg shows the first {} of {} axes, {} of {} pairs\n", axes_drawn, dim,
               axes_drawn * (axes_drawn - 1) / 2, dim * (dim - 1) / 2);
  write(o, folder, m, dim, t);
  fmt::print("{}data and pictures: {}\n", m.interrupted ? "interrupted; " : "", folder.string());
  return m.interrupted ? exit_interrupted : exit_ok;
}

} // namespace

Subcommand points_subcommand() {
  return make_subcommand<PointsOptions>(
      "points", "Look at a point set: pictures, discrepancies, distances, t of a net, spectrum", rows, points);
}

} // namespace carlo

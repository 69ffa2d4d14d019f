#include <quality/output.h>
#include <report/plot.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

using nlohmann::json;

template <class T> std::string field(const std::optional<T>& value) {
  return value ? fmt::format("{:.12g}", static_cast<double>(*value)) : std::string();
}

// A column of quality.csv.
struct Column {
  const char* name;
  std::optional<double> (*value)(const QualityRow& row);
};

std::optional<double> optional(const std::optional<int>& t) { return t ? std::optional<double>(*t) : std::nullopt; }

std::optional<double> low(const std::vector<double>& power, std::uint64_t n) {
  return power.empty() ? std::nullopt : std::optional<double>(low_frequency_power(power, n));
}

using Value = std::optional<double>;

const Column columns[] = {
    {"n", [](const QualityRow& r) -> Value { return static_cast<double>(r.n); }},
    {"l2_star", [](const QualityRow& r) -> Value { return r.l2.star; }},
    {"l2_star_random", [](const QualityRow& r) -> Value { return r.random.l2.star; }},
    {"l2_star_jittered", [](const QualityRow& r) -> Value { return r.jittered.l2.star; }},
    {"l2_periodic", [](const QualityRow& r) -> Value { return r.l2.periodic; }},
    {"l2_periodic_random", [](const QualityRow& r) -> Value { return r.random.l2.periodic; }},
    {"l2_periodic_jittered", [](const QualityRow& r) -> Value { return r.jittered.l2.periodic; }},
    {"centered", [](const QualityRow& r) -> Value { return r.l2.centered; }},
    {"centered_random", [](const QualityRow& r) -> Value { return r.random.l2.centered; }},
    {"centered_jittered", [](const QualityRow& r) -> Value { return r.jittered.l2.centered; }},
    {"wraparound", [](const QualityRow& r) -> Value { return r.l2.wraparound; }},
    {"wraparound_random", [](const QualityRow& r) -> Value { return r.random.l2.wraparound; }},
    {"wraparound_jittered", [](const QualityRow& r) -> Value { return r.jittered.l2.wraparound; }},
    {"mixture", [](const QualityRow& r) -> Value { return r.l2.mixture; }},
    {"mixture_random", [](const QualityRow& r) -> Value { return r.random.l2.mixture; }},
    {"mixture_jittered", [](const QualityRow& r) -> Value { return r.jittered.l2.mixture; }},
    {"star_lower", [](const QualityRow& r) -> Value { return r.star.lower; }},
    {"star_upper", [](const QualityRow& r) -> Value { return r.star.upper; }},
    {"star_random_lower", [](const QualityRow& r) -> Value { return r.random.star.lower; }},
    {"star_random_upper", [](const QualityRow& r) -> Value { return r.random.star.upper; }},
    {"star_jittered_lower", [](const QualityRow& r) -> Value { return r.jittered.star.lower; }},
    {"star_jittered_upper", [](const QualityRow& r) -> Value { return r.jittered.star.upper; }},
    {"distance_periodic", [](const QualityRow& r) -> Value { return r.distance; }},
    {"distance_random", [](const QualityRow& r) -> Value { return r.random.distance; }},
    {"distance_jittered", [](const QualityRow& r) -> Value { return r.jittered.distance; }},
    {"t", [](const QualityRow& r) -> Value { return optional(r.t); }},
    {"t_random", [](const QualityRow& r) -> Value { return r.random.t; }},
    {"t_jittered", [](const QualityRow& r) -> Value { return r.jittered.t; }},
    {"power_low", [](const QualityRow& r) -> Value { return low(r.power, r.n); }},
    {"power_low_random", [](const QualityRow& r) -> Value { return low(r.random.power, r.n); }},
    {"power_low_jittered", [](const QualityRow& r) -> Value { return low(r.jittered.power, r.n); }},
};

// A curve of a panel: the column by its name, and the look of the line. A curve without a title shares the legend entry
// of the curve with the same look.
struct PlotCurve {
  const char *column, *look, *title;
};

constexpr const char *this_look = "linespoints pt 7 ps 0.5 lc rgb \"#4477aa\"",
                     *upper_look = "lines lc rgb \"#4477aa\"", *random_look = "lines lw 1.5 dt 2 lc rgb \"#ee6677\"",
                     *jittered_look = "lines lw 2 dt 3 lc rgb \"#228833\"";

std::string panel(const std::string& label, const std::vector<PlotCurve>& curves) {
  std::string s = fmt::format("set ylabel \"{}\"\nplot ", label);
  for (std::size_t i = 0; i < curves.size(); ++i)
    s += fmt::format("{}\"quality.csv\" using \"n\":\"{}\" with {} title \"{}\"", i == 0 ? "" : ", ", curves[i].column,
                     curves[i].look, curves[i].title);
  return s + "\n";
}

std::vector<PlotCurve> three(const char* set, const char* random, const char* jittered) {
  return {{set, this_look, "this set"}, {random, random_look, "random"}, {jittered, jittered_look, "jittered"}};
}

// If the discrepancy is not exact at every N, each set has two curves, and the legend names them bounds.
std::string star_panel(const std::vector<QualityRow>& rows) {
  struct Set {
    mc::StarDiscrepancy (*star)(const QualityRow& row);
    PlotCurve lower, upper;
    const char* title_of_bounds;
  };
  static constexpr Set sets[] = {{[](const QualityRow& r) { return r.star; },
                                  {"star_lower", this_look, "this set"},
                                  {"star_upper", upper_look, ""},
                                  "this set, bounds"},
                                 {[](const QualityRow& r) { return r.random.star; },
                                  {"star_random_lower", random_look, "random"},
                                  {"star_random_upper", random_look, ""},
                                  "random, bounds"},
                                 {[](const QualityRow& r) { return r.jittered.star; },
                                  {"star_jittered_lower", jittered_look, "jittered"},
                                  {"star_jittered_upper", jittered_look, ""},
                                  "jittered, bounds"}};
  std::vector<PlotCurve> curves;
  for (const Set& s : sets) {
    curves.push_back(s.lower);
    if (std::all_of(rows.begin(), rows.end(), [&](const QualityRow& r) { return s.star(r).exact(); })) continue;
    curves.back().title = s.title_of_bounds;
    curves.push_back(s.upper);
  }
  return panel(curves.size() == 3 ? "star discrepancy" : "star discrepancy, lower and upper bounds", curves);
}

// Power over frequency in units of sqrt(N). Each N has a curve, which is darker for more points.
std::string spectra(const std::vector<QualityRow>& rows) {
  std::string s = "set xlabel \"frequency / sqrt(N)\"\nset ylabel \"power, x and y, darker with N\"\nplot ";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double n = static_cast<double>(rows[i].n);
    const int grey =
        static_cast<int>(std::lround(200 * (1 - static_cast<double>(i + 1) / static_cast<double>(rows.size()))));
    s += fmt::format(
        "\"spectrum.csv\" using ($1=={0} ? $2/{1:.9g} : NaN):3 with lines lw {2} lc rgb \"#{3:02x}{4:02x}{5:02x}\" "
        "title \"{6}\", ",
        rows[i].n, std::sqrt(n), i + 1 == rows.size() ? 2 : 1, 0x44 + grey * 0x8b / 200, 0x77 + grey * 0x68 / 200,
        0xaa + grey * 0x45 / 200, i + 1 == rows.size() ? "this set" : "");
  }
  const QualityRow& last = rows.back();
  s += fmt::format("\"spectrum.csv\" using ($1=={0} ? $2/{1:.9g} : NaN):4 with {2} title \"random\", "
                   "\"spectrum.csv\" using ($1=={0} ? $2/{1:.9g} : NaN):5 with {3} title \"jittered\"\n",
                   last.n, std::sqrt(static_cast<double>(last.n)), random_look, jittered_look);
  return s;
}

// The fields l2_star, l2_periodic, centered, wraparound and mixture with a suffix.
void add(json& j, const mc::L2Discrepancies& l2, const std::string& suffix) {
  j["l2_star" + suffix] = l2.star;
  j["l2_periodic" + suffix] = l2.periodic;
  j["centered" + suffix] = l2.centered;
  j["wraparound" + suffix] = l2.wraparound;
  j["mixture" + suffix] = l2.mixture;
}

json to_json(const QualityReference& r) {
  json j = {{"star_lower", r.star.lower},
            {"star_upper", r.star.upper},
            {"distance_periodic", r.distance},
            {"t", r.t ? json(*r.t) : json()}};
  add(j, r.l2, "_rms");
  return j;
}

} // namespace

std::string quality_csv(const std::vector<QualityRow>& rows) {
  std::string text;
  for (const Column& c : columns) text += fmt::format("{}{}", &c == columns ? "" : ",", c.name);
  for (const QualityRow& r : rows) {
    text += '\n';
    for (const Column& c : columns) text += fmt::format("{}{}", &c == columns ? "" : ",", field(c.value(r)));
  }
  return text + '\n';
}

std::string spectrum_csv(const std::vector<QualityRow>& rows) {
  std::string text = "n,frequency,power,random,jittered\n";
  for (const QualityRow& r : rows)
    for (std::size_t k = 0; k < r.power.size(); ++k)
      text +=
          fmt::format("{},{},{:.9g},{:.9g},{:.9g}\n", r.n, k + 1, r.power[k], r.random.power[k], r.jittered.power[k]);
  return text;
}

// If no distance exceeds 0, the distance panel has a linear axis: gnuplot cannot draw it on a logarithmic one.
std::string quality_script(const std::string& title, const std::vector<QualityRow>& rows) {
  std::string s = plot_header("quality", 1500, 800);
  s += fmt::format(
      "set multiplot layout 2,4 title \"{}; random and jittered: star is the mean of {} sets, distance and t of {}, "
      "the others by formula\" font \",15\"\nset key left bottom Left reverse samplen 2\nset logscale xy\n"
      "set format y \"10^{{%L}}\"\nset xlabel \"points N\"\n",
      title, reference_stars, reference_sets);
  s += panel("L2-star discrepancy, RMS", three("l2_star", "l2_star_random", "l2_star_jittered"));
  s += panel("periodic L2 discrepancy, RMS", three("l2_periodic", "l2_periodic_random", "l2_periodic_jittered"));
  s += star_panel(rows);
  if (std::none_of(rows.begin(), rows.end(), [](const QualityRow& r) { return r.distance > 0; }))
    s += "unset logscale y\nset format y \"%g\"\nset yrange [0:1]\n";
  s += panel("smallest distance, periodic, mean", three("distance_periodic", "distance_random", "distance_jittered"));
  s += "unset logscale y\nset format y \"%g\"\nset yrange [-0.5:*]\nset key left top\n";
  if (std::any_of(rows.begin(), rows.end(), [](const QualityRow& r) { return r.t.has_value(); }))
    s += panel("t of the (t,m,s)-net in base 2", three("t", "t_random", "t_jittered"));
  if (!rows[0].power.empty()) {
    s += "set yrange [0:1.5]\n" +
         panel("mean power up to sqrt(N) / 2", three("power_low", "power_low_random", "power_low_jittered"));
    s += "unset logscale\nset yrange [0:2]\n" + spectra(rows);
  }
  return s + "unset multiplot\n";
}

json to_json(const QualityRow& r) {
  json j = {{"n", r.n},
            {"star_lower", r.star.lower},
            {"star_upper", r.star.upper},
            {"distance", r.first_distance.plain},
            {"distance_periodic", r.first_distance.periodic},
            {"t", r.t ? json(*r.t) : json()},
            {"power", r.power},
            {"random", to_json(r.random)},
            {"jittered", to_json(r.jittered)}};
  add(j, r.first_l2, "");
  add(j, r.l2, "_rms");
  return j;
}

} // namespace carlo

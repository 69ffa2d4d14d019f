#include <converge/output.h>
#include <report/plot.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace carlo {

using nlohmann::ordered_json;

std::string color(std::size_t i) {
  static constexpr std::array colors = {"#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb",
                                        "#332288", "#ddaa33", "#44aa99", "#882255", "#117733", "#cc6677", "#88ccee"};
  return colors[i % colors.size()];
}

std::string slope_text(const Curve& c) {
  if (c.exact) return "exact to rounding";
  if (c.errors.back().is_bound && !c.law) return "not distinguishable from the error of the reference";
  if (!c.law) return "too few N for a slope";
  std::string text = fmt::format("slope {:+.3f} [{:+.3f}, {:+.3f}]", c.law->slope, c.law->lo, c.law->hi);
  if (!c.theory) return text;
  text += ", theory " + c.theory->to_string(3);
  if (c.theory->log_power > 0) text += fmt::format(" ({:+.3f} at these N)", -c.theory->local(c.middle));
  return c.agrees() ? text : text + ", not in the interval";
}

std::string about_variance(const Measurement& m) {
  if (!m.heavy_tail) return {};
  return fmt::format("the variance of the integrand looks infinite (the largest values fall off with index {:.2f}; a "
                     "finite variance needs more than 2, a finite integral more than 1): RMS errors and slopes may be chance",
                     *m.heavy_tail);
}

std::string summary(const Target& target, const Measurement& m) {
  const Experiment& e = target.integral;
  std::string text = e.title == e.name ? e.name + "\n" : fmt::format("{}: {}\n", e.name, e.title);
  std::size_t width = 11;
  for (const Curve& c : m.curves) width = std::max(width, c.way->name.size());
  for (const Curve& c : m.curves)
    text += fmt::format("  {:<{}} RMS error {}{:.3g} at N = {:.0f}, {}{}\n", c.way->name, width,
                        c.errors.back().is_bound ? "at most " : "", c.errors.back().rms, c.errors.back().n,
                        slope_text(c), c.cut ? "; interrupted" : "");
  if (m.truth_error > 0)
    text += fmt::format("  true value unknown; errors are relative to {:.12g} +- {:.2g}{}\n", m.truth, m.truth_error,
                        m.interrupted ? "" : ", estimated from separate replicates");
  for (const std::string& warning : {m.doubt, about_variance(m)})
    if (!warning.empty()) text += fmt::format("  warning: {}\n", warning);
  return text;
}

std::string interrupted_text(std::size_t done, std::size_t wanted, std::string_view what, const Measurement& last) {
  std::string text = fmt::format("interrupted: {} of {} {} were finished", done, wanted, what);
  if (last.curves.empty() || !last.curves.back().cut) return text;
  return text + fmt::format(", one more up to N = {:.0f}", last.curves.back().errors.back().n);
}

std::size_t finished(const Measurement& m) {
  return m.curves.size() - (!m.curves.empty() && m.curves.back().cut ? 1 : 0);
}

namespace {

std::string field(const std::string& text) { return text.find(',') == std::string::npos ? text : "\"" + text + "\""; }

// From theory to source, empty where nothing is known.
std::string theory_fields(const Curve& c) {
  if (!c.theory) return ",,,";
  std::string text = c.theory->to_string(4) + ",";
  if (c.law) text += fmt::format("{:.4f},{},", -c.theory->local(c.middle), c.agrees() ? "yes" : "no");
  else text += ",,";
  return text + field(std::string(c.theory->source));
}

} // namespace

std::string slopes_header() {
  return "experiment,class,dimension,sampler,fitted_around_n,slope,slope_lo,slope_hi,theory,theory_at_these_n,"
         "within_interval,source\n";
}

std::string slopes_csv(const Target& target, const Measurement& m) {
  const Experiment& e = target.integral;
  std::string text;
  for (const Curve& c : m.curves) {
    text += fmt::format("{},{},{},{},", field(e.name), name(e.smoothness.of), e.dim, field(c.way->name));
    text += c.law ? fmt::format("{:.0f},{:.4f},{:.4f},{:.4f},", c.middle, c.law->slope, c.law->lo, c.law->hi) : ",,,,";
    text += theory_fields(c) + "\n";
  }
  return text;
}

std::string to_csv(const Target& target, const Measurement& m) {
  std::string text = fmt::format("experiment,sampler,n,rms_error,rms_lo,rms_hi,{}\n", m.cost.column);
  const std::string name = field(target.integral.name);
  for (const Curve& c : m.curves)
    for (const mc::RmsError& p : c.errors)
      text += fmt::format("{},{},{:.0f},{},{:.9g},{:.9g},{:.6g}\n", name, field(c.way->name), p.n,
                          p.is_bound ? "" : fmt::format("{:.9g}", p.rms), p.lo, p.hi, p.seconds);
  return text;
}

namespace {

ordered_json to_json(const Curve& c, const Cost& cost) {
  ordered_json points = ordered_json::array();
  for (std::size_t i = 0; i < c.errors.size(); ++i) {
    const mc::RmsError& p = c.errors[i];
    points.push_back({{"n", p.n},
                      {"rms_error", p.is_bound ? ordered_json() : ordered_json(p.rms)},
                      {"rms_lo", p.lo},
                      {"rms_hi", p.hi},
                      {std::string(cost.column), p.seconds},
                      {"replicates", c.replicates[i].values.size()}});
  }
  ordered_json k = {{"sampler", c.way->name}, {"exact", c.exact}, {"points", points}};
  if (c.cut) k["interrupted"] = true;
  if (c.law)
    k["slope"] = {{"value", c.law->slope}, {"lo", c.law->lo}, {"hi", c.law->hi}, {"constant", c.law->constant}};
  if (c.theory)
    k["theory"] = {{"slope", -c.theory->exponent},
                   {"log_power", c.theory->log_power},
                   {"at_most", c.theory->bound == Bound::at_most},
                   {"at_least", c.theory->bound == Bound::at_least},
                   {"source", c.theory->source}};
  if (c.theory && c.law) {
    k["theory"]["slope_at_these_n"] = -c.theory->local(c.middle);
    k["theory"]["within_interval"] = c.agrees();
  }
  return k;
}

} // namespace

ordered_json to_json(const Target& target, const Measurement& m, const ordered_json& about) {
  const Experiment& e = target.integral;
  ordered_json j = about;
  j["experiment"] = e.name;
  j["title"] = e.title;
  j["source"] = e.source;
  j["dimension"] = e.dim;
  j["class"] = name(e.smoothness.of);
  j["truth"] = m.truth;
  j["truth_error"] = m.truth_error;
  j["fit_from"] = e.fit_from;
  if (!m.doubt.empty()) j["warning"] = m.doubt;
  if (m.heavy_tail) j["infinite_variance"] = {{"tail_index", *m.heavy_tail}};
  if (m.interrupted) j["interrupted"] = true;
  j["curves"] = ordered_json::array();
  for (const Curve& c : m.curves) j["curves"].push_back(to_json(c, m.cost));
  return j;
}

namespace {

// A text between gnuplot's double quotes.
std::string gnuplot_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '"' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe;
}

std::string curve_lines(const Measurement& m, const std::string& name, const char* column, bool with_slopes) {
  std::string plot = "plot ";
  for (std::size_t i = 0; i < m.curves.size(); ++i) {
    const Curve& c = m.curves[i];
    if (!c.is_drawn()) continue;
    const std::string pick = fmt::format("(strcol(2) eq \"{}\" ? ${} : NaN)", gnuplot_text(c.way->name), column);
    std::string label = with_slopes && c.law ? fmt::format("{}: N^{{{:.2f} ± {:.2f}}}", c.way->name, c.law->slope,
                                                           (c.law->hi - c.law->lo) / 2)
                                             : c.way->name;
    std::replace(label.begin(), label.end(), '_', ' '); // which gnuplot would take for a subscript
    plot += fmt::format("\"{0}.csv\" skip 1 using {1}:5:6 with filledcurves fs solid 0.18 noborder lc rgb \"{2}\" "
                        "notitle, \\\n     \"{0}.csv\" skip 1 using {1}:4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "
                        "\"{2}\" title \"{3}\", \\\n     ",
                        name, pick, color(i), gnuplot_text(label));
    if (with_slopes && c.theory && !c.errors.back().is_bound)
      plot += fmt::format("{0:.6g} * x**({1:.6g}) with lines dt 3 lw 1 lc rgb \"{2}\" notitle, \\\n     ",
                          c.errors.back().rms * std::pow(c.errors.back().n, c.theory->exponent), -c.theory->exponent,
                          color(i));
  }
  return plot + "NaN notitle\n";
}

} // namespace

std::string to_script(const Target& target, const Measurement& m, const std::string& name) {
  const bool many = m.curves.size() > 5; // then the key would hide them
  std::string s = plot_head(name, 1000, many ? 860 : 440);
  s += fmt::format("set multiplot layout 1,2 title \"{}\" noenhanced font \",15\"\nset logscale xy\nset format y "
                   "\"10^{{%L}}\"\nset key {} Left reverse samplen 2 spacing 1.2 tc rgb \"#333333\"\nset "
                   "ylabel \"root-mean-square error\"\n",
                   gnuplot_text(target.integral.title), many ? "below" : "left bottom");
  s += "set xlabel \"samples N\"\nset format x \"10^{%L}\"\n" + curve_lines(m, name, "3", true);
  s += fmt::format("set xlabel \"{}\"\nset format x \"10^{{%L}}\"\n", m.cost.axis) + curve_lines(m, name, "7", false);
  return s + "unset multiplot\n";
}

} // namespace carlo

#include <converge/curve_style.h>
#include <converge/output.h>
#include <converge/trade.h>
#include <report/plot.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace carlo {

using nlohmann::ordered_json;

std::string slope_text(const ConvergenceCurve& c) {
  if (c.exact) return "exact to rounding";
  if (c.errors.back().is_bound && !c.power_law) return "not distinguishable from the error of the reference";
  if (!c.power_law) return "too few N for a slope";
  std::string text =
      fmt::format("slope {:+.3f} [{:+.3f}, {:+.3f}]", c.power_law->slope, c.power_law->lo, c.power_law->hi);
  if (!c.theory) return text;
  text += ", theory " + c.theory->to_string(3);
  if (c.theory->log_power > 0) text += fmt::format(" ({:+.3f} at these N)", -c.theory->local_exponent(c.fit_center));
  return c.agrees_with_theory() ? text : text + ", not in the interval";
}

std::string variance_warning(const Measurement& m) {
  if (!m.heavy_tail) return {};
  return fmt::format(
      "the variance of the integrand looks infinite (the largest values fall off with index {:.2f}; a "
      "finite variance needs more than 2, a finite integral more than 1): RMS errors and slopes may be chance",
      *m.heavy_tail);
}

std::string failure_lines(const Measurement& m) {
  std::string text;
  for (const FailedMethod& f : m.failures) text += fmt::format("  {} failed: {}\n", method_label(*f.method), f.reason);
  return text;
}

std::string summary(const IntegralTarget& target, const Measurement& m) {
  const UnitCubeIntegral& e = target.integral;
  std::string text = e.title == e.name ? e.name + "\n" : fmt::format("{}: {}\n", e.name, e.title);
  std::size_t width = 11;
  for (const ConvergenceCurve& c : m.curves) width = std::max(width, c.method->name.size());
  for (const ConvergenceCurve& c : m.curves)
    text += fmt::format("  {:<{}} RMS error {}{:.3g} at N = {:.0f}, {}{}\n", c.method->name, width,
                        c.errors.back().is_bound ? "at most " : "", c.errors.back().rms, c.errors.back().n,
                        slope_text(c), c.interrupted ? "; interrupted" : "");
  text += failure_lines(m);
  if (m.truth_error > 0)
    text += fmt::format("  true value unknown; errors are relative to {:.12g} +- {:.2g}{}\n", m.truth, m.truth_error,
                        m.interrupted ? "" : ", estimated from separate replicates");
  for (const std::string& warning : {m.truth_warning, variance_warning(m)})
    if (!warning.empty()) text += fmt::format("  warning: {}\n", warning);
  return text;
}

std::string interrupted_text(std::size_t done, std::size_t wanted, std::string_view what, const Measurement& last) {
  std::string text = fmt::format("interrupted: {} of {} {} were finished", done, wanted, what);
  if (last.curves.empty() || !last.curves.back().interrupted) return text;
  return text + fmt::format(", one more up to N = {:.0f}", last.curves.back().errors.back().n);
}

std::size_t count_finished(const Measurement& m) {
  return m.curves.size() - (!m.curves.empty() && m.curves.back().interrupted ? 1 : 0);
}

namespace {

std::string field(const std::string& text) { return text.find(',') == std::string::npos ? text : "\"" + text + "\""; }

// The columns from theory to source; empty if no rate is known.
std::string theory_fields(const ConvergenceCurve& c) {
  if (!c.theory) return ",,,";
  std::string text = c.theory->to_string(4) + ",";
  if (c.power_law)
    text += fmt::format("{:.4f},{},", -c.theory->local_exponent(c.fit_center), c.agrees_with_theory() ? "yes" : "no");
  else text += ",,";
  return text + field(std::string(c.theory->source));
}

} // namespace

std::string slopes_header() {
  return "experiment,class,dimension,sampler,fitted_around_n,slope,slope_lo,slope_hi,theory,theory_at_these_n,"
         "within_interval,source\n";
}

std::string slopes_csv(const IntegralTarget& target, const Measurement& m) {
  const UnitCubeIntegral& e = target.integral;
  std::string text;
  for (const ConvergenceCurve& c : m.curves) {
    text += fmt::format("{},{},{},{},", field(e.name), name(e.smoothness.kind), e.dim, field(c.method->name));
    text += c.power_law ? fmt::format("{:.0f},{:.4f},{:.4f},{:.4f},", c.fit_center, c.power_law->slope, c.power_law->lo,
                                      c.power_law->hi)
                        : ",,,,";
    text += theory_fields(c) + "\n";
  }
  return text;
}

std::string to_csv(const IntegralTarget& target, const Measurement& m) {
  std::string text = fmt::format("experiment,sampler,n,rms_error,rms_lo,rms_hi,{}\n", m.cost.column);
  const std::string name = field(target.integral.name);
  for (const ConvergenceCurve& c : m.curves)
    for (const mc::RmsError& p : c.errors)
      text += fmt::format("{},{},{:.0f},{},{:.9g},{:.9g},{:.6g}\n", name, field(c.method->name), p.n,
                          p.is_bound ? "" : fmt::format("{:.9g}", p.rms), p.lo, p.hi, p.seconds);
  return text;
}

namespace {

ordered_json to_json(const ConvergenceCurve& c, const CostUnit& cost) {
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
  ordered_json k = {{"sampler", c.method->name}, {"exact", c.exact}, {"points", points}};
  if (c.interrupted) k["interrupted"] = true;
  if (c.power_law)
    k["slope"] = {{"value", c.power_law->slope},
                  {"lo", c.power_law->lo},
                  {"hi", c.power_law->hi},
                  {"constant", c.power_law->constant}};
  if (c.theory)
    k["theory"] = {{"slope", -c.theory->exponent},
                   {"log_power", c.theory->log_power},
                   {"at_most", c.theory->bound == RateBound::at_most},
                   {"at_least", c.theory->bound == RateBound::at_least},
                   {"source", c.theory->source}};
  if (c.theory && c.power_law) {
    k["theory"]["slope_at_these_n"] = -c.theory->local_exponent(c.fit_center);
    k["theory"]["within_interval"] = c.agrees_with_theory();
  }
  return k;
}

} // namespace

ordered_json to_json(const IntegralTarget& target, const Measurement& m, const ordered_json& about) {
  const UnitCubeIntegral& e = target.integral;
  ordered_json j = about;
  j["experiment"] = e.name;
  j["title"] = e.title;
  j["source"] = e.source;
  j["dimension"] = e.dim;
  j["class"] = name(e.smoothness.kind);
  j["truth"] = m.truth;
  j["truth_error"] = m.truth_error;
  j["fit_from"] = e.min_fit_n;
  if (!m.truth_warning.empty()) j["warning"] = m.truth_warning;
  if (m.heavy_tail) j["infinite_variance"] = {{"tail_index", *m.heavy_tail}};
  if (m.interrupted) j["interrupted"] = true;
  for (const FailedMethod& f : m.failures)
    j["failed"].push_back({{"way", method_label(*f.method)}, {"reason", f.reason}});
  j["curves"] = ordered_json::array();
  for (const ConvergenceCurve& c : m.curves) j["curves"].push_back(to_json(c, m.cost));
  return j;
}

namespace {

// A text, escaped for gnuplot's double quotes.
std::string gnuplot_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '"' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe;
}

// What the key says of a curve; nothing for a grey one.
std::string key_of(const ConvergenceCurve& c, const CurveStyle& style, bool with_slopes) {
  if (!style.color) return "notitle";
  std::string text = with_slopes && c.power_law
                         ? fmt::format("{}: N^{{{:.2f} ± {:.2f}}}", c.method->name, c.power_law->slope,
                                       (c.power_law->hi - c.power_law->lo) / 2)
                         : c.method->name;
  std::replace(text.begin(), text.end(), '_', ' '); // which gnuplot would take for a subscript
  return fmt::format("title \"{}\"", gnuplot_text(text));
}

std::string curve_lines(const Measurement& m, const std::string& name, const char* column, bool with_slopes) {
  const std::vector<CurveStyle> styles = curve_styles(m, nullptr);
  const std::vector<std::size_t> order = drawing_order(styles);
  std::string plot = "plot ";
  for (const std::size_t i : order) {
    const ConvergenceCurve& c = m.curves[i];
    if (!c.has_measurable_error()) continue;
    const std::string pick = fmt::format("(strcol(2) eq \"{}\" ? ${} : NaN)", gnuplot_text(c.method->name), column);
    const std::string color = color_on_white(styles[i]);
    if (styles[i].color)
      plot += fmt::format("\"{}.csv\" skip 1 using {}:5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "
                          "\"{}\" notitle, \\\n     ",
                          name, pick, color);
    plot += fmt::format("\"{}.csv\" skip 1 using {}:4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb \"{}\" {}, \\\n     ",
                        name, pick, color, key_of(c, styles[i], with_slopes));
    if (with_slopes && c.theory && styles[i].color && !c.errors.back().is_bound)
      plot += fmt::format("{0:.6g} * x**({1:.6g}) with lines dt 3 lw 1 lc rgb \"{2}\" notitle, \\\n     ",
                          c.errors.back().rms * std::pow(c.errors.back().n, c.theory->exponent), -c.theory->exponent,
                          color);
  }
  const bool has_grey = !order.empty() && !styles[order.front()].color;
  return plot + (has_grey ? fmt::format("NaN with lines lw 1.5 lc rgb \"{}\" title \"other methods\"\n",
                                        color_on_white(styles[order.front()]))
                          : "NaN notitle\n");
}

} // namespace

std::string to_script(const IntegralTarget& target, const Measurement& m, const std::string& name) {
  const bool many = m.curves.size() > 5; // a key inside the plot would cover the curves
  std::string s = plot_header(name, 1000, many ? 860 : 440);
  s += fmt::format("set multiplot layout 1,2 title \"{}\" noenhanced font \",15\"\nset logscale xy\nset format y "
                   "\"10^{{%L}}\"\nset key {} Left reverse samplen 2 spacing 1.2 tc rgb \"#333333\"\nset "
                   "ylabel \"root-mean-square error\"\n",
                   gnuplot_text(target.integral.title), many ? "below" : "left bottom");
  s += "set xlabel \"samples N\"\nset format x \"10^{%L}\"\n" + curve_lines(m, name, "3", true);
  s += fmt::format("set xlabel \"{}\"\nset format x \"10^{{%L}}\"\n", m.cost.axis) + curve_lines(m, name, "7", false);
  return s + "unset multiplot\n";
}

} // namespace carlo

#include <converge/output.h>
#include <converge/page.h>
#include <report/html.h>
#include <validate_page_parts.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

constexpr double width = 560, height = 380, left = 58, right = 12, top = 12, bottom = 44;

// log10 of a range, to whole decades.
struct Decades {
  double lo = HUGE_VAL, hi = -HUGE_VAL;

  void hold(double x) {
    if (!(x > 0)) return;
    lo = std::min(lo, std::floor(std::log10(x) + 1e-9));
    hi = std::max(hi, std::ceil(std::log10(x) - 1e-9));
  }
  double at(double x) const { return (std::log10(x) - lo) / std::max(1.0, hi - lo); }
};

// Error against N or against seconds, both axes logarithmic.
class Panel {
 public:
  using Abscissa = double (*)(const mc::RmsError& e);

  Panel(const std::vector<Curve>& curves, Abscissa abscissa) : curves_(curves), abscissa_(abscissa) {
    for (const Curve& c : curves)
      for (const mc::RmsError& e : c.errors)
        if (is_drawn(c, e)) {
          x_.hold(abscissa(e));
          y_.hold(e.rms);
        }
  }

  std::string svg(const std::string& label, bool with_theory) const {
    if (!(x_.lo < HUGE_VAL)) return {};
    std::string s = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"RMS error against {}\">", width,
                                height, label);
    s += grid() + fmt::format("<text class=\"axis\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>", (left + width - right) / 2,
                              height - 8, label);
    for (std::size_t i = 0; i < curves_.size(); ++i) s += curve(curves_[i], color(i), with_theory);
    return s + "</svg>";
  }

 private:
  bool is_drawn(const Curve& c, const mc::RmsError& e) const { return !c.exact && e.rms > 0 && abscissa_(e) > 0; }
  double px(double x) const { return left + (width - left - right) * x_.at(x); }
  double py(double y) const { return std::clamp(top + (height - top - bottom) * (1 - y_.at(y)), top, height - bottom); }
  static std::string line(const char* kind, double x0, double y0, double x1, double y1) {
    return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>", kind, x0, y0, x1,
                       y1);
  }
  static std::string tick(double x, double y, const char* anchor, double exponent) {
    return fmt::format("<text class=\"tick\" text-anchor=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">10<tspan dy=\"-5\" "
                       "font-size=\"8\">{:.0f}</tspan></text>",
                       anchor, x, y, exponent);
  }
  std::string grid() const {
    std::string s;
    const double x_step = std::ceil((x_.hi - x_.lo) / 8), y_step = std::ceil((y_.hi - y_.lo) / 8);
    for (double e = x_.lo; e <= x_.hi; e += std::max(1.0, x_step)) {
      const double x = px(std::pow(10, e));
      s += line("grid", x, top, x, height - bottom) + tick(x, height - bottom + 18, "middle", e);
    }
    for (double e = y_.lo; e <= y_.hi; e += std::max(1.0, y_step)) {
      const double y = py(std::pow(10, e));
      s += line("grid", left, y, width - right, y) + tick(left - 8, y + 4, "end", e);
    }
    return s;
  }
  std::string curve(const Curve& c, const std::string& color, bool with_theory) const {
    std::string line, upper, lower;
    double last_x = 0, last_y = 0, first_x = 0;
    for (const mc::RmsError& e : c.errors) {
      if (!is_drawn(c, e)) continue;
      const double x = px(abscissa_(e));
      line += fmt::format("{:.1f},{:.1f} ", x, py(e.rms));
      upper += fmt::format("{:.1f},{:.1f} ", x, py(e.hi));
      lower = fmt::format("{:.1f},{:.1f} ", x, py(std::max(e.lo, 1e-300))) + lower;
      if (first_x == 0) first_x = abscissa_(e);
      last_x = abscissa_(e);
      last_y = e.rms;
    }
    std::string s = fmt::format("<polygon points=\"{}{}\" fill=\"{}\" fill-opacity=\".16\"/>", upper, lower, color);
    s += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>", line, color);
    if (with_theory && c.theory && last_x > 0) {
      const double first_y = last_y * std::pow(first_x / last_x, -c.theory->exponent);
      s += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
                       "stroke-dasharray=\"1 4\" stroke-width=\"1.4\"/>",
                       px(first_x), py(first_y), px(last_x), py(last_y), color);
    }
    return s;
  }

  const std::vector<Curve>& curves_;
  Abscissa abscissa_;
  Decades x_, y_;
};

std::string row(const Curve& c, std::size_t i) {
  const mc::RmsError& last = c.errors.back();
  std::string slope = c.exact ? "exact" : "-", theory = "-", agrees = "-";
  if (c.law) slope = fmt::format("{:.3f} <small>[{:.3f}, {:.3f}]</small>", c.law->slope, c.law->lo, c.law->hi);
  if (c.theory) {
    theory = fmt::format("{}{:.3f}", c.theory->at_most ? "at most " : "", -c.theory->exponent);
    if (c.theory->log_power > 0 && c.law)
      theory += fmt::format(" <small>{:.3f} here</small>", -c.theory->local(c.middle));
    theory = fmt::format("<span title=\"{}\">{}</span>", escaped(c.theory->source), theory);
    if (c.law) agrees = c.agrees() ? "yes" : "no";
  }
  return fmt::format("<tr><td><i style=\"background:{}\"></i>{}</td><td>{:.0f}</td><td>{:.3g} <small>[{:.3g}, "
                     "{:.3g}]</small></td><td>{:.3g}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
                     color(i), escaped(c.way->name), last.n, last.rms, last.lo, last.hi, last.seconds, slope, theory,
                     agrees);
}

std::string section(const Measured& one) {
  const Experiment& e = one.target->integral;
  const Measurement& m = *one.measurement;
  std::string s = fmt::format("<section><h2>{}</h2><p class=\"facts\">{}{} dimension{}", escaped(e.title),
                              e.source.empty() ? "" : escaped(e.source) + "; ", e.dim, e.dim == 1 ? "" : "s");
  s += m.truth_error > 0 ? fmt::format("; reference {:.12g} &plusmn; {:.2g}", m.truth, m.truth_error)
                         : fmt::format("; truth {:.12g}", m.truth);
  if (e.smoothness.of != Smoothness::Class::unknown) s += fmt::format("; {}", name(e.smoothness.of));
  s += "</p>";
  if (!m.doubt.empty()) s += fmt::format("<p class=\"doubt\">{}</p>", escaped(m.doubt));
  const auto n = [](const mc::RmsError& p) { return p.n; };
  const auto seconds = [](const mc::RmsError& p) { return p.seconds; };
  s += "<div class=\"panels\">" + Panel(m.curves, n).svg("evaluations N", true) +
       Panel(m.curves, seconds).svg(std::string(m.cost.axis), false) +
       "</div><div class=\"scroll\"><table><tr><th>sampler<th>N<th>"
       "RMS error, 95 %<th>" +
       std::string(m.cost.axis) + "<th>slope, 95 %<th>theory<th>agrees</tr>";
  for (std::size_t i = 0; i < m.curves.size(); ++i) s += row(m.curves[i], i);
  return s + "</table></div></section>";
}

constexpr std::string_view style = R"(
h2 { font-size: 1.15rem; margin-top: 1.6rem; }
.facts, footer { color: var(--soft); }
.doubt { color: var(--fail); }
.panels { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 22rem), 1fr)); gap: .8rem; }
.panels { margin: .8rem 0; }
.panels svg { width: 100%; height: auto; background: var(--card); border: 1px solid var(--line); border-radius: 12px; }
.grid { stroke: var(--line); stroke-width: 1; }
.tick, .axis { fill: var(--soft); font-size: 12px; }
.axis { text-anchor: middle; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; background: var(--card); }
th, td { text-align: right; padding: .3rem .7rem; border-bottom: 1px solid var(--line); white-space: nowrap; }
th { font-weight: 400; color: var(--soft); }
th:first-child, td:first-child { text-align: left; }
td i { display: inline-block; width: .8rem; height: .8rem; border-radius: 3px; margin-right: .5rem; }
td i { vertical-align: -.08rem; }
td small { color: var(--soft); }
)";

} // namespace

std::string convergence_page(const std::vector<Measured>& all, const std::string& command) {
  std::string s =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>carlo converge</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n";
  s += std::string(page_css) + std::string(style);
  s += "</style>\n</head>\n<body>\n<header>\n<p class=\"tool\">carlo converge</p>\n<h1>What more samples buy</h1>\n";
  s += fmt::format("<p class=\"command\"><code>{}</code></p>\n</header>\n<main>\n", escaped(command));
  for (const Measured& one : all) s += section(one) + "\n";
  s += "</main>\n<footer><p>Bands and brackets hold the root-mean-square error, and the slope, with 95 % confidence. "
       "Dotted lines fall as theory says; <b>here</b> is the slope that its logarithms leave at these N. CPU seconds "
       "are "
       "those of one estimate.</p></footer>\n</body>\n</html>\n";
  return s;
}

} // namespace carlo

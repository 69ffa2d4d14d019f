#include <converge/panel.h>
#include <report/html.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

constexpr double width = 480, height = 340, left = 52, right = 12, top = 26, bottom = 42;

// A logarithmic axis.
struct Axis {
  double lo = HUGE_VAL, hi = -HUGE_VAL; ///< log10

  void hold(double x) {
    lo = std::min(lo, std::log10(x));
    hi = std::max(hi, std::log10(x));
  }
  void extend() {
    const double margin = std::max(0.04 * (hi - lo), 0.02);
    lo -= margin;
    hi += margin;
  }
  double at(double x) const { return (std::log10(x) - lo) / (hi - lo); }

  // At most about eight decades; 1, 2 and 5 times each decade on a short axis.
  std::vector<double> ticks() const {
    std::vector<double> all;
    const int step = std::max(1, static_cast<int>((hi - lo) / 8));
    for (int decade = static_cast<int>(std::floor(lo)); decade <= hi; decade += step)
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double e = decade + std::log10(digit);
        if ((digit == 1 || hi - lo < 2.5) && e >= lo && e <= hi) all.push_back(digit * std::pow(10, decade));
      }
    return all;
  }
};

// 0.05, 200, or a digit times a power of ten.
std::string number(double x) {
  if (x >= 0.00099 && x < 1001) return fmt::format("{:g}", x);
  const double decade = std::floor(std::log10(x) + 1e-9), digit = std::round(x / std::pow(10, decade));
  return fmt::format("{}10<tspan dy=\"-5\" font-size=\"8\">{:.0f}</tspan>",
                     digit == 1 ? "" : fmt::format("{:.0f}&middot;", digit), decade);
}

class Panel {
 public:
  Panel(const std::vector<ConvergenceCurve>& curves, const std::vector<CurveStyle>& styles, const PanelOptions& options)
      : curves_(curves), styles_(styles), options_(options) {
    for (const ConvergenceCurve& c : curves)
      for (const mc::RmsError* e : drawn(c)) {
        x_.hold(options.x(*e));
        y_.hold(e->rms);
      }
    x_.extend();
    y_.extend();
    const bool has_names =
        std::any_of(styles.begin(), styles.end(), [](const CurveStyle& style) { return style.wins(); });
    if (has_names) y_.lo -= 0.08 * (y_.hi - y_.lo); // names of winners stand below their curves
  }

  std::string svg() const {
    if (!(x_.lo < HUGE_VAL)) return {};
    std::string s = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"RMS error against {}\">", width,
                                height, escape_html(options_.axis));
    s += grid() + fmt::format("<text class=\"label\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>", (left + width - right) / 2,
                              height - 8, escape_html(options_.axis));
    s += "<text class=\"tick\" x=\"4\" y=\"14\">RMS error</text>" + best();
    std::vector<std::size_t> order = drawing_order(styles_);
    std::stable_partition(order.begin(), order.end(), [this](std::size_t i) { return !styles_[i].wins(); });
    for (const std::size_t i : order) s += curve(curves_[i], styles_[i]);
    return s + names_of_winners() + "</svg>";
  }

 private:
  std::vector<const mc::RmsError*> drawn(const ConvergenceCurve& c) const {
    std::vector<const mc::RmsError*> all;
    for (const mc::RmsError& e : c.errors)
      if (!c.exact && !e.is_bound && e.rms > 0 && options_.x(e) > 0) all.push_back(&e);
    return all;
  }
  double px(double x) const { return left + (width - left - right) * x_.at(x); }
  double py(double y) const {
    return y > 0 ? std::clamp(top + (height - top - bottom) * (1 - y_.at(y)), top, height - bottom) : height - bottom;
  }
  std::string point(double x, double y) const { return fmt::format("{:.1f},{:.1f} ", px(x), py(y)); }
  static std::string line(double x0, double y0, double x1, double y1, const std::string& looks) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>", x0, y0, x1, y1, looks);
  }
  static std::string tick(double x, double y, const char* anchor, double value) {
    return fmt::format("<text class=\"tick\" text-anchor=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", anchor, x, y,
                       number(value));
  }
  std::string grid() const {
    const std::string looks = "class=\"grid\"";
    std::string s;
    for (const double value : x_.ticks()) {
      const double x = px(value);
      s += line(x, top, x, height - bottom, looks) + tick(x, height - bottom + 18, "middle", value);
    }
    for (const double value : y_.ticks()) {
      const double y = py(value);
      s += line(left, y, width - right, y, looks) + tick(left - 8, y + 4, "end", value);
    }
    return s;
  }
  std::string best() const {
    std::string points;
    for (const TradeCandidate& o : options_.pareto_front)
      if (o.seconds.value > 0 && o.error.value > 0 && !o.error.is_upper_bound())
        points += point(o.seconds.value, o.error.value);
    if (points.empty()) return {};
    return fmt::format("<polyline class=\"best\" points=\"{}\"/>", points);
  }
  std::string curve(const ConvergenceCurve& c, const CurveStyle& style) const {
    const std::vector<const mc::RmsError*> errors = drawn(c);
    if (errors.empty()) return {};
    const std::string color = page_color(style);
    std::string middle, band;
    for (const mc::RmsError* e : errors) {
      middle += point(options_.x(*e), e->rms);
      band += point(options_.x(*e), e->hi);
    }
    for (auto e = errors.rbegin(); e != errors.rend(); ++e) band += point(options_.x(**e), (*e)->lo);
    std::string s;
    if (style.color) s += fmt::format("<polygon points=\"{}\" style=\"fill:{}\" fill-opacity=\".14\"/>", band, color);
    const double plain_width = style.color ? 1.8 : 1.1, stroke_width = style.wins() ? 3.2 : plain_width;
    s += fmt::format("<polyline points=\"{}\" fill=\"none\" style=\"stroke:{}\" stroke-width=\"{}\"/>", middle, color,
                     stroke_width);
    if (!options_.theory || !c.theory || !style.color) return s;
    const double first_x = options_.x(*errors.front()), last_x = options_.x(*errors.back()),
                 last_y = errors.back()->rms;
    const double first_y = last_y * std::pow(first_x / last_x, -c.theory->exponent);
    return s + line(px(first_x), py(first_y), px(last_x), py(last_y),
                    fmt::format("style=\"stroke:{}\" stroke-dasharray=\"1 4\" stroke-width=\"1.4\"", color));
  }
  // Below the last points, one above the other.
  std::string names_of_winners() const {
    struct Name {
      double x, y;
      std::string text;
    };
    std::vector<Name> names;
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      const std::vector<const mc::RmsError*> errors = drawn(curves_[i]);
      if (!styles_[i].wins() || errors.empty()) continue;
      names.push_back(
          {px(options_.x(*errors.back())) + 4, py(errors.back()->rms) + 18, escape_html(curve_label(curves_[i]))});
    }
    std::sort(names.begin(), names.end(), [](const Name& a, const Name& b) { return a.y > b.y; });
    std::string s;
    double lowest = height - bottom - 4;
    for (const Name& name : names) {
      const double y = std::min(name.y, lowest);
      lowest = y - 16;
      s += fmt::format("<text class=\"winner\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", name.x, y,
                       name.text);
    }
    return s;
  }

  const std::vector<ConvergenceCurve>& curves_;
  const std::vector<CurveStyle>& styles_;
  const PanelOptions& options_;
  Axis x_, y_;
};

} // namespace

std::string error_panel(const std::vector<ConvergenceCurve>& curves, const std::vector<CurveStyle>& styles,
                        const PanelOptions& options) {
  return Panel(curves, styles, options).svg();
}

} // namespace carlo

#include <converge/answer.h>
#include <converge/curve_style.h>
#include <converge/output.h>
#include <converge/page.h>
#include <converge/panel.h>
#include <report/html.h>

#include <mc/core/file.h>
#include <render/io/image/image_io.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace carlo {

namespace {

std::string format_interval(double value, double lo, double hi) {
  return fmt::format("{:.3g} <small>[{:.3g}, {:.3g}]</small>", value, lo, hi);
}
std::string format_interval(const IntervalEstimate& r) {
  if (r.is_upper_bound()) return fmt::format("&le; {:.3g}", r.hi);
  return r.is_lower_bound() ? fmt::format("&ge; {:.3g}", r.lo) : format_interval(r.value, r.lo, r.hi);
}

std::string evaluations(double n) { return n < 1000 ? fmt::format("{:.3g}", n) : fmt::format("{:.0f}", n); }

// A mark in the colour of the curve, and its name.
std::string named(const ConvergenceCurve& c, const CurveStyle& style) {
  return fmt::format("<i style=\"background:{}\"></i>{}", page_color(style), escape_html(curve_label(c)));
}
std::string named_winner(const ConvergenceCurve& c, const CurveStyle& style) {
  return fmt::format("{}{}{}", named(c, style), style.is_cheapest ? " <span class=\"wins\">cheapest</span>" : "",
                     style.is_most_accurate ? " <span class=\"wins\">most accurate</span>" : "");
}

/// Words that differ between integrals and scenes.
struct Words {
  std::string n, estimate;
};
Words words_of(const PageEntry& one) {
  if (one.pictures) return {"samples per pixel", "picture"};
  return {"evaluations N", "estimate"};
}

std::vector<std::string> theory_cells(const ConvergenceCurve& c) {
  std::string slope = c.exact ? "exact" : "-", theory = "-", agrees = "-";
  if (c.power_law)
    slope = fmt::format("{:.3f} <small>[{:.3f}, {:.3f}]</small>", c.power_law->slope, c.power_law->lo, c.power_law->hi);
  if (c.theory) {
    theory = c.theory->to_string(3);
    if (c.theory->log_power > 0 && c.power_law)
      theory += fmt::format(" <small>{:.3f} here</small>", -c.theory->local_exponent(c.fit_center));
    theory = fmt::format("<span title=\"{}\">{}</span>", escape_html(c.theory->source), theory);
    if (c.power_law) agrees = c.agrees_with_theory() ? "yes" : "no";
  }
  return {slope, theory, agrees};
}

// The bias, and the error above which the method is cheaper; "-" for a bias that is not significant.
std::array<std::string, 2> bias_cells(const Bias& b) {
  if (!(b.bias.lo > 0)) return {"-", "-"};
  if (!b.break_even_error) return {format_interval(b.bias), "never"};
  const auto end = [](double error) { return std::isfinite(error) ? fmt::format("{:.3g}", error) : "never"; };
  const IntervalEstimate& above = *b.break_even_error;
  return {format_interval(b.bias),
          fmt::format("{} <small>[{}, {}]</small>", end(above.value), end(above.lo), end(above.hi))};
}

/// A measurement with the looks of its curves.
struct Section {
  const PageEntry& one;
  std::vector<CurveStyle> styles;

  const Measurement& measurement() const { return *one.measurement; }
  const CurveStyle& style(const ConvergenceCurve& c) const {
    return styles[static_cast<std::size_t>(&c - measurement().curves.data())];
  }
};

std::vector<std::string> curve_cells(const Section& section, std::size_t i) {
  const PageEntry& one = section.one;
  const ConvergenceCurve& c = one.measurement->curves[i];
  const mc::RmsError& last = c.errors.back();
  std::vector<std::string> row = {named_winner(c, section.styles[i]), fmt::format("{:.0f}", last.n),
                                  format_interval(IntervalEstimate{last.rms, last.lo, last.hi}),
                                  fmt::format("{:.3g}", last.seconds)};
  for (std::string& cell : theory_cells(c)) row.push_back(std::move(cell));
  if (one.pictures)
    for (std::string& cell : bias_cells(one.pictures->biases[i])) row.push_back(std::move(cell));
  return row;
}

// The rest of a list, out of sight until it is asked for.
std::string folded(std::size_t count, std::string_view what, const std::string& html) {
  return count == 0 ? "" : fmt::format("<details><summary>{} {}</summary>{}</details>", count, what, html);
}

// Curves with a colour first; the grey ones are folded.
std::string curve_table(const Section& section) {
  const PageEntry& one = section.one;
  const Words words = words_of(one);
  std::vector<std::string> head = {
      "method", words.n, "RMS error [95 %]", std::string(one.measurement->cost.axis), "slope [95 %]",
      "theory", "agrees"};
  if (one.pictures) head.insert(head.end(), {"bias [95 %]", "pays above"});
  HtmlTable colored(head), grey(head);
  std::size_t others = 0;
  for (const std::size_t i : drawing_order(section.styles)) {
    const bool has_color = section.styles[i].color.has_value();
    (has_color ? colored : grey).add(curve_cells(section, i));
    others += has_color ? 0 : 1;
  }
  return colored.html() + folded(others, "more methods, drawn in grey", grey.html());
}

// The candidates that do not differ significantly from the first.
std::string ties(const std::vector<TradeCandidate>& candidates, IntervalEstimate TradeCandidate::*criterion) {
  const std::size_t count = count_ties(candidates, criterion);
  if (count < 2) return "-";
  std::string s;
  for (std::size_t i = 1; i < count; ++i) s += (i == 1 ? "" : ", ") + escape_html(curve_label(*candidates[i].curve));
  return "<span class=\"ties\">" + s + "</span>";
}

/// A table with a row for each wanted error or cost. The gain over plain Monte Carlo is a column where one is known.
class ChoiceTable {
 public:
  ChoiceTable(const Section& section, const std::string& wanted, const std::string& method, std::string_view shown,
              const std::string& gain)
      : section_(section), has_gain_(!gain.empty()), table_(columns(section, wanted, method, shown, gain)) {}

  void add(const std::string& wanted, const std::vector<TradeCandidate>& candidates,
           IntervalEstimate TradeCandidate::*criterion, const std::optional<IntervalEstimate>& gain) {
    const TradeCandidate& o = candidates.front();
    std::vector<std::string> row = {wanted, named(*o.curve, section_.style(*o.curve)),
                                    format_interval(reported_interval(o, criterion)),
                                    evaluations(o.n) + (o.is_largest_n ? ", the largest" : "")};
    if (has_gain_) row.push_back(gain ? format_interval(*gain) + " &times;" : "-");
    row.push_back(ties(candidates, criterion));
    table_.add(row);
  }
  void add(const std::string& wanted, const std::string& why_not) { table_.add_note(wanted, why_not); }
  std::string html() const { return table_.is_empty() ? "" : "<div class=\"choices\">" + table_.html() + "</div>"; }

 private:
  static std::vector<std::string> columns(const Section& section, const std::string& wanted, const std::string& method,
                                          std::string_view shown, const std::string& gain) {
    std::vector<std::string> head = {wanted, method, std::string(shown), words_of(section.one).n};
    if (!gain.empty()) head.push_back(gain);
    head.emplace_back("no significant difference");
    return head;
  }

  const Section& section_;
  bool has_gain_;
  HtmlTable table_;
};

std::string nearest(const CandidatesForError& f, const Section& section) {
  if (f.nearest.empty()) return "not reached";
  const TradeCandidate& o = f.nearest.front();
  return fmt::format("not reached; smallest error: {} {}{:.3g}", named(*o.curve, section.style(*o.curve)),
                     o.error.is_upper_bound() ? "&le; " : "", o.error.value);
}

std::string answer_tables(const Section& section) {
  const TradeResults& a = *section.one.trade_results;
  const std::string_view cost = section.measurement().cost.axis;
  const auto has_gain = [](const auto& all) {
    return std::any_of(all.begin(), all.end(), [](const auto& f) { return f.gain.has_value(); });
  };
  ChoiceTable by_error(section, "wanted RMS error", "cheapest method", cost,
                       has_gain(a.by_error) ? "cost of plain Monte Carlo" : ""),
      by_cost(section, fmt::format("wanted {}", cost), "most accurate method", "RMS error",
              has_gain(a.by_time) ? "error of plain Monte Carlo" : "");
  for (const CandidatesForError& f : a.by_error) {
    const std::string wanted = fmt::format("{:g}", f.goal);
    if (f.candidates.empty()) by_error.add(wanted, nearest(f, section));
    else by_error.add(wanted, f.candidates, &TradeCandidate::seconds, f.gain);
  }
  for (const CandidatesForTime& f : a.by_time) {
    const std::string wanted = fmt::format("{:g}", f.goal);
    if (f.candidates.empty()) by_cost.add(wanted, "too little for any method");
    else by_cost.add(wanted, f.candidates, &TradeCandidate::error, f.gain);
  }
  return by_error.html() + by_cost.html();
}

std::string facts(const PageEntry& one) {
  const UnitCubeIntegral& e = one.target->integral;
  const Measurement& m = *one.measurement;
  if (one.pictures)
    return fmt::format("{}; {}&times;{} pixels; reference of {:.0f} samples per pixel with an error of {:.2g}{}{}",
                       escape_html(e.source), one.pictures->reference.width, one.pictures->reference.height,
                       one.pictures->reference_spp, one.pictures->reference_error,
                       one.pictures->missing_light.empty() ? "" : "; ", escape_html(one.pictures->missing_light));
  std::string s = fmt::format("{}{} dimension{}", e.source.empty() ? "" : escape_html(e.source) + "; ", e.dim,
                              e.dim == 1 ? "" : "s");
  s += m.truth_error > 0 ? fmt::format("; reference {:.12g} &plusmn; {:.2g}", m.truth, m.truth_error)
                         : fmt::format("; truth {:.12g}", m.truth);
  if (e.smoothness.kind != Smoothness::Class::unknown) s += fmt::format("; {}", name(e.smoothness.kind));
  if (m.interrupted) s += "; interrupted";
  return s;
}

/// A picture of a scene, its file in the folder of the page, and its caption.
struct Thumbnail {
  const render::Image& image;
  std::string file, caption;
  bool is_folded = false;
};

// The reference and a picture of each method, in the order of the table.
std::vector<Thumbnail> thumbnails(const Section& section) {
  if (!section.one.pictures) return {};
  const PictureMeasurement& p = *section.one.pictures;
  const std::string name = safe_file_name(section.one.target->integral.name);
  std::vector<Thumbnail> all = {{p.reference, name + "-reference.png", "reference"}};
  for (const std::size_t i : drawing_order(section.styles)) {
    const CurveStyle& style = section.styles[i];
    all.push_back(
        {p.pictures[i], fmt::format("{}-{}.png", name, i + 1),
         fmt::format("{} <span>{:.0f}</span>", named_winner(section.measurement().curves[i], style), p.biases[i].n),
         !style.color});
  }
  return all;
}

std::string pictures(const Section& section) {
  std::string shown, hidden;
  std::size_t others = 0;
  for (const Thumbnail& t : thumbnails(section)) {
    (t.is_folded ? hidden : shown) += fmt::format("<figure><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"\" "
                                                  "loading=\"lazy\"><figcaption>{}</figcaption></figure>",
                                                  t.file, t.image.width, t.image.height, t.caption);
    others += t.is_folded ? 1 : 0;
  }
  if (shown.empty()) return {};
  return "<div class=\"pictures\">" + shown + "</div>" +
         folded(others, "more pictures", "<div class=\"pictures\">" + hidden + "</div>");
}

std::string html_of(const Section& section) {
  const PageEntry& one = section.one;
  const Measurement& m = *one.measurement;
  const auto n = [](const mc::RmsError& p) { return p.n; };
  const auto seconds = [](const mc::RmsError& p) { return p.seconds; };
  std::string s =
      fmt::format("<section><h2>{}</h2><p class=\"facts\">{}</p>", escape_html(one.target->integral.title), facts(one));
  for (const std::string& warning : {m.truth_warning, variance_warning(m)})
    if (!warning.empty()) s += fmt::format("<p class=\"doubt\">{}</p>", escape_html(warning));
  for (const FailedMethod& f : m.failures)
    s += fmt::format("<p class=\"doubt\">{} failed: {}</p>", escape_html(method_label(*f.method)),
                     escape_html(f.reason));
  if (one.trade_results)
    s += "<p class=\"answer\">" + escape_html(answer_text(m, *one.trade_results)) + "</p>" + answer_tables(section);
  s += "<div class=\"panels\">" +
       error_panel(m.curves, section.styles, {.axis = words_of(one).n, .x = n, .theory = true});
  s += error_panel(
      m.curves, section.styles,
      {.axis = m.cost.axis,
       .x = seconds,
       .pareto_front = one.trade_results ? one.trade_results->pareto_front : std::vector<TradeCandidate>()});
  return s + "</div>" + curve_table(section) + pictures(section) + "</section>";
}

std::string footer(const PageEntry& one) {
  std::string s =
      fmt::format("Bands and brackets are 95 % confidence intervals of the root-mean-square (RMS) error and "
                  "of the slope. Dotted lines have the slope of theory{}. The cost is {} of one {}.",
                  one.pictures ? "" : "; <b>here</b> is that slope with its logarithms at these N",
                  one.measurement->cost.axis, words_of(one).estimate);
  if (one.trade_results)
    s +=
        " The broad grey line is the Pareto front: no measured point is both cheaper and more accurate than a point of "
        "this line. A method has <b>no significant difference</b> from the winner where their intervals, widened for "
        "all methods at once, overlap.";
  if (one.pictures)
    s +=
        " The <b>error</b> of a picture is the square root of its relative mean square error (relmse): the mean over "
        "pixels and channels of (x - reference)&sup2; / (reference&sup2; + mean&sup2; / 10). The <b>bias</b> of a "
        "method is the error that remains with any number of samples. A biased method <b>pays</b> for errors above the "
        "stated one: it costs less there than every unbiased method. Each picture is one of several; the number below "
        "it counts the samples per pixel.";
  return s;
}

constexpr std::string_view page_style = R"(
h2 { font-size: 1.15rem; margin-top: 1.6rem; }
.facts, footer { color: var(--soft); }
.facts { overflow-wrap: anywhere; }
.doubt { color: var(--fail); }
.panels { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 22rem), 1fr)); gap: .8rem; }
.panels { margin: .8rem 0; }
.panels svg { width: 100%; height: auto; background: var(--card); border: 1px solid var(--line); border-radius: 12px; }
.best { fill: none; stroke: var(--line); stroke-width: 9; stroke-linejoin: round; stroke-linecap: round; }
.tick, .label { fill: var(--soft); font-size: 12px; }
.label { text-anchor: middle; }
.winner { fill: var(--ink); font-size: 13px; font-weight: 600; }
.winner { paint-order: stroke; stroke: var(--card); stroke-width: 4px; }
.answer { font-size: 1.12em; margin: .7rem 0; max-width: 52rem; }
.scroll { margin-top: .8rem; }
i { display: inline-block; width: .8rem; height: .8rem; border-radius: 3px; }
i { margin-right: .5rem; vertical-align: -.08rem; }
.wins { background: var(--ink); color: var(--card); border-radius: 6px; padding: .05rem .4rem; font-size: .8em; }
.wins { font-weight: 600; white-space: nowrap; }
td small { color: var(--soft); white-space: nowrap; }
.choices td:last-child, .choices th:last-child { text-align: left; }
.ties { display: block; color: var(--soft); }
details { margin-top: .8rem; }
@media (max-width: 52rem) { .cards td:has(> .ties) { grid-column: 1 / -1; } }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(9rem, 1fr)); gap: .8rem; margin-top: .8rem; }
.pictures img { width: 100%; height: auto; display: block; image-rendering: pixelated; border-radius: 6px; }
figcaption { display: block; font-size: .84em; overflow-wrap: anywhere; }
)";

} // namespace

PageHeader converge_header(const std::string& command) { return {"carlo converge", "Error against samples", command}; }
PageHeader trade_header(const std::string& command) { return {"carlo trade", "Which method to choose", command}; }

std::string safe_file_name(const std::string& text) {
  std::string safe = text.substr(0, 60);
  for (char& c : safe)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') c = '_';
  return safe;
}

void write_convergence_page(ResultWriter& results, const std::filesystem::path& folder, const PageHeader& head,
                            const std::vector<PageEntry>& all) {
  const std::string css = curve_color_css() + std::string(page_style);
  HtmlPage page{.tool = head.tool, .title = head.title, .style = css, .command = head.command};
  for (const PageEntry& one : all) {
    const Section section{one, curve_styles(*one.measurement, one.trade_results)};
    page.main += html_of(section) + "\n";
    for (const Thumbnail& t : thumbnails(section))
      results.write((folder / t.file).string(), false,
                    [&](const std::string& file) { render::write_image(file, t.image); });
  }
  if (!all.empty()) page.footer = footer(all.front());
  results.write((folder / "index.html").string(), false, to_html(page));
}

} // namespace carlo

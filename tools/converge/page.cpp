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

std::string table(const std::vector<std::string>& head, const std::string& rows) {
  std::string s = "<div class=\"scroll\"><table><tr>";
  for (const std::string& h : head) s += fmt::format("<th>{}</th>", h);
  return s + "</tr>" + rows + "</table></div>";
}

std::string cells(const std::vector<std::string>& all) {
  std::string s = "<tr>";
  for (const std::string& c : all) s += fmt::format("<td>{}</td>", c);
  return s + "</tr>";
}

// A marker in the colour of the curve, followed by its name.
std::string named(const ConvergenceCurve& c, const Measurement& m) {
  const auto i = static_cast<std::size_t>(&c - m.curves.data());
  return fmt::format("<i style=\"background:{}\"></i>{}", color(i), escape_html(curve_label(c)));
}

/// Terms that differ between integrals and scenes.
struct Words {
  std::string method, n, estimate;
};
Words words_of(const PageEntry& one) {
  if (one.pictures) return {"way", "samples per pixel", "picture"};
  return {one.trade_results ? "way" : "sampler", "evaluations N", "estimate"};
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

std::string curve_table(const PageEntry& one) {
  const Measurement& m = *one.measurement;
  const Words words = words_of(one);
  std::vector<std::string> head = {words.method,  words.n,  "RMS error, 95 %", std::string(m.cost.axis),
                                   "slope, 95 %", "theory", "agrees"};
  if (one.pictures) head.insert(head.end(), {"bias, 95 %", "pays above"});
  std::string rows;
  for (std::size_t i = 0; i < m.curves.size(); ++i) {
    const ConvergenceCurve& c = m.curves[i];
    const mc::RmsError& last = c.errors.back();
    std::vector<std::string> row = {named(c, m), fmt::format("{:.0f}", last.n),
                                    format_interval(IntervalEstimate{last.rms, last.lo, last.hi}),
                                    fmt::format("{:.3g}", last.seconds)};
    for (std::string& cell : theory_cells(c)) row.push_back(std::move(cell));
    if (one.pictures)
      for (std::string& cell : bias_cells(one.pictures->biases[i])) row.push_back(std::move(cell));
    rows += cells(row);
  }
  return table(head, rows);
}

// The methods that tie with the first.
std::string ties(const std::vector<TradeCandidate>& candidates, IntervalEstimate TradeCandidate::*criterion) {
  const std::size_t count = count_ties(candidates, criterion);
  std::string s = count > 1 ? "" : "-";
  for (std::size_t i = 1; i < count; ++i) s += (i == 1 ? "" : ", ") + escape_html(curve_label(*candidates[i].curve));
  return "<span class=\"ties\">" + s + "</span>";
}

/// Rows of the requested goals. The gain over plain Monte Carlo is a column if it exists for at least one goal.
class ChoiceTable {
 public:
  ChoiceTable(const PageEntry& one, bool has_gain) : m_(*one.measurement), n_(words_of(one).n), has_gain_(has_gain) {}

  void add(const std::string& wanted, const std::vector<TradeCandidate>& candidates,
           IntervalEstimate TradeCandidate::*criterion, const std::optional<IntervalEstimate>& gain) {
    const TradeCandidate& o = candidates.front();
    std::vector<std::string> row = {wanted, named(*o.curve, m_), format_interval(reported_interval(o, criterion)),
                                    fmt::format("{:.3g}{}", o.n, o.is_largest_n ? ", the largest" : "")};
    if (has_gain_) row.push_back(gain ? format_interval(*gain) + " &times;" : "-");
    row.push_back(ties(candidates, criterion));
    rows_ += cells(row);
  }
  void add(const std::string& wanted, const std::string& why_not) {
    rows_ += fmt::format("<tr><td>{}</td><td class=\"none\" colspan=\"5\">{}</td></tr>", wanted, why_not);
  }
  std::string table(const std::string& wanted, const std::string& method, std::string_view shown,
                    const std::string& gain) const {
    if (rows_.empty()) return {};
    std::vector<std::string> head = {wanted, method, std::string(shown), n_};
    if (has_gain_) head.push_back(gain);
    head.emplace_back("<span class=\"ties\">not told from it</span>");
    return carlo::table(head, rows_);
  }

 private:
  const Measurement& m_;
  std::string n_;
  bool has_gain_;
  std::string rows_;
};

std::string nearest(const CandidatesForError& f, const Measurement& m) {
  if (f.nearest.empty()) return "no way came there";
  const TradeCandidate& o = f.nearest.front();
  return fmt::format("no way came there; nearest {}: {}{:.3g}", named(*o.curve, m),
                     o.error.is_upper_bound() ? "&le; " : "", o.error.value);
}

std::string choice_tables(const PageEntry& one) {
  const Measurement& m = *one.measurement;
  const TradeResults& a = *one.trade_results;
  const auto gains = [](const auto& f) { return f.gain.has_value(); };
  ChoiceTable by_error(one, std::any_of(a.by_error.begin(), a.by_error.end(), gains)),
      by_cost(one, std::any_of(a.by_time.begin(), a.by_time.end(), gains));
  for (const CandidatesForError& f : a.by_error) {
    const std::string wanted = fmt::format("{:g}", f.goal);
    if (f.candidates.empty()) by_error.add(wanted, nearest(f, m));
    else by_error.add(wanted, f.candidates, &TradeCandidate::seconds, f.gain);
  }
  for (const CandidatesForTime& f : a.by_time) {
    const std::string wanted = fmt::format("{:g}", f.goal);
    if (f.candidates.empty()) by_cost.add(wanted, "no way can begin with so little");
    else by_cost.add(wanted, f.candidates, &TradeCandidate::error, f.gain);
  }
  return by_error.table("wanted error", "cheapest way", m.cost.axis, "plain Monte Carlo costs") +
         by_cost.table(std::string(m.cost.axis), "most accurate way", "RMS error", "plain Monte Carlo errs by");
}

std::string facts(const PageEntry& one) {
  const UnitCubeIntegral& e = one.target->integral;
  const Measurement& m = *one.measurement;
  if (one.pictures)
    return fmt::format("{}; {}&times;{} pixels; reference of {:.0f} samples per pixel with an error of {:.2g}",
                       escape_html(e.source), one.pictures->reference.width, one.pictures->reference.height,
                       one.pictures->reference_spp, one.pictures->reference_error);
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
};

std::vector<Thumbnail> thumbnails(const PageEntry& one) {
  if (!one.pictures) return {};
  const PictureMeasurement& p = *one.pictures;
  const std::string name = safe_file_name(one.target->integral.name);
  std::vector<Thumbnail> all = {{p.reference, name + "-reference.png", "reference"}};
  for (std::size_t i = 0; i < p.pictures.size(); ++i)
    all.push_back(
        {p.pictures[i], fmt::format("{}-{}.png", name, i + 1),
         fmt::format("{} <span>{:.0f}</span>", named(one.measurement->curves[i], *one.measurement), p.biases[i].n)});
  return all;
}

std::string pictures(const PageEntry& one) {
  std::string s;
  for (const Thumbnail& t : thumbnails(one))
    s += fmt::format("<figure><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"\"><figcaption>{}</figcaption></figure>",
                     t.file, t.image.width, t.image.height, t.caption);
  return s.empty() ? s : "<div class=\"pictures\">" + s + "</div>";
}

std::string section(const PageEntry& one) {
  const Measurement& m = *one.measurement;
  const Words words = words_of(one);
  const auto n = [](const mc::RmsError& p) { return p.n; };
  const auto seconds = [](const mc::RmsError& p) { return p.seconds; };
  std::string s =
      fmt::format("<section><h2>{}</h2><p class=\"facts\">{}</p>", escape_html(one.target->integral.title), facts(one));
  for (const std::string& warning : {m.truth_warning, variance_warning(m)})
    if (!warning.empty()) s += fmt::format("<p class=\"doubt\">{}</p>", escape_html(warning));
  if (one.trade_results) s += choice_tables(one);
  s += "<div class=\"panels\">" + error_panel(m.curves, {.axis = words.n, .x = n, .theory = true});
  s += error_panel(
      m.curves, {.axis = m.cost.axis,
                 .x = seconds,
                 .pareto_front = one.trade_results ? one.trade_results->pareto_front : std::vector<TradeCandidate>()});
  return s + "</div>" + curve_table(one) + pictures(one) + "</section>";
}

std::string footer(const PageEntry& one) {
  std::string s = fmt::format(
      "Bands and brackets hold the root-mean-square error, and the slope, with 95 % confidence. Dotted lines fall as "
      "theory says{}. The {} are those of one {}.",
      one.pictures ? "" : "; <b>here</b> is the slope that its logarithms leave at these N", one.measurement->cost.axis,
      words_of(one).estimate);
  if (one.trade_results) s += " No other way is both cheaper and more accurate than those on the broad line.";
  if (one.pictures)
    s += " The <b>error</b> of a picture is the root of its relmse: the mean over pixels and channels of (x - "
         "reference)&sup2; / (reference&sup2; + mean&sup2; / 10). A <b>bias</b> is what a way errs by however long it "
         "runs; where "
         "it costs less than every way without, it <b>pays</b> for errors above the one named. The pictures are one of "
         "each way, with so many samples per pixel.";
  return s;
}

constexpr std::string_view style = R"(
h2 { font-size: 1.15rem; margin-top: 1.6rem; }
.facts, footer { color: var(--soft); }
.facts { overflow-wrap: anywhere; }
.doubt { color: var(--fail); }
.panels { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 22rem), 1fr)); gap: .8rem; }
.panels { margin: .8rem 0; }
.panels svg { width: 100%; height: auto; background: var(--card); border: 1px solid var(--line); border-radius: 12px; }
.grid { stroke: var(--line); stroke-width: 1; }
.best { fill: none; stroke: var(--line); stroke-width: 9; stroke-linejoin: round; stroke-linecap: round; }
.tick, .label { fill: var(--soft); font-size: 12px; }
.label { text-anchor: middle; }
.scroll { margin-top: .8rem; }
table { background: var(--card); }
th, td { text-align: right; padding: .3rem .7rem; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; }
td i, figcaption i { display: inline-block; width: .8rem; height: .8rem; border-radius: 3px; margin-right: .5rem; }
td i, figcaption i { vertical-align: -.08rem; }
td small { color: var(--soft); }
th:last-child, td:last-child { padding-right: .7rem; }
td.none { text-align: left; color: var(--soft); }
.ties { display: block; min-width: 14rem; white-space: normal; text-align: left; }
.ties { color: var(--soft); }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(9rem, 1fr)); gap: .8rem; margin-top: .8rem; }
.pictures img { width: 100%; height: auto; display: block; image-rendering: pixelated; border-radius: 6px; }
figcaption { display: block; font-size: .84em; overflow-wrap: anywhere; }
)";

} // namespace

PageHeader converge_header(const std::string& command) { return {"carlo converge", "What more samples buy", command}; }
PageHeader trade_header(const std::string& command) { return {"carlo trade", "Which way to take", command}; }

std::string safe_file_name(const std::string& text) {
  std::string safe = text.substr(0, 60);
  for (char& c : safe)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') c = '_';
  return safe;
}

void write_convergence_page(const std::filesystem::path& folder, const PageHeader& head,
                            const std::vector<PageEntry>& all) {
  HtmlPage page{.tool = head.tool, .title = head.title, .style = style, .command = head.command};
  for (const PageEntry& one : all) {
    page.main += section(one) + "\n";
    for (const Thumbnail& t : thumbnails(one)) render::write_image((folder / t.file).string(), t.image);
  }
  if (!all.empty()) page.footer = footer(all.front());
  mc::write_file((folder / "index.html").string(), to_html(page));
}

} // namespace carlo

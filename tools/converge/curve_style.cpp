#include <converge/curve_style.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace carlo {

namespace {

// Chosen by search: the smallest difference of two colours is large for full colour vision, protanopia, deuteranopia
// and tritanopia (Machado et al. 2009).
using Palette = std::array<const char*, curve_color_count>;
constexpr Palette on_white = {"#2160c2", "#b73300", "#15985d", "#ab7298", "#fa9000", "#4db2ff", "#000000", "#6c150d"};
constexpr Palette on_dark = {"#5269f2", "#d9631f", "#55e89a", "#b5449a", "#ffc91f", "#82b9ff", "#f7f7f7", "#97725c"};
constexpr const char *grey_on_white = "#c3c6ca", *grey_on_dark = "#4a5058";

std::string properties(const Palette& palette, const char* grey) {
  std::string css;
  for (std::size_t i = 0; i < palette.size(); ++i) css += fmt::format("--curve-{}: {}; ", i, palette[i]);
  return css + fmt::format("--curve-other: {};", grey);
}

// The same method in another scalar type or call order: its curve lies on that of the method.
bool is_variant(const ConvergenceCurve& c) { return c.method->scalar_calls || c.method->name.ends_with("_float"); }

/// Gives colours to curves in the order of calls, once each, until all colours are used.
class Colors {
 public:
  explicit Colors(const Measurement& m) : m_(m), styles_(m.curves.size()) {}

  CurveStyle& give(const ConvergenceCurve& c) {
    CurveStyle& style = styles_[static_cast<std::size_t>(&c - m_.curves.data())];
    if (!style.color && next_ < curve_color_count) style.color = next_++;
    return style;
  }
  std::vector<CurveStyle> styles() const { return styles_; }

 private:
  const Measurement& m_;
  std::vector<CurveStyle> styles_;
  std::size_t next_ = 0;
};

void give_to_winners(const TradeResults& trade_results, Colors& colors) {
  for (const CandidatesForError& f : trade_results.by_error)
    if (!f.candidates.empty()) colors.give(*f.candidates.front().curve).is_cheapest = true;
  for (const CandidatesForTime& f : trade_results.by_time)
    if (!f.candidates.empty()) colors.give(*f.candidates.front().curve).is_most_accurate = true;
}

// The best candidates of each answer, then the second best, and so on.
void give_by_rank(const Measurement& m, const TradeResults& trade_results, Colors& colors) {
  std::vector<const std::vector<TradeCandidate>*> lists;
  for (const CandidatesForError& f : trade_results.by_error)
    lists.push_back(f.candidates.empty() ? &f.nearest : &f.candidates);
  for (const CandidatesForTime& f : trade_results.by_time) lists.push_back(&f.candidates);
  for (std::size_t rank = 0; rank < m.curves.size(); ++rank)
    for (const std::vector<TradeCandidate>* list : lists)
      if (rank < list->size() && !is_variant(*(*list)[rank].curve)) colors.give(*(*list)[rank].curve);
}

void give_by_last_error(const Measurement& m, Colors& colors) {
  std::vector<const ConvergenceCurve*> all;
  for (const ConvergenceCurve& c : m.curves)
    if (c.has_measurable_error()) all.push_back(&c);
  std::stable_sort(all.begin(), all.end(), [](const ConvergenceCurve* a, const ConvergenceCurve* b) {
    return std::pair(is_variant(*a), a->errors.back().rms) < std::pair(is_variant(*b), b->errors.back().rms);
  });
  for (const ConvergenceCurve* c : all) colors.give(*c);
}

} // namespace

std::vector<CurveStyle> curve_styles(const Measurement& m, const TradeResults* trade_results) {
  Colors colors(m);
  if (m.curves.size() <= curve_color_count)
    for (const ConvergenceCurve& c : m.curves) colors.give(c);
  if (trade_results) give_to_winners(*trade_results, colors);
  for (const ConvergenceCurve& c : m.curves)
    if (c.method->name == m.plain_mc && !is_variant(c)) colors.give(c);
  if (trade_results) give_by_rank(m, *trade_results, colors);
  give_by_last_error(m, colors);
  return colors.styles();
}

std::vector<std::size_t> drawing_order(const std::vector<CurveStyle>& styles) {
  std::vector<std::size_t> order(styles.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return styles[a].color < styles[b].color; // nothing is less than any value
  });
  return order;
}

std::string color_on_white(const CurveStyle& style) { return style.color ? on_white[*style.color] : grey_on_white; }

std::string page_color(const CurveStyle& style) {
  return style.color ? fmt::format("var(--curve-{})", *style.color) : "var(--curve-other)";
}

std::string curve_color_css() {
  return fmt::format("\n:root {{ {} }}\n@media (prefers-color-scheme: dark) {{ :root {{ {} }} }}\n",
                     properties(on_white, grey_on_white), properties(on_dark, grey_on_dark));
}

} // namespace carlo

#include <gallery/page.h>
#include <report/html.h>
#include <terminal/progress.h>

#include <fmt/format.h>

#include <cmath>

namespace carlo {

namespace {

std::string percent(double share) {
  if (!std::isfinite(share)) return "unknown";
  return share < 0.1 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

// Means are relative to the most precise mean, work is relative to the least work.
std::string strategies_of(const RenderedScene& r) {
  const StrategyResult* best = most_precise(r.strategies);
  if (!best || !(best->mean.value > 0)) return {};
  double least = HUGE_VAL;
  for (const StrategyResult& s : r.strategies)
    if (s.work > 0 && !s.misses_light) least = std::min(least, s.work);
  std::string text =
      "<details><summary>Strategies compared</summary><div class=\"scroll\"><table><tr><th>strategy"
      "<th class=\"n\">work<th class=\"n\">error<th class=\"n\">undecided<th class=\"n\">brightness</tr>";
  for (const StrategyResult& s : r.strategies) {
    const std::string work = s.work > 0 ? fmt::format("{:.3g}&times;", s.work / least) : "0";
    text += fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
                        "<td class=\"n\">{:.1f} &plusmn; {:.1f} %</td></tr>",
                        s.name == r.strategy ? fmt::format("<b>{}</b>", s.name) : std::string(s.name), work,
                        percent(s.relative_error), percent(s.outlier_dominated), 100 * s.mean.value / best->mean.value,
                        100 * s.mean.std_error / best->mean.value);
  }
  return text + "</table></div></details>";
}

std::string section(const RenderedScene& r) {
  const GalleryScene& scene = *r.scene;
  std::string s = fmt::format(
      "<section id=\"{0}\"><a href=\"{0}.png\"><img src=\"{0}.png\" width=\"{1}\" height=\"{2}\" loading=\"lazy\" "
      "alt=\"{3}\"></a><h2>{3}</h2><p class=\"source\"><code>{0}</code> {4}</p>",
      scene.name, r.width, r.height, escape_html(scene.title), escape_html(scene.source));
  s += fmt::format(
      "<p class=\"facts\">{}&times;{}, {:.4g} samples/pixel, <b>{}samples/s</b>, {}, mean relative standard error "
      "<b>{}</b>{}; {}, {}; <a href=\"{}.exr\">EXR</a></p>",
      r.width, r.height, r.spp, format_count(r.samples_per_second), format_seconds(r.seconds),
      percent(r.relative_error),
      r.outlier_dominated > 0 ? fmt::format(", {} of the pixels decided by one sample", percent(r.outlier_dominated))
                              : "",
      r.strategy, r.sampler, scene.name);
  s += "<ul class=\"features\">";
  for (const Feature& f : r.features) s += fmt::format("<li>{}</li>", escape_html(f));
  return s + "</ul>" + strategies_of(r) + "</section>";
}

constexpr std::string_view style = R"(
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 22rem), 1fr)); gap: 1.2rem; }
main { align-items: start; }
section { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: .9rem; min-width: 0; }
section img { width: 100%; height: auto; display: block; border-radius: 6px; background: #000; margin-bottom: .7rem; }
section h2 { font-size: 1.05rem; line-height: 1.3; }
.source, .facts, footer { color: var(--soft); }
.source code { color: var(--ink); }
.facts { margin-top: .4rem; font-size: .92em; }
.facts b { color: var(--ink); }
.features { list-style: none; display: flex; flex-wrap: wrap; gap: .3rem; margin: .6rem 0; font-size: .8em; }
.features li { background: var(--quiet); border-radius: 6px; padding: .05rem .45rem; overflow-wrap: anywhere; }
details { margin-top: .5rem; }
details td, details th { padding: .2rem .4rem .2rem 0; }
details table { font-size: .84em; }
a { color: var(--link); }
.doubt { color: var(--fail); }
)";

} // namespace

std::string gallery_page(const std::vector<RenderedScene>& rendered, std::size_t requested,
                         const std::string& command) {
  HtmlPage page{.tool = "carlo gallery", .title = "Scenes with error bars", .style = style, .command = command};
  if (rendered.size() < requested)
    page.note =
        fmt::format("<p class=\"doubt\">Interrupted: {} of {} scenes were finished.</p>\n", rendered.size(), requested);
  for (const RenderedScene& r : rendered) page.main += section(r) + "\n";
  page.footer =
      "<b>Mean relative standard error</b>: the root mean square of the pixels' standard errors "
      "relative to the radiance about them, in the dark to half of the picture's mean; the EXR beside each picture "
      "has the variance of every pixel. Where one sample carries "
      "over half of a pixel's variance, its error is not known yet. <b>Strategies</b> are compared on small pictures "
      "with equal samples, the one of the picture in bold: <b>work</b> is what the same error costs in CPU time, "
      "relative to the cheapest that is right; <b>brightness</b> is the mean luminance relative to the strategy that "
      "knows it best. <b>light</b> looks towards lamps alone, and misses what other surfaces and the sky send.";
  return to_html(page);
}

} // namespace carlo

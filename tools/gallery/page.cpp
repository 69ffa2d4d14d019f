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
  HtmlTable table({"strategy", "work", "error", "dominated", "mean [%]"});
  for (const StrategyResult& s : r.strategies)
    table.add({s.name == r.strategy ? fmt::format("<b>{}</b>", s.name) : std::string(s.name),
               s.work > 0 ? fmt::format("{:.3g}&times;", s.work / least) : "0", percent(s.relative_error),
               percent(s.outlier_dominated),
               fmt::format("{:.1f}&thinsp;&plusmn;&thinsp;{:.1f}", 100 * s.mean.value / best->mean.value,
                           100 * s.mean.std_error / best->mean.value)});
  return "<details><summary>Compare strategies</summary>" + table.html(HtmlTable::Width::narrow) + "</details>";
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
      r.outlier_dominated > 0 ? fmt::format(", one sample dominates {} of the pixels", percent(r.outlier_dominated))
                              : "",
      r.strategy, r.sampler, scene.name);
  s += "<ul class=\"features\">";
  for (const Feature& f : r.features) s += fmt::format("<li>{}</li>", escape_html(f));
  return s + "</ul>" + strategies_of(r) + "</section>";
}

constexpr std::string_view style = R"(
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 23rem), 1fr)); gap: 1.2rem; }
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
details .scroll { margin: .5rem -.9rem -.9rem; border-width: 1px 0 0; border-radius: 0 0 12px 12px; }
.data { font-size: .82em; }
.data :is(td, th) { padding: .25rem .3rem; white-space: nowrap; }
.data :is(td, th):first-child { padding-left: .9rem; }
.data :is(td, th):last-child { padding-right: .9rem; }
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
      "The <b>mean relative standard error</b> is the root mean square of the pixels' standard errors, each relative "
      "to "
      "the mean radiance around its pixel (in the dark, to half of the mean of the picture). The EXR file of each "
      "picture contains the variance of every pixel. A pixel has an <b>outlier</b> where one sample carries over half "
      "of "
      "its variance; the error is not reliable there. <b>Compare strategies</b> uses small pictures with equal numbers "
      "of "
      "samples; the strategy of the picture is bold. <b>Work</b> is the CPU time for a given error, relative to the "
      "cheapest strategy that finds all light. The <b>mean</b> is the luminance relative to the strategy with the "
      "smallest standard error. Strategy <b>light</b> samples directions to lamps only, and misses other light.";
  return to_html(page);
}

} // namespace carlo

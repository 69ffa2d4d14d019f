#include <picture/render_report.h>
#include <terminal/progress.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

using Seconds = std::chrono::duration<double>;
constexpr double pause = 2, most_share = 0.05; // seconds between pages; share of the time that they take

} // namespace

RenderReport::RenderReport(const std::filesystem::path& folder, std::string scene, std::string command,
                           const render::Crop& part)
    : file_(mc::make_output_folder(folder.string(), "index.html") / "index.html"), page_{.tool = "carlo render",
                                                                                         .title = std::move(scene),
                                                                                         .command = std::move(command),
                                                                                         .pictures = {},
                                                                                         .x = part.x,
                                                                                         .y = part.y} {}

void RenderReport::show(const render::Progress& p) {
  const Clock::time_point begin = Clock::now();
  if (begin < next_ || !p.image) return;
  progress_.fraction = p.fraction;
  const double left = p.fraction > 0 ? p.seconds * (1 / p.fraction - 1) : NAN;
  progress_.text = fmt::format("{:.0f} % in {}{}", 100 * p.fraction, format_seconds(p.seconds),
                               std::isfinite(left) ? ", about " + format_seconds(left) + " remain" : "");
  try {
    write(p.image(), p.seconds, p.error.value);
  } catch (const mc::Error&) {
    // The next page may be possible; finish() reports what is not.
  }
  const Seconds taken = Clock::now() - begin;
  next_ = Clock::now() +
          std::chrono::duration_cast<Clock::duration>(Seconds(std::max(pause, taken.count() * (1 / most_share - 1))));
}

void RenderReport::finish(const render::RenderResult& result) {
  progress_.fraction = 1;
  progress_.is_running = false;
  progress_.text = fmt::format("{} in {}: {:.4g} samples per pixel", result.partial ? "interrupted" : "done",
                               format_seconds(result.seconds), result.spp);
  write(result.image, result.seconds, result.relative_error);
}

void RenderReport::write(const render::Image& image, double seconds, double error) {
  const bool is_new = progress_.errors.empty() || progress_.errors.back().second != error;
  if (std::isfinite(error) && error > 0 && is_new) progress_.errors.emplace_back(seconds, error);
  page_.pictures = {{page_.title, &image}};
  page_.progress = &progress_;
  mc::write_file(file_.string(), to_html(page_));
}

} // namespace carlo

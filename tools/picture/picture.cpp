#include <picture/picture.h>
#include <terminal/columns.h>
#include <terminal/message.h>
#include <terminal/progress.h>
#include <terminal/version.h>

#include <render/integrator/missing_light.h>
#include <render/scene/resolution.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace carlo {

std::string invalid_samples_text(const render::RenderResult& result, const Provenance& from) {
  if (result.invalid == 0) return {};
  const render::InvalidSample& w = result.first_invalid;
  return fmt::format("{} of {} samples are not finite; the first: pixel ({}, {}), pass {}, sample {}, seed {}",
                     result.invalid, result.samples, w.x, w.y, w.pass, w.index, from.seed);
}

std::string interruption_text(const render::RenderResult& result) {
  if (result.missing_rows == 0) return "interrupted before the end";
  const int rows = result.image.height;
  return fmt::format("interrupted in its first pass: {} of {} rows were rendered, the others repeat the nearest",
                     rows - result.missing_rows, rows);
}

std::string build_name() { return fmt::format("{} ({})", version, commit); }

void add_metadata(render::RenderResult& result, const Provenance& from) {
  auto& metadata = result.image.metadata;
  metadata["carlo.scene"] = std::filesystem::path(from.scene).filename().string();
  metadata["carlo.command"] = from.command;
  metadata["carlo.commit"] = build_name();
  metadata["carlo.seed"] = fmt::format("{}", from.seed);
  metadata["carlo.samples_per_pixel"] = fmt::format("{:.17g}", result.spp);
  metadata["carlo.invalid_samples"] = fmt::format("{}", result.invalid);
  if (result.partial) metadata["carlo.partial"] = interruption_text(result);
  if (result.estimates == 0) metadata["carlo.unsampled"] = "some pixels";
}

void warn_if_imprecise(const std::string& path, const render::Scene& scene) {
  if (const auto length = render::length_out_of_range(scene))
    warn("{}: {} {:.3g} across; areas and squared distances in {} are precise from {:.2g} to {:.2g} across only. Its "
         "light may be wrong: scale the scene",
         path, *length < 1 ? "a lamp is" : "the scene is", *length,
         sizeof(render::Float) == sizeof(float) ? "floats" : "doubles", render::min_length, render::max_length);
  const render::FloatResolution c = render::coarsest_resolution(scene);
  if (c.ratio <= render::max_resolution_ratio) return;
  warn("{}: a surface {:.3g} across has coordinates of {:.3g}, which are rounded to multiples of {:.2g}. Its light and "
       "shadow may be wrong: move its parts closer together",
       path, c.size, c.distance, c.step);
}

void warn_about_scene_file(const render::SceneFile& file) {
  for (const std::string& warning : file.warnings) warn("{}", warning);
}

std::string missing_light_text(const render::SceneFile& file, const render::Strategy& strategy, int max_depth) {
  const std::optional<render::MissingLight> missing = missing_light(file.scene, strategy, max_depth);
  if (!missing || file.light_names.empty()) return {};
  const std::string what = fmt::format("light of the {} by way of smooth surfaces, such as the {}, is missing",
                                       file.light_names[missing->light], file.surface_names[missing->surface]);
  if (missing->is_partial)
    return what + " where it is seen in a mirror or through glass; a small lamp in place of the light mends that";
  const bool is_found_by_light_paths =
      missing_light(file.scene, render::strategy_from("mis+lt"), max_depth)->is_partial;
  return what + fmt::format("; {} cannot find it: use {}a small lamp in place of the light", strategy.name,
                            is_found_by_light_paths ? "mis+lt, or " : "");
}

std::string samples_per_second(const render::RenderResult& result) {
  return format_count(double(result.samples) / result.seconds) + "samples/s";
}

std::string format_error(const render::RenderResult& result) {
  if (!std::isfinite(result.relative_error)) {
    if (result.missing_rows > 0) return "unknown";
    return result.estimates < 2 ? "unknown (one sample per pixel)" : "unknown (few light paths reach the picture)";
  }
  if (std::all_of(result.image.pixels.begin(), result.image.pixels.end(), render::is_black))
    return "unknown (the picture is black)";
  return fmt::format("{:.2f} % (worst block {:.2f} %)", 100 * result.relative_error, 100 * result.worst_error);
}

std::string render_summary(const std::string& file, const render::RenderResult& r,
                           const std::optional<double>& target_error) {
  constexpr std::size_t columns = 80, indent = 2;
  std::string text;
  if (r.partial) text += wrapped("PARTIAL: " + interruption_text(r), columns);
  text +=
      fmt::format("{}: {}x{} pixels, {:.4g} sample{} per pixel in {} ({} CPU)\n", file, r.image.width, r.image.height,
                  r.spp, r.spp == 1 ? "" : "s", format_seconds(r.seconds), format_seconds(r.cpu_seconds));
  text += fmt::format("  mean relative standard error {}, {} invalid samples\n", format_error(r), r.invalid);
  text += fmt::format("  {}, {}rays/s", samples_per_second(r), format_count(double(r.rays) / r.seconds));
  if (r.outlier_dominated > 0)
    text += fmt::format("; one sample dominates {:.1f} % of the pixels", 100 * r.outlier_dominated);
  text += "\n";
  if (r.out_of_time)
    text += wrapped(fmt::format("the error of {:g} % was not reached in the time (--resume adds samples)",
                                100 * target_error.value_or(0)),
                    columns, indent);
  return text;
}

} // namespace carlo

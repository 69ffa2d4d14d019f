#include <picture/picture.h>
#include <terminal/progress.h>
#include <terminal/version.h>

#include <render/scene/resolution.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace carlo {

std::string invalid_samples(const ::render::RenderResult& result, const Provenance& from) {
  if (result.invalid == 0) return {};
  const ::render::InvalidSample& w = result.first_invalid;
  return fmt::format("{} of {} samples are not finite; the first: pixel ({}, {}), pass {}, sample {}, seed {}",
                     result.invalid, result.samples, w.x, w.y, w.pass, w.index, from.seed);
}

void sign(::render::RenderResult& result, const Provenance& from) {
  auto& metadata = result.image.metadata;
  metadata["carlo.scene"] = std::filesystem::path(from.scene).filename().string();
  metadata["carlo.command"] = from.command;
  metadata["carlo.commit"] = fmt::format("{} ({})", version, commit);
  metadata["carlo.seed"] = fmt::format("{}", from.seed);
  metadata["carlo.samples_per_pixel"] = fmt::format("{:.17g}", result.spp);
  metadata["carlo.invalid_samples"] = fmt::format("{}", result.invalid);
  if (result.partial) metadata["carlo.partial"] = "interrupted before the end";
  if (result.estimates == 0) metadata["carlo.unsampled"] = "some pixels";
}

void warn_where_coarse(const std::string& path, const ::render::Scene& scene) {
  if (const auto length = ::render::length_out_of_range(scene))
    std::fprintf(stderr,
                 "carlo: warning: %s: %s %.3g across, and %s hold areas and squares of distances from %.2g to %.2g "
                 "across; its light may be wrong. Scale the scene\n",
                 path.c_str(), *length < 1 ? "a lamp is" : "the scene is", *length,
                 sizeof(::render::Float) == sizeof(float) ? "floats" : "doubles", ::render::least_length,
                 ::render::most_length);
  const ::render::Coarseness c = ::render::coarsest(scene);
  if (c.ratio <= ::render::too_coarse) return;
  std::fprintf(
      stderr,
      "carlo: warning: %s: a surface %.3g across has coordinates of %.3g, where the next number is %.2g further; "
      "its light and shadow may be wrong. Bring what lies far apart closer together\n",
      path.c_str(), c.size, c.distance, c.step);
}

void warn_of_departures(const ::render::SceneFile& file) {
  for (const std::string& warning : file.warnings) std::fprintf(stderr, "carlo: warning: %s\n", warning.c_str());
}

std::string samples_per_second(const ::render::RenderResult& result) {
  return format_count(double(result.samples) / result.seconds) + "samples/s";
}

std::string format_error(const ::render::RenderResult& result) {
  if (!std::isfinite(result.relative_error)) return "unknown (one sample per pixel)";
  return fmt::format("{:.2f} % (worst block {:.2f} %)", 100 * result.relative_error, 100 * result.worst_error);
}

} // namespace carlo

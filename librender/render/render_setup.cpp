#include <render/film/film_block.h>
#include <render/film/sampling_plan.h>
#include <render/render_setup.h>

#include <mc/core/error.h>

#include <algorithm>

namespace render {

namespace {

constexpr int point_sets = 2;

bool is_adaptive(const RenderOptions& options) {
  return options.adaptive && (options.seconds || options.target_error || options.spp > pilot_samples);
}

// Sums of each point set, statistics of all samples and counts; and the image with the rates, or adaptive_plan(), which
// do not exist at the same time. A checkpoint takes the sums once more.
double bytes_per_pixel(const RenderOptions& options, bool has_light_paths, bool has_splats) {
  constexpr double bytes_of_set = sizeof(Eigen::Array3d) + sizeof(float), bytes_of_light_sums = sizeof(Eigen::Array3d);
  const double sets = sets_of(options);
  double film = sizeof(SampleStatistics) + sizeof(std::uint64_t) + sets * bytes_of_set;
  if (has_light_paths) film += sizeof(LightSums) + sets * bytes_of_light_sums;
  if (has_splats) film += sets * sizeof(double);
  const double copies = options.checkpoint ? 2 : 1;
  const double image = 2 * sizeof(Spectrum), counts = 2 * sizeof(std::uint32_t);
  return copies * film + counts +
         (is_adaptive(options) ? std::max(image + sizeof(float), double(planning_bytes)) : image);
}

} // namespace

const RenderOptions& checked(const Scene& scene, const RenderOptions& options) {
  mc::require(
      finds_all_lights(scene, options.strategy) || options.aov.kind != Aov::radiance,
      "render: the strategy {} finds lights by chance, which never meets the scene's point or directional light; "
      "use nee or mis",
      options.strategy.name);
  mc::require(options.seconds || options.target_error || options.spp > 0,
              "render: {} samples per pixel; at least 1 is needed", options.spp);
  mc::require(!options.seconds || *options.seconds > 0, "render: a time of {} s; it must be > 0",
              options.seconds.value_or(0));
  mc::require(!options.target_error || *options.target_error > 0, "render: a target error of {}; it must be > 0",
              options.target_error.value_or(0));
  mc::require(!options.tiles.value_or(false) || options.aov.kind == Aov::radiance,
              "render: tiles share radiance, not normals or ambient occlusion; leave out tiles");
  mc::require(!options.tiles.value_or(false) || !scene.has_volumes(),
              "render: tiles share vertices of surfaces, and this scene has media that scatter or have invisible "
              "boundaries; leave out tiles");
  mc::require(options.max_depth == -1 || options.max_depth >= 1, "render: max depth {} must be -1 or at least 1",
              options.max_depth);
  const int branches = options.branches.value_or(1);
  mc::require(branches >= 1 && branches <= max_branches, "render: {} branches of a path; they must be 1 to {}",
              branches, max_branches);
  mc::require(!options.tiles.value_or(false) || !options.branches,
              "render: a tile shares one continuation of each path, which does not split; leave out tiles or branches");
  return options;
}

ImageExtent extent_of(const RenderOptions& options) {
  const Crop c = options.crop.value_or(Crop{0, 0, options.width, options.height});
  mc::require(c.x >= 0 && c.y >= 0 && c.width >= 1 && c.height >= 1 && c.x <= options.width - c.width &&
                  c.y <= options.height - c.height,
              "render: a crop of {}x{} pixels at ({}, {}) is not inside a picture of {}x{}", c.width, c.height, c.x,
              c.y, options.width, options.height);
  return {options.width, options.height, c};
}

int sets_of(const RenderOptions& options) {
  return options.seconds || options.target_error ? point_sets : std::min(options.spp, point_sets);
}

std::uint32_t set_size_of(const RenderOptions& options) {
  const bool known = !options.seconds && !options.target_error && !is_adaptive(options);
  return known ? static_cast<std::uint32_t>((options.spp + point_sets - 1) / point_sets) : 16;
}

std::optional<SplatFilter> splat_filter_for(const Scene& scene, const RenderOptions& options) {
  if (!options.splat || sets_of(options) < 2 || scene.filter().radius() > SplatFilter::max_radius) return {};
  const SplatFilter filter(scene.filter());
  return filter.is_wide() ? std::optional(filter) : std::nullopt;
}

std::optional<LightTracer> light_tracer_for(const Scene& scene, const RenderOptions& options) {
  if (options.aov.kind != Aov::radiance) return {};
  if (options.max_depth >= 0 && options.max_depth < LightTracer::min_edges) return {};
  return LightTracer::create(scene, options.strategy, Float(options.width) / Float(options.height));
}

double film_memory(const Crop& crop, const RenderOptions& options, bool has_light_paths,
                   const std::optional<SplatFilter>& splat) {
  const int side = splat ? 2 * splat->reach() + 1 : 0;
  const double waiting = std::min(double(crop.height), double(mc::max_waiting_results(options.threads)));
  return crop.width * (crop.height * bytes_per_pixel(options, has_light_paths, splat.has_value()) +
                       waiting * FilmBlock::bytes_per_pixel(sets_of(options), side * side));
}

double memory_needed(const Scene& scene, const RenderOptions& options) {
  return film_memory(extent_of(options).crop, options, light_tracer_for(scene, options).has_value(),
                     splat_filter_for(scene, options));
}

} // namespace render

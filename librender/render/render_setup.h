#pragma once
/// What scene and options decide before the first sample of a render.

#include <render/integrator/light_tracer.h>
#include <render/pixel_points.h>
#include <render/render.h>

#include <cstdint>
#include <optional>

namespace render {

constexpr double pilot_samples = 16; ///< Least number of samples per pixel of a pilot.

/// The options, which agree with each other and with the scene.
///   throws : as render().
const RenderOptions& checked(const Scene& scene, const RenderOptions& options);

/// Size and crop of the image.
///   throws : Error for a crop that is not inside the image.
ImageExtent extent_of(const RenderOptions& options);

/// Number of point sets of each pixel.
int sets_of(const RenderOptions& options);

/// Number of points of a stratified set: all points of a pixel's set if their number is known in advance.
std::uint32_t set_size_of(const RenderOptions& options);

/// How pixels share samples. None for a filter so narrow that pixels share nothing, or so wide that splats would take
/// longer than paths; nor for one sample per pixel, whose weights no other point set corrects.
std::optional<SplatFilter> splat_filter_for(const Scene& scene, const RenderOptions& options);

/// The light paths of the strategy, if it has any.
std::optional<LightTracer> light_tracer_for(const Scene& scene, const RenderOptions& options);

/// Memory of the pixels of a crop [bytes]: film, image, copies of a checkpoint, and the finished rows that wait for a
/// row before them.
double film_memory(const Crop& crop, const RenderOptions& options, bool has_light_paths,
                   const std::optional<SplatFilter>& splat);

} // namespace render

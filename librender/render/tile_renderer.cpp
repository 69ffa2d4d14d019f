#include <render/tile_renderer.h>

#include <algorithm>
#include <array>

namespace render {

TileRenderer::AnyIntegrator TileRenderer::integrator_for(const Scene& scene, const PathOptions& path,
                                                         const LightTracer* light_tracer) {
  if (light_tracer) return PathReuseIntegrator<Scene, LightPathMis>(scene, path, LightPathMis(*light_tracer));
  return PathReuseIntegrator<Scene>(scene, path);
}

TileRenderer::TileRenderer(const Scene& scene, const PathOptions& path, const PixelPoints& points,
                           const ImageExtent& extent, const std::optional<SplatFilter>& splat,
                           const LightTracer* light_tracer)
    : scene_(scene), pixel_rays_(scene, extent), integrator_(integrator_for(scene, path, light_tracer)),
      points_(points), extent_(extent), splat_(splat) {}

template <class Stream, class Integrator>
RenderStats TileRenderer::render_row_with(const Integrator& integrator, int y, int column,
                                          std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                                          FilmBlock& block, std::optional<double> weight) const {
  RenderStats stats;
  if (!starts_tile_row(y)) return stats;
  const auto start = [](int at) { return at - place(at); };
  const Crop& crop = extent_.crop;
  const int x = crop.x + column, top = start(crop.y + y), reach = border();
  const PixelSamples none(splat_);
  Tile tile{Pixel{.samples = none}, Pixel{.samples = none}, Pixel{.samples = none}, Pixel{.samples = none}};
  for (int left = start(x); left < x + static_cast<int>(from.size()); left += side) {
    for (int i = 0; i < int(pixels); ++i) {
      Pixel& pixel = tile[std::size_t(i)];
      pixel.x = left + i % side;
      pixel.y = top + i / side;
      pixel.counts = pixel.x >= crop.x - reach && pixel.x < crop.x + crop.width + reach && pixel.y >= crop.y - reach &&
                     pixel.y < crop.y + crop.height + reach;
    }
    const auto first = static_cast<std::size_t>(std::max(left - x, 0));
    render_tile<Stream>(integrator, tile, from[first], to[first], block, weight, stats);
  }
  return stats;
}

template <class Stream, class Integrator>
void TileRenderer::render_tile(const Integrator& integrator, Tile& tile, std::uint32_t from, std::uint32_t to,
                               FilmBlock& block, std::optional<double> weight, RenderStats& stats) const {
  const auto sets = static_cast<std::uint32_t>(block.sets());
  const std::uint64_t rays_before = stats.rays;
  for (std::uint32_t set = 0; set < sets; ++set) {
    points_.for_ranges(set, sets, from, to, [&](const PixelPoints::PointRange& range) {
      render_range<Stream>(integrator, range, tile, stats);
    });
    for (Pixel& pixel : tile)
      if (pixel.counts)
        pixel.samples.end_set(block, pixel.x - extent_.crop.x, pixel.y - extent_.crop.y, static_cast<int>(set), weight);
  }
  const std::uint64_t rays = (stats.rays - rays_before) / pixels;
  for (Pixel& pixel : tile)
    if (pixel.counts) pixel.samples.end_pixel(block, pixel.x - extent_.crop.x, pixel.y - extent_.crop.y, rays);
}

template <class Stream, class Integrator>
void TileRenderer::render_range(const Integrator& integrator, const PixelPoints::PointRange& range, Tile& tile,
                                RenderStats& stats) const {
  const auto points_at = [&](std::size_t i) {
    return points_.point_set<typename Stream::Points>(tile[i].x, tile[i].y, range);
  };
  const std::array<typename Stream::Points, pixels> points{points_at(0), points_at(1), points_at(2), points_at(3)};
  const Filter drawn = splat_ ? BoxFilter() : scene_.filter();
  for (std::uint32_t point = range.begin; point < range.end; ++point) {
    std::array<Vec2, pixels> offsets;
    const auto ray_of = [&](std::size_t i) {
      Stream stream(points[i], point);
      offsets[i] = drawn.sample(stream.next2());
      const Ray ray = pixel_rays_.sample(tile[i].x, tile[i].y, offsets[i], stream);
      return CameraRay<Stream>{ray, pixel_rays_.media(ray), stream};
    };
    std::array<CameraRay<Stream>, pixels> rays{ray_of(0), ray_of(1), ray_of(2), ray_of(3)};
    const auto radiances = integrator.radiances(rays, stats.rays);
    for (std::size_t i = 0; i < pixels; ++i) {
      Pixel& pixel = tile[i];
      if (!pixel.counts) continue;
      ++stats.samples;
      if (!radiances[i].isFinite().all()) [[unlikely]] {
        stats.add({pixel.x, pixel.y, range.pass, point});
        pixel.samples.leave_out();
        continue;
      }
      pixel.samples.add(offsets[i], radiances[i]);
    }
  }
}

// After the definition of the function that it calls: clang 14 does not instantiate functions that only a later lambda
// names.
RenderStats TileRenderer::render_row(int y, int column, std::span<const std::uint32_t> from,
                                     std::span<const std::uint32_t> to, FilmBlock& block,
                                     std::optional<double> weight) const {
  return std::visit(
      [&](const auto& integrator) {
        return with_stream(points_.sampler, [&]<class Stream>(std::type_identity<Stream>) {
          return render_row_with<Stream>(integrator, y, column, from, to, block, weight);
        });
      },
      integrator_);
}

} // namespace render

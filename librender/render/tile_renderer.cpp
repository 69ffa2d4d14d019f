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
                           const ImageExtent& extent, const LightTracer* light_tracer)
    : scene_(scene), pixel_rays_(scene, extent), integrator_(integrator_for(scene, path, light_tracer)),
      points_(points), extent_(extent) {}

template <class Stream, class Integrator>
RenderStats TileRenderer::render_row_with(const Integrator& integrator, int y, int column,
                                          std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                                          FilmBlock& block) const {
  RenderStats stats;
  if (!starts_tile_row(y)) return stats;
  const auto start = [](int at) { return at - at % side; };
  const int x = extent_.crop.x + column, top = start(extent_.crop.y + y);
  for (int left = start(x); left < x + static_cast<int>(from.size()); left += side) {
    const auto first = static_cast<std::size_t>(std::max(left - x, 0));
    render_tile<Stream>(integrator, left, top, from[first], to[first], block, stats);
  }
  return stats;
}

template <class Stream, class Integrator>
void TileRenderer::render_tile(const Integrator& integrator, int left, int top, std::uint32_t from, std::uint32_t to,
                               FilmBlock& block, RenderStats& stats) const {
  std::array<Pixel, pixels> tile;
  for (int i = 0; i < int(pixels); ++i) {
    const int x = left + i % side, y = top + i / side;
    tile[std::size_t(i)] = {x, y, block.contains(x - extent_.crop.x, y - extent_.crop.y)};
  }
  const auto sets = static_cast<std::uint32_t>(block.sets());
  const std::uint64_t rays_before = stats.rays;
  for (std::uint32_t set = 0; set < sets; ++set) {
    points_.for_ranges(set, sets, from, to, [&](const PixelPoints::PointRange& range) {
      render_range<Stream>(integrator, range, tile, stats);
    });
    for (Pixel& pixel : tile) {
      if (pixel.counts)
        block.add(pixel.x - extent_.crop.x, pixel.y - extent_.crop.y, static_cast<int>(set), pixel.sum, pixel.valid);
      pixel.sum.setZero();
      pixel.valid = 0;
    }
  }
  const std::uint64_t rays = (stats.rays - rays_before) / pixels;
  for (const Pixel& pixel : tile)
    if (pixel.counts) block.record_samples(pixel.x - extent_.crop.x, pixel.y - extent_.crop.y, pixel.sums, rays);
}

template <class Stream, class Integrator>
void TileRenderer::render_range(const Integrator& integrator, const PixelPoints::PointRange& range,
                                std::array<Pixel, pixels>& tile, RenderStats& stats) const {
  const auto points_at = [&](std::size_t i) {
    return points_.point_set<typename Stream::Points>(tile[i].x, tile[i].y, range);
  };
  const std::array<typename Stream::Points, pixels> points{points_at(0), points_at(1), points_at(2), points_at(3)};
  for (std::uint32_t point = range.begin; point < range.end; ++point) {
    const auto ray_of = [&](std::size_t i) {
      Stream stream(points[i], point);
      const Vec2 offset = scene_.filter().sample(stream.next2());
      const Ray ray = pixel_rays_.sample(tile[i].x, tile[i].y, offset, stream);
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
        continue;
      }
      const Eigen::Array3d radiance = radiances[i].template cast<double>();
      pixel.sums.add(radiance);
      pixel.sum += radiance;
      ++pixel.valid;
    }
  }
}

// After the definition of the function that it calls: clang 14 does not instantiate functions that only a later lambda
// names.
RenderStats TileRenderer::render_row(int y, int column, std::span<const std::uint32_t> from,
                                     std::span<const std::uint32_t> to, FilmBlock& block) const {
  return std::visit(
      [&](const auto& integrator) {
        return with_stream(points_.sampler, [&]<class Stream>(std::type_identity<Stream>) {
          return render_row_with<Stream>(integrator, y, column, from, to, block);
        });
      },
      integrator_);
}

} // namespace render

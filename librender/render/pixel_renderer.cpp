#include <render/pixel_renderer.h>

#include <tuple>

namespace render {

template Spectrum PathIntegrator<Scene>::Li(const Ray&, mc::IndependentPathStream<Float>&, std::uint64_t&,
                                            const MediumStack&) const;
template Spectrum PathIntegrator<Scene>::Li(const Ray&, mc::StratifiedPathStream<Float>&, std::uint64_t&,
                                            const MediumStack&) const;
template Spectrum PathIntegrator<Scene>::Li(const Ray&, mc::SobolPathStream<Float>&, std::uint64_t&,
                                            const MediumStack&) const;

namespace {

bool is_before(const InvalidSample& a, const InvalidSample& b) {
  return std::tie(a.pass, a.y, a.x, a.index) < std::tie(b.pass, b.y, b.x, b.index);
}

} // namespace

void RenderStats::add(const InvalidSample& sample) {
  if (invalid++ == 0 || is_before(sample, first_invalid)) first_invalid = sample;
}

void RenderStats::merge(const RenderStats& other) {
  samples += other.samples;
  rays += other.rays;
  if (other.invalid > 0 && (invalid == 0 || is_before(other.first_invalid, first_invalid)))
    first_invalid = other.first_invalid;
  invalid += other.invalid;
}

PixelRenderer::AnyIntegrator PixelRenderer::integrator_for(const Scene& scene, const PathOptions& path, const Aov& aov,
                                                           const LightTracer* light_tracer) {
  if (aov.kind != Aov::radiance) return AovIntegrator<Scene>(scene, aov);
  if (light_tracer) return PathIntegrator<Scene, LightPathMis>(scene, path, LightPathMis(*light_tracer));
  return PathIntegrator<Scene>(scene, path);
}

PixelRenderer::PixelRenderer(const Scene& scene, const PathOptions& path, const PixelPoints& points,
                             const ImageExtent& extent, const std::optional<SplatFilter>& splat,
                             const LightTracer* light_tracer, const Aov& aov)
    : scene_(scene), pixel_rays_(scene, extent), integrator_(integrator_for(scene, path, aov, light_tracer)),
      points_(points), extent_(extent), splat_(splat) {}

template <class Stream, class Integrator>
RenderStats PixelRenderer::render_row_with(const Integrator& integrator, int y, int column,
                                           std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                                           FilmBlock& block, std::optional<double> weight) const {
  RenderStats stats;
  PixelSamples pixel(splat_);
  const Filter drawn = splat_ ? BoxFilter() : scene_.filter();
  const int image_y = extent_.crop.y + y;
  const auto sets = static_cast<std::uint32_t>(block.sets());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const int x = column + static_cast<int>(i), image_x = extent_.crop.x + x;
    const std::uint64_t rays_before = stats.rays;
    for (std::uint32_t set = 0; set < sets; ++set) {
      points_.for_ranges(set, sets, from[i], to[i], [&](const PixelPoints::PointRange& range) {
        const auto points = points_.point_set<typename Stream::Points>(image_x, image_y, range);
        for (std::uint32_t point = range.begin; point < range.end; ++point) {
          Stream stream(points, point);
          const Vec2 offset = drawn.sample(stream.next2());
          const Ray ray = pixel_rays_.sample(image_x, image_y, offset, stream);
          const Spectrum radiance = integrator.Li(ray, stream, stats.rays, pixel_rays_.media(ray));
          ++stats.samples;
          if (!radiance.isFinite().all()) [[unlikely]] {
            stats.add({image_x, image_y, range.pass, point});
            pixel.leave_out();
            continue;
          }
          pixel.add(offset, radiance);
        }
      });
      pixel.end_set(block, x, y, static_cast<int>(set), weight);
    }
    pixel.end_pixel(block, x, y, stats.rays - rays_before);
  }
  return stats;
}

// After the definition of the function that it calls: clang 14 does not instantiate functions that only a later lambda
// names.
RenderStats PixelRenderer::render_row(int y, int column, std::span<const std::uint32_t> from,
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

#include <render/light_tracing_pass.h>

#include <mc/table/discrete.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace render {

namespace {

// largest number of pixels under the filter along one axis
constexpr std::size_t most_pixels = 2 * static_cast<std::size_t>(SplatFilter::max_radius) + 1;
constexpr std::uint64_t apart = 0x6c69676874; // separates these random numbers from the numbers of the pixels

} // namespace

LightTracingPass::LightTracingPass(const Scene& scene, const LightTracer& light_tracer, int max_depth,
                                   PixelSampler sampler, std::uint64_t seed, const ImageExtent& extent)
    : light_tracer_(light_tracer), filter_(scene.filter()), max_depth_(max_depth), seed_(mc::hash(seed, apart)),
      run_length_(sampler == PixelSampler::stratified ? 4096 : std::uint64_t{1} << 31), extent_(extent),
      trace_(trace_for(sampler)) {}

std::uint64_t LightTracingPass::path_count(double mean) const {
  constexpr double least = 16; // so that every point set of an image with few samples has light paths
  return static_cast<std::uint64_t>(std::llround(std::max(least, mean * per_sample())));
}

LightTracingPass::PixelChoice LightTracingPass::sample_pixel(double at, Float u, std::vector<double>& profile) const {
  const double here = std::floor(at);
  filter_.profile(at - here - 0.5, profile);
  const double sum = std::accumulate(profile.begin(), profile.end(), 0.0);
  if (!(sum > 0)) return {0, 0}; // the filter is narrower than a pixel, and the point lies between pixels
  const mc::ShortDiscrete<double, most_pixels> share(profile);
  const auto chosen = static_cast<int>(share.sample_index(double(u)).index);
  return {static_cast<int>(here) + chosen - filter_.reach(), sum};
}

template <class Stream>
RenderStats LightTracingPass::trace_with(std::uint64_t from, std::uint64_t to, FilmBlock& block) const {
  RenderStats stats;
  const auto sets = static_cast<std::uint32_t>(block.sets());
  std::vector<double> profile(filter_.side());
  const double reach = filter_.reach();
  for (std::uint32_t set = 0; set < sets; ++set) {
    std::uint64_t point = (from + sets - 1 - set) / sets;
    const std::uint64_t end = (to + sets - 1 - set) / sets;
    while (point < end) {
      const std::uint64_t run = point / run_length_, stop = std::min(end, (run + 1) * run_length_);
      const typename Stream::Points points(mc::hash(seed_, set, run), static_cast<std::uint32_t>(run_length_));
      for (; point < stop; ++point) {
        const auto index = static_cast<std::uint32_t>(point - run * run_length_);
        Stream stream(points, index);
        light_tracer_.trace(stream, max_depth_, stats.rays, [&](const Vec2& s, const Spectrum& value) {
          const double x = double(s[0]) * extent_.width, y = double(s[1]) * extent_.height;
          if (!(x >= -reach && x < extent_.width + reach && y >= -reach && y < extent_.height + reach))
            return block.add_unseen_light(value);
          const Vec2 u = stream.next2();
          const PixelChoice column = sample_pixel(x, u[0], profile), row = sample_pixel(y, u[1], profile);
          const Spectrum weighed = value * Float(column.weight * row.weight);
          if (!value.isFinite().all()) [[unlikely]]
            stats.add({column.pixel, row.pixel, set, index});
          else if (const int i = column.pixel - extent_.crop.x, j = row.pixel - extent_.crop.y; block.contains(i, j))
            block.add_light_splat(i, j, static_cast<int>(set), weighed);
          else block.add_unseen_light(weighed);
        });
      }
    }
  }
  block.add_light_rays(stats.rays);
  return stats;
}

void LightTracingPass::count_paths(std::uint64_t from, std::uint64_t to, Film& film) const {
  const auto sets = static_cast<std::uint32_t>(film.sets());
  for (std::uint32_t set = 0; set < sets; ++set) {
    const std::uint64_t paths = (to + sets - 1 - set) / sets - (from + sets - 1 - set) / sets;
    film.add_light_path_count(static_cast<int>(set), double(paths) / per_sample());
  }
}

// After the definition of the functions that it names: clang 14 does not instantiate functions that only a later lambda
// names.
LightTracingPass::Trace LightTracingPass::trace_for(PixelSampler sampler) {
  return with_stream(
      sampler, []<class Stream>(std::type_identity<Stream>) -> Trace { return &LightTracingPass::trace_with<Stream>; });
}

} // namespace render

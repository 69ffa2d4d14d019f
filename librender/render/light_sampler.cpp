#include <render/light_sampler.h>

#include <mc/core/parallel.h>
#include <mc/table/discrete.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace render {

namespace {

constexpr std::uint64_t block = 1024; // paths that one thread takes at a time
constexpr std::size_t most_pixels = 2 * static_cast<std::size_t>(SplatFilter::furthest) + 1; // along one axis
constexpr std::uint64_t apart = 0x6c69676874; // from the numbers of the pixels

} // namespace

LightTaker::LightTaker(const Scene& scene, const LightPaths& light_paths, int max_depth, PixelSampler sampler,
                       std::uint64_t seed, const Whole& whole)
    : light_paths_(light_paths), filter_(scene.filter()), max_depth_(max_depth), seed_(mc::hash(seed, apart)),
      run_length_(sampler == PixelSampler::stratified ? 4096 : std::uint64_t{1} << 31), whole_(whole),
      trace_(trace_of(sampler)) {}

std::uint64_t LightTaker::paths(double mean) const {
  constexpr double least = 16; // so that no point set of a picture of few samples goes without
  return static_cast<std::uint64_t>(std::llround(std::max(least, mean * per_sample())));
}

LightTaker::Choice LightTaker::pixel(double at, Float u, std::vector<double>& profile) const {
  const double here = std::floor(at);
  filter_.profile(at - here - 0.5, profile);
  const double sum = std::accumulate(profile.begin(), profile.end(), 0.0);
  if (!(sum > 0)) return {0, 0}; // between pixels, by a filter that is narrower than they are
  const mc::ShortDiscrete<double, most_pixels> share(profile);
  const auto chosen = static_cast<int>(share.sample_index(double(u)).index);
  return {static_cast<int>(here) + chosen - filter_.reach(), sum};
}

template <class Stream>
void LightTaker::trace(std::uint64_t from, std::uint64_t to, std::uint32_t sets, Splashes& splashes) const {
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
        light_paths_.trace(stream, max_depth_, splashes.tally.rays, [&](const Vec2& s, const Spectrum& value) {
          const double x = double(s[0]) * whole_.width, y = double(s[1]) * whole_.height;
          if (!(x >= -reach && x < whole_.width + reach && y >= -reach && y < whole_.height + reach)) return;
          const Vec2 u = stream.next2();
          const Choice column = pixel(x, u[0], profile), row = pixel(y, u[1], profile);
          const Spectrum weighed = value * Float(column.weight * row.weight);
          if (!value.isFinite().all()) [[unlikely]]
            splashes.tally.add({column.pixel, row.pixel, set, index});
          else splashes.add(whole_.part, column.pixel, row.pixel, static_cast<int>(set), weighed);
        });
      }
    }
  }
}

std::uint64_t LightTaker::take(std::uint64_t from, std::uint64_t to, int threads, const std::function<bool()>& stop,
                               Film& film, Tally& tally) const {
  const auto sets = static_cast<std::uint32_t>(film.sets());
  while (from < to && !stop()) {
    const std::uint64_t end = std::min(to, from + at_once);
    std::vector<Splashes> found((end - from + block - 1) / block);
    mc::parallel_for(found.size(), threads, [&](std::size_t i) {
      const std::uint64_t first = from + i * block;
      (this->*trace_)(first, std::min(end, first + block), sets, found[i]);
    });
    for (const Splashes& splashes : found) {
      for (const auto& [x, y, set, value] : splashes.all) film.add_light(x, y, set, value.cast<double>());
      film.note_light(splashes.tally.rays);
      tally.merge(splashes.tally);
    }
    for (std::uint32_t set = 0; set < sets; ++set) {
      const std::uint64_t paths = (end + sets - 1 - set) / sets - (from + sets - 1 - set) / sets;
      film.count_light(static_cast<int>(set), double(paths) / per_sample());
    }
    from = end;
  }
  return from;
}

// Behind what it names: clang 14 does not make functions that only such a lambda names before they are defined.
LightTaker::Trace LightTaker::trace_of(PixelSampler sampler) {
  return with_stream(sampler,
                     []<class Stream>(std::type_identity<Stream>) -> Trace { return &LightTaker::trace<Stream>; });
}

} // namespace render

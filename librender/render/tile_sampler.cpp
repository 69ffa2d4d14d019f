#include <render/tile_sampler.h>

#include <algorithm>
#include <array>

namespace render {

TileTaker::TileTaker(const Scene& scene, const PathOptions& path, const PixelPoints& points, const Whole& whole,
                     const LightPaths* light_paths)
    : scene_(scene), pixel_rays_(scene, whole), integrator_(scene, path, light_paths), points_(points), whole_(whole),
      take_(take_of(points.sampler)) {}

TileTaker::Take TileTaker::take_of(PixelSampler sampler) {
  switch (sampler) {
  case PixelSampler::independent: return &TileTaker::take_by<mc::IndependentWalk<Float>>;
  case PixelSampler::stratified: return &TileTaker::take_by<mc::StratifiedWalk<Float>>;
  case PixelSampler::sobol: return &TileTaker::take_by<mc::SobolWalk<Float>>;
  }
  return nullptr;
}

template <class Stream>
Tally TileTaker::take_by(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                         Film& film) const {
  Tally tally;
  if (!begins(y)) return tally;
  const auto start = [](int at) { return at - at % side; };
  const int x = whole_.part.x, top = start(whole_.part.y + y);
  for (int left = start(x); left < x + whole_.part.width; left += side) {
    const auto first = static_cast<std::size_t>(std::max(left - x, 0));
    take_tile<Stream>(left, top, from[first], to[first], film, tally);
  }
  return tally;
}

template <class Stream>
void TileTaker::take_tile(int left, int top, std::uint32_t from, std::uint32_t to, Film& film, Tally& tally) const {
  /// A pixel of the tile.
  struct Pixel {
    int whole_x, whole_y, x, y; ///< in the picture, in the film
    bool counts;                ///< it is one of the film's
    SampleSums seen = {};
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    std::uint32_t valid = 0;
  };
  std::array<Pixel, pixels> tile;
  for (int i = 0; i < int(pixels); ++i) {
    const int whole_x = left + i % side, whole_y = top + i / side, x = whole_x - whole_.part.x,
              y = whole_y - whole_.part.y;
    tile[std::size_t(i)] = {whole_x, whole_y, x, y, film.contains(x, y)};
  }
  const auto sets = static_cast<std::uint32_t>(film.sets());
  const std::uint64_t rays_before = tally.rays;
  for (std::uint32_t set = 0; set < sets; ++set) {
    for (Pixel& pixel : tile) {
      pixel.sum.setZero();
      pixel.valid = 0;
    }
    points_.for_runs(set, sets, from, to, [&](const PixelPoints::Run& run) {
      const auto points_at = [&](std::size_t i) {
        return points_.of<typename Stream::Points>(tile[i].whole_x, tile[i].whole_y, run);
      };
      const std::array<typename Stream::Points, pixels> points{points_at(0), points_at(1), points_at(2), points_at(3)};
      for (std::uint32_t point = run.begin; point < run.end; ++point) {
        const auto ray_of = [&](std::size_t i) {
          Stream stream(points[i], point);
          const Vec2 offset = scene_.filter().sample(stream.next2());
          const Ray ray = pixel_rays_.sample(tile[i].whole_x, tile[i].whole_y, offset, stream);
          return TileRay<Stream>{ray, pixel_rays_.around(ray), stream};
        };
        std::array<TileRay<Stream>, pixels> rays{ray_of(0), ray_of(1), ray_of(2), ray_of(3)};
        const auto radiances = integrator_.radiances(rays, tally.rays);
        for (std::size_t i = 0; i < pixels; ++i) {
          if (!tile[i].counts) continue;
          ++tally.samples;
          if (!radiances[i].isFinite().all()) [[unlikely]] {
            tally.add({tile[i].whole_x, tile[i].whole_y, run.pass, point});
            continue;
          }
          tile[i].seen.add(radiances[i].template cast<double>());
          tile[i].sum += radiances[i].template cast<double>();
          ++tile[i].valid;
        }
      }
    });
    for (const Pixel& pixel : tile)
      if (pixel.counts) film.add(pixel.x, pixel.y, static_cast<int>(set), pixel.sum, pixel.valid);
  }
  for (const Pixel& pixel : tile)
    if (pixel.counts) film.note(pixel.x, pixel.y, pixel.seen, (tally.rays - rays_before) / pixels);
}

} // namespace render

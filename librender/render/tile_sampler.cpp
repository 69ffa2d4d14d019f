#include <render/tile_sampler.h>

#include <algorithm>
#include <array>

namespace render {

TileTaker::TileTaker(const Scene& scene, const PathOptions& path, const PixelPoints& points, const Whole& whole,
                     const LightPaths* light_paths)
    : scene_(scene), pixel_rays_(scene, whole), integrator_(scene, path, light_paths), points_(points), whole_(whole),
      take_(take_of(points.sampler)) {}

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
  std::array<Pixel, pixels> tile;
  for (int i = 0; i < int(pixels); ++i) {
    const int x = left + i % side, y = top + i / side;
    tile[std::size_t(i)] = {x, y, film.contains(x - whole_.part.x, y - whole_.part.y)};
  }
  const auto sets = static_cast<std::uint32_t>(film.sets());
  const std::uint64_t rays_before = tally.rays;
  for (std::uint32_t set = 0; set < sets; ++set) {
    points_.for_runs(set, sets, from, to, [&](const PixelPoints::Run& run) { take_run<Stream>(run, tile, tally); });
    for (Pixel& pixel : tile) {
      if (pixel.counts)
        film.add(pixel.x - whole_.part.x, pixel.y - whole_.part.y, static_cast<int>(set), pixel.sum, pixel.valid);
      pixel.sum.setZero();
      pixel.valid = 0;
    }
  }
  const std::uint64_t rays = (tally.rays - rays_before) / pixels;
  for (const Pixel& pixel : tile)
    if (pixel.counts) film.note(pixel.x - whole_.part.x, pixel.y - whole_.part.y, pixel.seen, rays);
}

template <class Stream>
void TileTaker::take_run(const PixelPoints::Run& run, std::array<Pixel, pixels>& tile, Tally& tally) const {
  const auto points_at = [&](std::size_t i) { return points_.of<typename Stream::Points>(tile[i].x, tile[i].y, run); };
  const std::array<typename Stream::Points, pixels> points{points_at(0), points_at(1), points_at(2), points_at(3)};
  for (std::uint32_t point = run.begin; point < run.end; ++point) {
    const auto ray_of = [&](std::size_t i) {
      Stream stream(points[i], point);
      const Vec2 offset = scene_.filter().sample(stream.next2());
      const Ray ray = pixel_rays_.sample(tile[i].x, tile[i].y, offset, stream);
      return TileRay<Stream>{ray, pixel_rays_.around(ray), stream};
    };
    std::array<TileRay<Stream>, pixels> rays{ray_of(0), ray_of(1), ray_of(2), ray_of(3)};
    const auto radiances = integrator_.radiances(rays, tally.rays);
    for (std::size_t i = 0; i < pixels; ++i) {
      Pixel& pixel = tile[i];
      if (!pixel.counts) continue;
      ++tally.samples;
      if (!radiances[i].isFinite().all()) [[unlikely]] {
        tally.add({pixel.x, pixel.y, run.pass, point});
        continue;
      }
      const Eigen::Array3d radiance = radiances[i].template cast<double>();
      pixel.seen.add(radiance);
      pixel.sum += radiance;
      ++pixel.valid;
    }
  }
}

// Behind what it names: clang 14 does not make functions that only such a lambda names before they are defined.
TileTaker::Take TileTaker::take_of(PixelSampler sampler) {
  return with_stream(sampler,
                     []<class Stream>(std::type_identity<Stream>) -> Take { return &TileTaker::take_by<Stream>; });
}

} // namespace render

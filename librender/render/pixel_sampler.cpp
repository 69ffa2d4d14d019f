#include <render/pixel_sampler.h>

#include <tuple>

namespace render {

template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::IndependentWalk<Float>&, std::uint64_t&,
                                                  const Media&) const;
template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::StratifiedWalk<Float>&, std::uint64_t&,
                                                  const Media&) const;
template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::SobolWalk<Float>&, std::uint64_t&,
                                                  const Media&) const;

namespace {

bool is_before(const InvalidSample& a, const InvalidSample& b) {
  return std::tie(a.pass, a.y, a.x, a.index) < std::tie(b.pass, b.y, b.x, b.index);
}

} // namespace

void Tally::add(const InvalidSample& sample) {
  if (invalid++ == 0 || is_before(sample, first)) first = sample;
}

void Tally::merge(const Tally& other) {
  samples += other.samples;
  rays += other.rays;
  if (other.invalid > 0 && (invalid == 0 || is_before(other.first, first))) first = other.first;
  invalid += other.invalid;
}

SampleTaker::SampleTaker(const Scene& scene, const PathOptions& path, const PixelPoints& points, const Whole& whole,
                         const std::optional<SplatFilter>& splat, const LightPaths* light_paths)
    : scene_(scene), pixel_rays_(scene, whole), integrator_(scene, path, light_paths), points_(points), whole_(whole),
      splat_(splat), take_(take_of(points.sampler)) {}

template <class Stream>
Tally SampleTaker::take_by(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                           Film& film) const {
  Tally tally;
  std::optional<Splat> splat;
  if (splat_) splat.emplace(*splat_);
  const Filter drawn = splat_ ? BoxFilter() : scene_.filter();
  const int whole_y = whole_.part.y + y;
  const auto sets = static_cast<std::uint32_t>(film.sets());
  for (std::size_t column = 0; column < from.size(); ++column) {
    const int x = static_cast<int>(column) - border(), whole_x = whole_.part.x + x;
    const std::uint64_t rays_before = tally.rays;
    SampleSums seen;
    for (std::uint32_t set = 0; set < sets; ++set) {
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      std::uint32_t valid = 0;
      points_.for_runs(set, sets, from[column], to[column], [&](const PixelPoints::Run& run) {
        const auto points = points_.of<typename Stream::Points>(whole_x, whole_y, run);
        for (std::uint32_t point = run.begin; point < run.end; ++point) {
          Stream stream(points, point);
          const Vec2 offset = drawn.sample(stream.next2());
          const Ray ray = pixel_rays_.sample(whole_x, whole_y, offset, stream);
          const Spectrum radiance = integrator_.radiance(ray, stream, tally.rays, pixel_rays_.around(ray));
          ++tally.samples;
          if (!radiance.isFinite().all()) [[unlikely]] {
            tally.add({whole_x, whole_y, run.pass, point});
            continue;
          }
          seen.add(radiance.cast<double>());
          if (splat) splat->add(offset, radiance);
          else sum += radiance.cast<double>();
          ++valid;
        }
      });
      if (splat) splat->give(film, x, y, static_cast<int>(set));
      if (film.contains(x, y)) film.add(x, y, static_cast<int>(set), sum, valid);
    }
    film.note(x, y, seen, tally.rays - rays_before);
  }
  return tally;
}

// Behind what it names: clang 14 does not make functions that only such a lambda names before they are defined.
SampleTaker::Take SampleTaker::take_of(PixelSampler sampler) {
  return with_stream(sampler,
                     []<class Stream>(std::type_identity<Stream>) -> Take { return &SampleTaker::take_by<Stream>; });
}

} // namespace render

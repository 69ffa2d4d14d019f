#include <render/pixel_sampler.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <array>
#include <tuple>

namespace render {

template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::IndependentWalk<Float>&, std::uint64_t&,
                                                  const Media&) const;
template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::StratifiedWalk<Float>&, std::uint64_t&,
                                                  const Media&) const;
template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::SobolWalk<Float>&, std::uint64_t&,
                                                  const Media&) const;

namespace {

constexpr std::array<std::string_view, 3> sampler_names = {"independent", "stratified", "sobol"};

bool is_before(const InvalidSample& a, const InvalidSample& b) {
  return std::tie(a.pass, a.y, a.x, a.index) < std::tie(b.pass, b.y, b.x, b.index);
}

} // namespace

PixelSampler sampler_from(std::string_view word) {
  return static_cast<PixelSampler>(mc::index_of("sampler", word, sampler_names));
}

std::string_view name(PixelSampler sampler) { return sampler_names[static_cast<std::size_t>(sampler)]; }

void Tally::add(const InvalidSample& sample) {
  if (invalid++ == 0 || is_before(sample, first)) first = sample;
}

void Tally::merge(const Tally& other) {
  samples += other.samples;
  rays += other.rays;
  if (other.invalid > 0 && (invalid == 0 || is_before(other.first, first))) first = other.first;
  invalid += other.invalid;
}

SampleTaker::SampleTaker(const Scene& scene, const PathOptions& path, PixelSampler sampler, std::uint64_t seed,
                         std::uint32_t stratum, const Whole& whole, const std::optional<SplatFilter>& splat,
                         const LightPaths* light_paths)
    : scene_(scene), around_(media_at(scene, {scene.camera().origin(), scene.camera().forward()})),
      around_varies_(absorbs(scene) && (scene.camera().radius() > 0 || scene.camera().near() > 0)),
      integrator_(scene, path, light_paths), seed_(seed),
      stratum_(sampler == PixelSampler::stratified ? stratum : 1u << 31), whole_(whole), splat_(splat),
      take_(take_of(sampler)) {}

SampleTaker::Take SampleTaker::take_of(PixelSampler sampler) {
  switch (sampler) {
  case PixelSampler::independent: return &SampleTaker::take_by<mc::IndependentWalk<Float>>;
  case PixelSampler::stratified: return &SampleTaker::take_by<mc::StratifiedWalk<Float>>;
  case PixelSampler::sobol: return &SampleTaker::take_by<mc::SobolWalk<Float>>;
  }
  return nullptr;
}

template <class Stream>
Tally SampleTaker::take_by(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                           Film& film) const {
  Tally tally;
  const ThinLens& camera = scene_.camera();
  const Vec2 scale(1 / Float(whole_.width), 1 / Float(whole_.height));
  const Vec2 tan_half = camera.tan_half(Float(whole_.width) / Float(whole_.height));
  std::optional<Splat> splat;
  if (splat_) splat.emplace(*splat_);
  const Filter drawn = splat_ ? BoxFilter() : scene_.filter();
  const int whole_y = whole_.part.y + y;
  const auto sets = static_cast<std::uint32_t>(film.sets());
  for (std::size_t column = 0; column < from.size(); ++column) {
    const std::uint32_t first = from[column], last = to[column];
    const int x = static_cast<int>(column) - border(), whole_x = whole_.part.x + x;
    const std::uint64_t pixel = std::uint64_t(std::uint32_t(whole_y)) << 32 | std::uint32_t(whole_x);
    const std::uint64_t rays_before = tally.rays;
    SampleSums seen;
    for (std::uint32_t set = 0; set < sets; ++set) {
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      std::uint32_t valid = 0, point = (first + sets - 1 - set) / sets;
      const std::uint32_t end = (last + sets - 1 - set) / sets;
      while (point < end) {
        const std::uint32_t block = point / stratum_, pass = set + sets * block;
        const std::uint32_t stop = std::min(end, (block + 1) * stratum_);
        const typename Stream::Points points(mc::hash(seed_, pixel, pass), stratum_);
        for (; point < stop; ++point) {
          Stream stream(points, point - block * stratum_);
          const Vec2 offset = drawn.sample(stream.next2());
          const Vec2 s = (Vec2(Float(whole_x) + Float(0.5), Float(whole_y) + Float(0.5)) + offset).cwiseProduct(scale);
          const Ray ray = camera.ray(s, tan_half, camera.radius() > 0 ? stream.next2() : Vec2(Vec2::Zero()));
          const Spectrum radiance = integrator_.radiance(ray, stream, tally.rays, around(ray));
          ++tally.samples;
          if (!radiance.isFinite().all()) [[unlikely]] {
            tally.add({whole_x, whole_y, pass, point - block * stratum_});
            continue;
          }
          seen.add(radiance.cast<double>());
          if (splat) splat->add(offset, radiance);
          else sum += radiance.cast<double>();
          ++valid;
        }
      }
      if (splat) splat->give(film, x, y, static_cast<int>(set));
      if (film.contains(x, y)) film.add(x, y, static_cast<int>(set), sum, valid);
    }
    film.note(x, y, seen, tally.rays - rays_before);
  }
  return tally;
}

} // namespace render

#include <render/render.h>

#include <mc/core/error.h>
#include <mc/core/parallel.h>
#include <mc/core/text.h>
#include <mc/sampler/walk_stream.h>

#include <array>
#include <chrono>
#include <ctime>

namespace render {

namespace {

constexpr std::array<std::string_view, 3> sampler_names = {"independent", "stratified", "sobol"};

struct Tally {
  std::uint64_t samples = 0, rays = 0, invalid = 0;
  InvalidSample first;
  void merge(const Tally& other) {
    samples += other.samples;
    rays += other.rays;
    if (invalid == 0) first = other.first;
    invalid += other.invalid;
  }
};

struct Pass {
  std::uint32_t number, count; ///< count: points per pixel
  bool separate;               ///< every sample is an estimate of its own
};

template <class Stream>
Tally render_row(const Scene& scene, const PathIntegrator<Scene>& integrator, std::uint64_t seed, const Pass& pass,
                 int y, Film& film) {
  Tally tally;
  const ThinLens& camera = scene.camera();
  const Vec2 scale(1 / Float(film.width()), 1 / Float(film.height()));
  const Vec2 tan_half = camera.tan_half(Float(film.width()) / Float(film.height()));
  for (int x = 0; x < film.width(); ++x) {
    const std::uint64_t key =
        mc::hash(seed, static_cast<std::uint64_t>(y) << 32 | static_cast<std::uint64_t>(x), pass.number);
    const typename Stream::Points points(key, pass.count);
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    std::uint32_t valid = 0;
    for (std::uint32_t i = 0; i < pass.count; ++i) {
      Stream stream(points, i);
      const Vec2 offset = scene.filter().sample(stream.next2());
      const Vec2 s = (Vec2(Float(x) + Float(0.5), Float(y) + Float(0.5)) + offset).cwiseProduct(scale);
      const Ray ray = camera.ray(s, tan_half, camera.radius() > 0 ? stream.next2() : Vec2(Vec2::Zero()));
      const Spectrum radiance = integrator.radiance(ray, stream, tally.rays);
      ++tally.samples;
      if (!radiance.isFinite().all()) [[unlikely]] {
        if (tally.invalid++ == 0) tally.first = {x, y, pass.number, i};
        continue;
      }
      if (pass.separate) film.add(x, y, radiance.cast<double>());
      sum += radiance.cast<double>();
      ++valid;
    }
    if (!pass.separate && valid > 0) film.add(x, y, sum / double(valid));
  }
  return tally;
}

using RowFunction = Tally (*)(const Scene&, const PathIntegrator<Scene>&, std::uint64_t, const Pass&, int, Film&);

RowFunction row_function(PixelSampler sampler) {
  switch (sampler) {
  case PixelSampler::independent: return render_row<mc::IndependentWalk<Float>>;
  case PixelSampler::stratified: return render_row<mc::StratifiedWalk<Float>>;
  case PixelSampler::sobol: return render_row<mc::SobolWalk<Float>>;
  }
  return nullptr;
}

// Passes for a fixed sample count: between 4 and 8 where spp allows it, so that the variance has some degrees of
// freedom and the point sets stay long.
std::uint32_t passes_for(std::uint32_t spp) {
  for (const std::uint32_t passes : {4u, 8u, 6u, 5u, 7u, 3u, 2u})
    if (spp % passes == 0) return passes;
  return spp;
}

} // namespace

PixelSampler sampler_from(std::string_view word) {
  for (std::size_t i = 0; i < sampler_names.size(); ++i)
    if (sampler_names[i] == word) return static_cast<PixelSampler>(i);
  throw mc::Error(fmt::format("unknown sampler '{}'{}; use one of {}", word, mc::did_you_mean(word, sampler_names),
                              fmt::join(sampler_names, ", ")));
}

std::string_view name(PixelSampler sampler) { return sampler_names[static_cast<std::size_t>(sampler)]; }

RenderResult render(const Scene& scene, const RenderOptions& options) {
  const int width = options.width, height = options.height;
  const bool open_ended = options.seconds || options.target_error;
  mc::require(open_ended || options.spp > 0, "render: {} samples per pixel; at least 1 is needed", options.spp);
  mc::require(!options.seconds || *options.seconds > 0, "render: a time of {} s; it must be > 0",
              options.seconds.value_or(0));
  mc::require(!options.target_error || *options.target_error > 0, "render: a target error of {}; it must be > 0",
              options.target_error.value_or(0));

  mc::require(options.max_depth == -1 || options.max_depth >= 1, "render: max depth {} must be -1 or at least 1",
              options.max_depth);
  const PathIntegrator<Scene> integrator(scene, {options.strategy, options.max_depth});
  const RowFunction render_one = row_function(options.sampler);
  const bool separate = options.sampler == PixelSampler::independent;
  const std::uint32_t passes = open_ended ? ~0u : passes_for(static_cast<std::uint32_t>(options.spp));
  const std::uint32_t count = open_ended ? 16 : static_cast<std::uint32_t>(options.spp) / passes;

  Film film(width, height);
  RenderResult result;
  Tally total;
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const auto cancelled = [&] { return options.cancel && options.cancel->load(std::memory_order_relaxed); };

  std::uint32_t done = 0; // whole passes
  bool complete = false;
  double error = mc::infinity<double>;
  while (!complete && !cancelled()) {
    const Pass pass{done, count, separate};
    std::vector<Tally> rows(static_cast<std::size_t>(height));
    std::atomic<std::uint64_t> rows_done = 0;
    mc::parallel_for(rows.size(), options.threads, [&](std::size_t y) {
      if (cancelled()) return;
      rows[y] = render_one(scene, integrator, options.seed, pass, static_cast<int>(y), film);
      ++rows_done;
      if (!options.progress) return;
      const double within = double(rows_done) / double(height), now = elapsed();
      const double fraction = options.seconds ? now / *options.seconds
                              : options.target_error
                                  ? (std::isfinite(error) ? mc::sqr(*options.target_error / error) : 0.0)
                                  : (done + within) / passes;
      options.progress(
          {fraction, total.samples + rows_done * static_cast<std::uint64_t>(width) * count, total.rays, now, error});
    });
    for (const Tally& row : rows) total.merge(row);
    error = film.relative_error();
    if (rows_done < rows.size()) break;
    ++done;
    complete = done == passes || (options.seconds && elapsed() >= *options.seconds) ||
               (options.target_error && done >= 4 && error <= *options.target_error);
  }

  result.image = film.image();
  result.samples = total.samples;
  result.rays = total.rays;
  result.spp = double(total.samples) / (double(width) * double(height));
  result.estimates = result.image.estimates = separate ? done * count : done;
  result.seconds = elapsed();
  result.cpu_seconds = double(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  result.relative_error = error;
  result.invalid = total.invalid;
  result.first_invalid = total.first;
  result.partial = !complete;
  return result;
}

} // namespace render

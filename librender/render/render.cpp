#include <render/render.h>

#include <mc/core/error.h>
#include <mc/core/parallel.h>
#include <mc/core/text.h>
#include <mc/sampler/walk_stream.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <span>
#include <tuple>

namespace render {

namespace {

constexpr std::array<std::string_view, 3> sampler_names = {"independent", "stratified", "sobol"};

bool is_before(const InvalidSample& a, const InvalidSample& b) {
  return std::tie(a.pass, a.y, a.x, a.index) < std::tie(b.pass, b.y, b.x, b.index);
}

struct Tally {
  std::uint64_t samples = 0, rays = 0, invalid = 0;
  InvalidSample first;
  void add(const InvalidSample& sample) {
    if (invalid++ == 0 || is_before(sample, first)) first = sample;
  }
  void merge(const Tally& other) {
    samples += other.samples;
    rays += other.rays;
    if (other.invalid > 0 && (invalid == 0 || is_before(other.first, first))) first = other.first;
    invalid += other.invalid;
  }
};

/// A randomised point set of every pixel, and which of its points are due.
struct Pass {
  std::uint32_t number, count; ///< count: points per pixel
  std::uint32_t begin, end;
  bool separate; ///< every sample is an estimate of its own
};

/// The picture that a film shows the part of.
struct Whole {
  int width, height;
  Crop part;
};

/// The sum of a pixel's samples of one pass.
struct PassSum {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  std::uint32_t valid = 0;
};

// Adds the samples that are due in the row y of the film to `sums`, one for each of its pixels, or where they are
// separate to the film.
template <class Stream>
Tally render_row(const Scene& scene, const PathIntegrator<Scene>& integrator, std::uint64_t seed, const Pass& pass,
                 const Whole& whole, int y, Film& film, std::span<PassSum> sums) {
  Tally tally;
  const ThinLens& camera = scene.camera();
  const Vec2 scale(1 / Float(whole.width), 1 / Float(whole.height));
  const Vec2 tan_half = camera.tan_half(Float(whole.width) / Float(whole.height));
  const int whole_y = whole.part.y + y;
  for (int x = 0; x < film.width(); ++x) {
    const int whole_x = whole.part.x + x;
    const std::uint64_t key =
        mc::hash(seed, static_cast<std::uint64_t>(whole_y) << 32 | static_cast<std::uint64_t>(whole_x), pass.number);
    const typename Stream::Points points(key, pass.count);
    PassSum own;
    PassSum& pixel = pass.separate ? own : sums[static_cast<std::size_t>(x)];
    SampleSums luminances;
    for (std::uint32_t i = pass.begin; i < pass.end; ++i) {
      Stream stream(points, i);
      const Vec2 offset = scene.filter().sample(stream.next2());
      const Vec2 s = (Vec2(Float(whole_x) + Float(0.5), Float(whole_y) + Float(0.5)) + offset).cwiseProduct(scale);
      const Ray ray = camera.ray(s, tan_half, camera.radius() > 0 ? stream.next2() : Vec2(Vec2::Zero()));
      const Spectrum radiance = integrator.radiance(ray, stream, tally.rays);
      ++tally.samples;
      if (!radiance.isFinite().all()) [[unlikely]] {
        tally.add({whole_x, whole_y, pass.number, i});
        continue;
      }
      luminances.add(double(luminance(radiance)));
      if (pass.separate) film.add(x, y, radiance.cast<double>());
      pixel.sum += radiance.cast<double>();
      ++pixel.valid;
    }
    film.note(x, y, luminances);
  }
  return tally;
}

using RowFunction = Tally (*)(const Scene&, const PathIntegrator<Scene>&, std::uint64_t, const Pass&, const Whole&, int,
                              Film&, std::span<PassSum>);

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

namespace {

void check(const RenderOptions& options) {
  mc::require(options.seconds || options.target_error || options.spp > 0,
              "render: {} samples per pixel; at least 1 is needed", options.spp);
  mc::require(!options.seconds || *options.seconds > 0, "render: a time of {} s; it must be > 0",
              options.seconds.value_or(0));
  mc::require(!options.target_error || *options.target_error > 0, "render: a target error of {}; it must be > 0",
              options.target_error.value_or(0));
  mc::require(options.max_depth == -1 || options.max_depth >= 1, "render: max depth {} must be -1 or at least 1",
              options.max_depth);
}

Crop part_of(const RenderOptions& options) {
  const Crop c = options.crop.value_or(Crop{0, 0, options.width, options.height});
  mc::require(c.x >= 0 && c.y >= 0 && c.width >= 1 && c.height >= 1 && c.x <= options.width - c.width &&
                  c.y <= options.height - c.height,
              "render: a crop of {}x{} pixels at ({}, {}) is not inside a picture of {}x{}", c.width, c.height, c.x,
              c.y, options.width, options.height);
  return c;
}

/// A render under way.
class Work {
 public:
  Work(const Scene& scene, const RenderOptions& options)
      : scene_(scene), options_(options), integrator_(scene, {options.strategy, options.max_depth, options.shown}),
        render_row_(row_function(options.sampler)),
        separate_(options.sampler == PixelSampler::independent), whole_{options.width, options.height,
                                                                        part_of(options)},
        film_(whole_.part.width, whole_.part.height) {}

  RenderResult run() {
    if (options_.seconds || options_.target_error) until_enough();
    else in_rounds();
    RenderResult result;
    result.image = film_.image();
    result.samples = total_.samples;
    result.rays = total_.rays;
    result.spp = double(total_.samples) / (double(film_.width()) * double(film_.height()));
    result.estimates = result.image.estimates = estimates_;
    result.seconds = elapsed();
    result.cpu_seconds = double(std::clock() - cpu_start_) / CLOCKS_PER_SEC;
    result.relative_error = film_.relative_error();
    result.undecided = film_.undecided();
    result.invalid = total_.invalid;
    result.first_invalid = total_.first;
    result.partial = partial_;
    return result;
  }

 private:
  double elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  bool cancelled() const { return options_.cancel && options_.cancel->load(std::memory_order_relaxed); }
  std::size_t height() const { return static_cast<std::size_t>(film_.height()); }
  std::size_t width() const { return static_cast<std::size_t>(film_.width()); }

  // All rows, unless it is cancelled; `row` renders one. How many were done.
  template <class Row> std::uint64_t for_rows(Row&& row, const std::function<double(double rows)>& fraction) {
    std::vector<Tally> tallies(height());
    std::atomic<std::uint64_t> done = 0, samples = total_.samples;
    mc::parallel_for(height(), options_.threads, [&](std::size_t y) {
      if (cancelled()) return;
      tallies[y] = row(y);
      ++done;
      samples += tallies[y].samples;
      if (options_.progress)
        options_.progress(
            {fraction(double(done) / double(height())), samples, total_.rays, elapsed(), error_, undecided_});
    });
    for (const Tally& tally : tallies) total_.merge(tally);
    return done;
  }

  // A given number of samples.
  void in_rounds() {
    const auto spp = static_cast<std::uint32_t>(options_.spp), passes = passes_for(spp), count = spp / passes;
    // Passes of one point, since spp has no small divisor, are estimates as they come, and the rounds grow by passes.
    const bool single = count == 1, separate = separate_ || single;
    const std::uint32_t steps = single ? passes : count;
    std::vector<PassSum> sums(separate ? 0 : width() * height() * passes);
    std::vector<std::uint32_t> row_steps(height(), 0); // done
    std::uint32_t begin = 0, end = single ? std::min(steps, 4u) : 1;
    while (begin < steps && !cancelled()) {
      const auto row = [&](std::size_t y) {
        Tally tally;
        for (std::uint32_t p = single ? begin : 0; p < (single ? end : passes); ++p) {
          const Pass pass{p, count, single ? 0 : begin, single ? 1 : end, separate};
          const std::size_t first = (y * passes + p) * width();
          const std::span<PassSum> own = separate ? std::span<PassSum>() : std::span(sums).subspan(first, width());
          tally.merge(render_row_(scene_, integrator_, options_.seed, pass, whole_, static_cast<int>(y), film_, own));
        }
        row_steps[y] = end;
        return tally;
      };
      if (for_rows(row, [&](double rows) { return (begin + rows * (end - begin)) / steps; }) < height()) break;
      begin = end;
      end = std::min(steps, 4 * end);
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (sums[i].valid > 0)
        film_.add(static_cast<int>(i % width()), static_cast<int>(i / width() / passes), sums[i].sum / sums[i].valid);
    const std::uint32_t least = *std::min_element(row_steps.begin(), row_steps.end());
    partial_ = least < steps;
    if (separate) estimates_ = spp / steps * least;
    else if (least > 0) estimates_ = passes;
  }

  // Passes, until time or error suffice.
  void until_enough() {
    constexpr std::uint32_t count = 16;
    std::vector<PassSum> sums;
    for (std::uint32_t done = 0; !cancelled(); ++done) {
      sums.assign(separate_ ? 0 : width() * height(), PassSum());
      const auto row = [&](std::size_t y) {
        const std::span<PassSum> own = separate_ ? std::span<PassSum>() : std::span(sums).subspan(y * width(), width());
        const Tally tally = render_row_(scene_, integrator_, options_.seed, {done, count, 0, count, separate_}, whole_,
                                        static_cast<int>(y), film_, own);
        for (std::size_t x = 0; x < own.size(); ++x)
          if (own[x].valid > 0) film_.add(static_cast<int>(x), static_cast<int>(y), own[x].sum / own[x].valid);
        return tally;
      };
      const auto fraction = [&](double) {
        if (options_.seconds) return elapsed() / *options_.seconds;
        return std::isfinite(error_) ? mc::sqr(*options_.target_error / error_) : 0.0;
      };
      if (for_rows(row, fraction) < height()) return;
      estimates_ = (done + 1) * (separate_ ? count : 1);
      error_ = film_.relative_error();
      undecided_ = film_.undecided();
      partial_ = !(options_.seconds ? elapsed() >= *options_.seconds
                                    : done >= 3 && error_ <= *options_.target_error && undecided_ <= most_undecided);
      if (!partial_) return;
    }
  }

  const Scene& scene_;
  const RenderOptions& options_;
  PathIntegrator<Scene> integrator_;
  RowFunction render_row_;
  bool separate_;
  Whole whole_;
  Film film_;
  Tally total_;
  double error_ = mc::infinity<double>; ///< when it was last looked at
  double undecided_ = 0;                ///< at the same time
  std::uint32_t estimates_ = 0;
  bool partial_ = true;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::clock_t cpu_start_ = std::clock();
};

} // namespace

RenderResult render(const Scene& scene, const RenderOptions& options) {
  check(options);
  return Work(scene, options).run();
}

} // namespace render

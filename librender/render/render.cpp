#include <render/render.h>

#include <render/film/sampling_plan.h>
#include <render/light_tracing_pass.h>
#include <render/tile_renderer.h>

#include <mc/core/error.h>
#include <mc/core/parallel.h>
#include <mc/sampler/owen_scramble.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <ctime>

namespace render {

namespace {

void check(const Scene& scene, const RenderOptions& options) {
  mc::require(
      finds_all_lights(scene, options.strategy) || options.aov.kind != Aov::radiance,
      "render: the strategy {} finds lights by chance, which never meets the scene's point or directional light; "
      "use nee or mis",
      options.strategy.name);
  mc::require(options.seconds || options.target_error || options.spp > 0,
              "render: {} samples per pixel; at least 1 is needed", options.spp);
  mc::require(!options.seconds || *options.seconds > 0, "render: a time of {} s; it must be > 0",
              options.seconds.value_or(0));
  mc::require(!options.target_error || *options.target_error > 0, "render: a target error of {}; it must be > 0",
              options.target_error.value_or(0));
  mc::require(!options.splat || !options.adaptive.value_or(false),
              "render: splats need the same number of samples in every pixel; leave out splat or adaptive");
  mc::require(!options.tiles || !options.splat,
              "render: tiles and splats both share samples between pixels, and the error bar allows for one of "
              "them; leave out one");
  mc::require(options.max_depth == -1 || options.max_depth >= 1, "render: max depth {} must be -1 or at least 1",
              options.max_depth);
  mc::require(options.branches >= 1 && options.branches <= max_branches,
              "render: {} branches of a path; they must be 1 to {}", options.branches, max_branches);
}

ImageExtent extent_of(const RenderOptions& options) {
  const Crop c = options.crop.value_or(Crop{0, 0, options.width, options.height});
  mc::require(c.x >= 0 && c.y >= 0 && c.width >= 1 && c.height >= 1 && c.x <= options.width - c.width &&
                  c.y <= options.height - c.height,
              "render: a crop of {}x{} pixels at ({}, {}) is not inside a picture of {}x{}", c.width, c.height, c.x,
              c.y, options.width, options.height);
  constexpr double most = 1 << 28; // the sums of a film then take about 100 GB
  mc::require(double(c.width) * double(c.height) <= most,
              "render: {}x{} pixels are more than {:.0f}; ask for a smaller picture or a part of it", c.width, c.height,
              most);
  return {options.width, options.height, c};
}

constexpr int point_sets = 2;
constexpr double least_pilot = 16; ///< Least number of samples per pixel of a pilot.

bool is_adaptive(const RenderOptions& options) {
  return !options.splat && options.adaptive.value_or(options.seconds.has_value() || options.target_error.has_value());
}

// None for a filter so narrow that pixels share nothing.
std::optional<SplatFilter> splat_filter_for(const Scene& scene, const RenderOptions& options) {
  if (!options.splat) return {};
  const SplatFilter filter(scene.filter());
  return filter.is_wide() ? std::optional(filter) : std::nullopt;
}

std::optional<LightTracer> light_tracer_for(const Scene& scene, const RenderOptions& options) {
  if (options.aov.kind != Aov::radiance) return {};
  if (options.max_depth >= 0 && options.max_depth < LightTracer::min_edges) return {};
  return LightTracer::create(scene, options.strategy, Float(options.width) / Float(options.height));
}

// Number of points of a stratified set: all points of a pixel's set if their number is known in advance.
std::uint32_t set_size_of(const RenderOptions& options) {
  const bool known = !options.seconds && !options.target_error && !is_adaptive(options);
  return known ? static_cast<std::uint32_t>((options.spp + point_sets - 1) / point_sets) : 16;
}

// Rows without samples repeat the nearest row with samples. Returns the number of such rows.
int repeat_rows(const Film& film, Image& image) {
  std::vector<int> rendered;
  for (int y = 0; y < image.height; ++y)
    if (film.rays(0, y) > 0) rendered.push_back(y); // every sample takes at least one ray
  if (rendered.empty()) return image.height;
  for (int y = 0; y < image.height; ++y) {
    const auto below = std::lower_bound(rendered.begin(), rendered.end(), y);
    int nearest = below == rendered.end() ? rendered.back() : *below;
    if (below != rendered.begin() && y - below[-1] <= std::abs(nearest - y)) nearest = below[-1];
    for (int x = 0; x < image.width; ++x) image.at(x, y) = image.at(x, nearest);
  }
  return image.height - static_cast<int>(rendered.size());
}

/// A render in progress.
class RenderJob {
 public:
  RenderJob(const Scene& scene, const RenderOptions& options)
      : options_(options), extent_(extent_of(options)), splat_(splat_filter_for(scene, options)),
        light_tracer_(light_tracer_for(scene, options)),
        points_(options.sampler, options.seed, set_size_of(options)), path_{options.strategy, options.max_depth,
                                                                            options.aov, options.branches},
        pixel_renderer_(scene, path_, points_, extent_, splat_, light_tracer()), film_(new_film()),
        taken_(width() * height()) {
    if (options.tiles) tile_renderer_.emplace(scene, path_, points_, extent_, light_tracer());
    if (light_tracer_)
      light_tracing_pass_.emplace(scene, *light_tracer_, options.max_depth, options.sampler, options.seed, extent_);
  }

  RenderResult run() {
    in_rounds();
    RenderResult result;
    result.image = film_.image();
    if (partial_ && mean_ == 0) result.missing_rows = repeat_rows(film_, result.image);
    result.samples = total_.samples;
    result.rays = total_.rays;
    result.spp = double(total_.samples) / double(taken_.size());
    result.estimates = result.image.estimates =
        std::min(static_cast<std::uint32_t>(film_.sets()), *std::min_element(taken_.begin(), taken_.end()));
    result.seconds = elapsed();
    result.cpu_seconds = double(std::clock() - cpu_start_) / CLOCKS_PER_SEC;
    const RelativeErrors errors = film_.relative_errors(result.image);
    result.relative_error = errors.image.value;
    result.worst_error = errors.worst_block.value;
    result.outlier_dominated = film_.outlier_dominated();
    result.unreliable_target_spp = unreliable_target_spp_;
    result.invalid = total_.invalid;
    result.first_invalid = total_.first_invalid;
    result.partial = partial_;
    result.out_of_time = options_.target_error && !partial_ && mean_ < wanted_by_error();
    return result;
  }

 private:
  double elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  bool limited() const { return options_.seconds || options_.target_error; }
  bool cancelled() const { return options_.cancel && options_.cancel->load(std::memory_order_relaxed); }
  // The first round is always completed.
  bool out_of_time() const { return options_.seconds && mean_ > 0 && elapsed() >= *options_.seconds; }
  // Including the border, with samples that count for the image.
  std::size_t height() const { return static_cast<std::size_t>(extent_.crop.height) + 2 * border(); }
  std::size_t width() const { return static_cast<std::size_t>(extent_.crop.width) + 2 * border(); }
  std::size_t border() const { return static_cast<std::size_t>(pixel_renderer_.border()); }

  const LightTracer* light_tracer() const { return light_tracer_ ? &*light_tracer_ : nullptr; }

  Film new_film() const {
    const int sets = limited() ? point_sets : std::min(options_.spp, point_sets);
    return {extent_.crop.width, extent_.crop.height, sets,
            FilmOptions{.splat = splat_,
                        .has_light_paths = light_tracer_.has_value(),
                        .noise_area = options_.tiles ? PathReuseIntegrator<Scene>::noise_area : 1,
                        .independent_samples = options_.sampler == PixelSampler::independent}};
  }

  // Runs `task` once for every row. Rows that write to common pixels run in different turns, in an order that does not
  // depend on the crop. Within a turn, each row is in the middle of the widest gap, so that a cancelled first round
  // covers the whole image.
  template <class Task> void for_rows(Task&& task) const {
    const std::size_t turns = 2 * border() + 1;
    for (std::size_t turn = 0; turn < turns; ++turn) {
      const std::size_t first = (turn + turns - static_cast<std::size_t>(extent_.crop.y) % turns) % turns;
      const std::size_t rows = (height() + turns - 1 - first) / turns, size = std::bit_ceil(std::max(rows, 2ul));
      mc::parallel_for(size, options_.threads, [&](std::size_t i) {
        const std::size_t row = mc::reverse_bits64(i) >> (64 - std::countr_zero(size));
        if (row < rows) task(first + row * turns);
      });
    }
  }

  // Extends every pixel to its number of samples for a mean of `mean`. Returns whether all rows were finished. With
  // splats, an unfinished round is discarded. The exception is the first round with two sets: they correct for missing
  // splats of neighbours.
  bool extend_to(double mean, double wanted) {
    std::vector<RenderStats> row_stats(height());
    std::vector<std::uint32_t> taken = taken_;
    std::optional<Film> round;
    if (splat_) round = new_film();
    Film& film = round ? *round : film_;
    std::atomic<std::uint64_t> done = 0, samples = total_.samples;
    RenderStats lights;
    std::uint64_t light_done = light_done_;
    const auto stop = [&] { return cancelled() || out_of_time(); };
    const auto add_light_paths = [&](std::uint64_t to) {
      if (light_tracing_pass_)
        light_done = light_tracing_pass_->add_paths(light_done, to, options_.threads, stop, film, lights);
    };
    const std::uint64_t all_light =
        light_tracing_pass_ ? light_tracing_pass_->path_count(mean * plan_.light_path_scale) : 0;
    // Before the first rows only a few light paths are traced, so that the rows start soon. Any number of light paths
    // is unbiased.
    add_light_paths(mean_ == 0 ? std::min(all_light, LightTracingPass::batch_size) : all_light);
    for_rows([&](std::size_t y) {
      if (stop()) return;
      const auto from = std::span(taken_).subspan(y * width(), width()),
                 to = std::span(taken).subspan(y * width(), width());
      for (std::size_t x = 0; x < width(); ++x) to[x] = std::max(to[x], plan_.samples(y * width() + x, mean));
      row_stats[y] = tile_renderer_
                         ? tile_renderer_->render_row(static_cast<int>(y), from, to, film)
                         : pixel_renderer_.render_row(static_cast<int>(y) - pixel_renderer_.border(), from, to, film);
      samples += row_stats[y].samples;
      const double rows = double(++done) / double(height());
      if (!options_.progress) return;
      const double fraction =
          options_.seconds ? elapsed() / *options_.seconds : (mean_ + rows * (mean - mean_)) / wanted;
      options_.progress({std::min(fraction, 1.0), samples, total_.rays, elapsed(), error_.value, outlier_dominated_});
    });
    add_light_paths(all_light);
    const bool is_whole = done == height();
    if (round && !is_whole && (mean_ > 0 || film_.sets() == 1)) return false;
    for (const RenderStats& stats : row_stats) total_.merge(stats);
    total_.merge(lights);
    light_done_ = light_done;
    taken_ = std::move(taken);
    if (round) film_.merge(*round);
    return is_whole;
  }

  // Estimated number of samples per pixel at the end of the render.
  double wanted() const {
    if (mean_ == 0 || !limited()) return options_.spp;
    const double by_time = options_.seconds ? mean_ * *options_.seconds / elapsed() : mc::infinity<double>;
    return options_.target_error ? std::min(by_time, wanted_by_error()) : by_time;
  }
  double wanted_by_error() const {
    const double by_error = mean_ * mc::sqr(error_.bound / *options_.target_error);
    const bool is_sure = mean_ >= least_pilot && outlier_dominated_ <= max_outlier_dominated;
    return is_sure ? by_error : std::max(by_error, 2 * mean_);
  }

  // Number of samples per pixel at the end of the next round: doubled, but at most `wanted`. If `wanted` is an
  // estimate, the round covers about three quarters of the rest.
  double end_of_round(double wanted, bool is_pilot) const {
    if (mean_ == 0) return film_.sets();
    double rest = wanted - mean_;
    if (limited() && !is_pilot) rest = std::max({0.75 * rest, 0.02 * mean_, 1.0});
    return mean_ + std::min(rest, mean_);
  }

  void in_rounds() {
    bool is_pilot = is_adaptive(options_);
    for (;;) {
      const double wanted = this->wanted();
      partial_ = mean_ < wanted && !out_of_time();
      if (!partial_ || cancelled()) return;
      if (is_pilot && mean_ >= least_pilot && mean_ >= wanted / 6) { // rounds double, so the pilot is about a quarter
        plan_ = adaptive_plan(film_, mean_ / wanted, options_.error_scope, options_.threads,
                              tile_renderer_ ? tile_renderer_->tiling() : Tiling{});
        is_pilot = false;
      }
      const double mean = end_of_round(wanted, is_pilot);
      if (!extend_to(mean, wanted)) continue;
      mean_ = mean;
      if (!options_.target_error && !options_.progress) continue; // the error is not needed
      error_ = film_.relative_errors().of(options_.error_scope);
      outlier_dominated_ = film_.outlier_dominated();
      const bool is_there = options_.target_error && error_.value <= *options_.target_error;
      if (is_there && mean_ >= least_pilot && outlier_dominated_ > max_outlier_dominated && unreliable_target_spp_ == 0)
        unreliable_target_spp_ = mean_;
    }
  }

  const RenderOptions& options_;
  ImageExtent extent_;
  std::optional<SplatFilter> splat_;
  std::optional<LightTracer> light_tracer_;
  PixelPoints points_;
  PathOptions path_;
  PixelRenderer pixel_renderer_;
  std::optional<TileRenderer> tile_renderer_;
  std::optional<LightTracingPass> light_tracing_pass_;
  Film film_;
  std::vector<std::uint32_t> taken_; ///< Number of samples of every pixel.
  SamplingPlan plan_;
  std::uint64_t light_done_ = 0; ///< Number of finished light paths.
  double mean_ = 0;              ///< Samples per pixel after the finished rounds.
  RenderStats total_;
  RelativeError error_;              ///< Error after the last round.
  double outlier_dominated_ = 0;     ///< Outlier-dominated pixels after the last round.
  double unreliable_target_spp_ = 0; ///< See RenderResult.
  bool partial_ = true;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::clock_t cpu_start_ = std::clock();
};

} // namespace

RenderResult render(const Scene& scene, const RenderOptions& options) {
  check(scene, options);
  return RenderJob(scene, options).run();
}

} // namespace render

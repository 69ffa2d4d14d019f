#include <render/render_job.h>
#include <render/render_setup.h>

#include <mc/core/cpu_time.h>
#include <mc/core/error.h>
#include <mc/core/memory.h>
#include <mc/sampler/owen_scramble.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace render {

namespace {

constexpr double least_rate = 0.25; ///< Of a pixel, relative to the mean, since a pilot may miss features.

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

constexpr std::uint64_t samples_of_unit = 1 << 17; ///< About, of a unit of pixels: less than a second.

// Row or column, in its tile, of the first pixel of the border; `at` is that of the film's first pixel.
std::size_t place_of_border(int at, const Tiling& tiles, std::size_t border) {
  const auto side = static_cast<std::size_t>(tiles.side);
  return (static_cast<std::size_t>(at) + side * border - border) % side;
}

// Rows in the order of their units. Rows that write to common pixels stand in different turns, in an order that does
// not depend on the crop. Within a turn, each row is in the middle of the widest gap, so that a cancelled first pass
// covers the whole image.
//   border : width of the border around the film.
//   tiles  : the position of the film's pixels in tiles; rows of a tile are rendered with its first row.
std::vector<std::uint32_t> row_order(const Crop& crop, std::size_t border, const Tiling& tiles) {
  std::vector<std::uint32_t> order;
  // Rows of a tile above the border; the tile has their turn.
  const std::size_t above = place_of_border(tiles.y, tiles, border);
  const std::size_t height = static_cast<std::size_t>(crop.height) + 2 * border + above,
                    turns = 2 * border + static_cast<std::size_t>(tiles.side);
  for (std::size_t turn = 0; turn < turns; ++turn) {
    const std::size_t first = (turn + turns - (static_cast<std::size_t>(crop.y) + turns - above) % turns) % turns;
    const std::size_t rows = (height + turns - 1 - first) / turns, size = std::bit_ceil(std::max(rows, 2ul));
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t row = mc::reverse_bits64(i) >> (64 - std::countr_zero(size));
      if (row >= rows) continue;
      const std::size_t at = first + row * turns; // from the first row of the first tile
      if (at == 0 || at > above) order.push_back(static_cast<std::uint32_t>(std::max(at, above) - above));
    }
  }
  return order;
}

} // namespace

RenderJob::RenderJob(const Scene& scene, const RenderOptions& options)
    : options_(checked(scene, options)), extent_(extent_of(options)), splat_(splat_filter_for(scene, options)),
      light_tracer_(light_tracer_for(scene, options)), points_(options.sampler, options.seed, set_size_of(options)),
      renderers_(scene, options, points_, extent_, splat_, light_tracer()), film_(checked_film()),
      row_order_(row_order(extent_.crop, border(), renderers_.any_tiling())), taken_(width() * height()),
      next_taken_(taken_.size()) {
  film_.set_noise_area(noise_area());
  if (light_tracer_)
    light_tracing_pass_.emplace(scene, *light_tracer_, options.max_depth, options.sampler, options.seed, extent_);
}

Film RenderJob::checked_film() const {
  mc::require_memory(film_memory(extent_.crop, options_, light_tracer_.has_value(), splat_),
                     fmt::format("render: {}x{} pixels", extent_.crop.width, extent_.crop.height),
                     "fewer pixels or a part of them need less");
  return {extent_.crop.width, extent_.crop.height, sets_of(options_),
          FilmOptions{.splat = splat_,
                      .has_light_paths = light_tracer_.has_value(),
                      .independent_samples = options_.sampler == PixelSampler::independent}};
}

// With a given number of samples the pilot does not depend on it, so that a render may go on with more. Otherwise it is
// about a quarter, since passes double.
bool RenderJob::is_end_of_pilot(double mean, double wanted) const {
  return mean >= pilot_samples && (!is_limited() || mean >= wanted / 6);
}

// An upper bound, also if the pass does not come to its end.
double RenderJob::noise_area() const {
  const double mean = std::max(is_pilot() ? pass_.mean : mean_, 1.0);
  return renderers_.noise_area(std::max((is_pilot() ? mean : pilot_mean_) - film_.sets(), 0.0) / mean);
}

// For the rows of a pass that lack splats: a row, or a tile, and `border` rows above and below.
Film RenderJob::new_window() const {
  return {film_.width(), static_cast<int>(2 * border()) + PathReuseIntegrator<Scene>::side, film_.sets(),
          FilmOptions{.splat = splat_}};
}

std::size_t RenderJob::archive_size() const {
  constexpr std::size_t others = 1 << 16;
  return film_.bytes() + (window_ ? window_->bytes() : 0) + 2 * taken_.size() * sizeof(taken_[0]) +
         plan_.rates.size() * sizeof(float) + others;
}

double RenderJob::elapsed() const {
  return earlier_seconds_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double RenderJob::wanted() const {
  if (!is_limited()) return options_.spp;
  if (mean_ == 0) return mc::infinity<double>;
  const double by_time = options_.seconds ? mean_ * *options_.seconds / elapsed() : mc::infinity<double>;
  return options_.target_error ? std::min(by_time, wanted_by_error()) : by_time;
}

double RenderJob::wanted_by_error() const {
  const double pixels = double(film_.width()) * double(film_.height());
  const double by_error = mean_ * mc::sqr(error_.bound / *options_.target_error);
  return std::max({by_error, pilot_samples, min_target_samples / pixels});
}

// Doubled, but at most `wanted`. If `wanted` is an estimate, the pass covers about three quarters of the rest.
double RenderJob::end_of_pass(double wanted) const {
  if (mean_ == 0) return film_.sets();
  double rest = wanted - mean_;
  if (is_limited() && !is_pilot()) rest = std::max({0.75 * rest, 0.02 * mean_, 1.0});
  return mean_ + std::min(rest, mean_);
}

std::size_t RenderJob::next_stage() {
  units_ = 0;
  while (units_ == 0 && (stage_ != Stage::none || begin_pass())) units_ = begin_stage();
  return units_;
}

// Begins the stage after the current one. Returns its number of units.
std::size_t RenderJob::begin_stage() {
  switch (stage_) {
  case Stage::none:
    stage_ = Stage::light_paths;
    // Before the first pixels only a few light paths are traced, so that the pixels start soon. Any number of light
    // paths is unbiased.
    return begin_light_paths(mean_ == 0 ? std::min(pass_.all_light, LightTracingPass::batch_size) : pass_.all_light);
  case Stage::light_paths:
    count_light_paths();
    stage_ = Stage::pixels;
    return begin_pixels();
  case Stage::pixels: stage_ = Stage::more_light_paths; return begin_light_paths(pass_.all_light);
  case Stage::more_light_paths:
    count_light_paths();
    end_pass();
    stage_ = Stage::none;
  }
  return 0;
}

// Returns false at the end of the render.
bool RenderJob::begin_pass() {
  const double wanted = this->wanted();
  if (!(mean_ < wanted) || is_out_of_time()) return false;
  if (is_pilot() && is_end_of_pilot(mean_, wanted)) make_plan();
  pass_ = {.mean = end_of_pass(wanted),
           .wanted = wanted,
           .light_done = light_done_,
           .light_counted = light_done_,
           .stats = {}};
  if (light_tracing_pass_) pass_.all_light = light_tracing_pass_->path_count(pass_.mean * plan_.light_path_scale);
  next_taken_ = taken_;
  if (splat_ && mean_ > 0) window_ = new_window();
  return true;
}

// Splats of different passes are averaged by the number of samples of the passes, so that only later passes have rates.
void RenderJob::make_plan() {
  pilot_mean_ = mean_;
  renderers_.choose(film_);
  plan_ = adaptive_plan(film_, least_rate, options_.error_scope, options_.threads, renderers_.tiling());
  if (splat_) plan_ = plan_.with_border(film_.width(), film_.height(), static_cast<int>(border()), mean_);
}

std::size_t RenderJob::begin_light_paths(std::uint64_t to) {
  pass_.light_begin = pass_.light_done;
  const std::uint64_t paths = to > pass_.light_begin ? to - pass_.light_begin : 0;
  pass_.light_end = std::max(to, pass_.light_begin);
  return (paths + LightTracingPass::block_size - 1) / LightTracingPass::block_size;
}

// A unit has whole rows in the first pass, of which cancellation leaves complete rows.
std::size_t RenderJob::begin_pixels() {
  const double samples = std::max((pass_.mean - mean_) * (plan_.rates.empty() ? 1 : 4), 1.0);
  const auto columns = static_cast<std::uint64_t>(std::max(double(samples_of_unit) / samples, 2.0));
  const std::uint64_t side = PathReuseIntegrator<Scene>::side;
  pass_.columns = mean_ == 0 ? width() + side : (columns + side - 1) / side * side;
  pass_.pixel_units = height() * ((width() + side + pass_.columns - 1) / pass_.columns);
  return pass_.pixel_units;
}

// Parts end between tiles.
RenderJob::RowPart RenderJob::row_part(std::size_t unit) const {
  const std::size_t parts = pass_.pixel_units / height(), part = unit % parts;
  const Tiling tiles = renderers_.any_tiling();
  const std::size_t cut = place_of_border(tiles.x, tiles, border());
  const auto at = [&](std::size_t i) { return std::min(std::max(i * pass_.columns, cut) - cut, width()); };
  const std::size_t row = unit / parts;
  return {mean_ == 0 ? row_order_[row] : row, at(part), at(part + 1)};
}

std::optional<RenderJob::Result> RenderJob::compute(std::size_t unit) const {
  const double start = mc::thread_cpu_seconds();
  std::optional<Result> result = compute_samples(unit);
  if (result) result->cpu_seconds = mc::thread_cpu_seconds() - start;
  return result;
}

std::optional<RenderJob::Result> RenderJob::compute_samples(std::size_t unit) const {
  Result result{{film_.width(), film_.height(), film_.sets()}, {}};
  if (stage_ != Stage::pixels) {
    const std::uint64_t first = pass_.light_begin + unit * LightTracingPass::block_size;
    result.stats = light_tracing_pass_->trace(first, std::min(first + LightTracingPass::block_size, pass_.light_end),
                                              result.block);
    return result;
  }
  const RowPart part = row_part(unit);
  const std::size_t first = part.row * width() + part.begin;
  std::vector<std::uint32_t> to(part.end - part.begin);
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = samples_at_end(first + i);
  const std::span<const std::uint32_t> from = std::span(taken_).subspan(first, to.size());
  const auto weight =
      splat_ && !plan_.rates.empty() ? std::optional((pass_.mean - mean_) / film_.sets()) : std::nullopt;
  const auto in_film = [&](std::size_t at) { return static_cast<int>(at) - static_cast<int>(border()); };
  // The first pass does not alternate: cut short, it leaves whole rows.
  result.stats =
      renderers_.render_row(in_film(part.row), in_film(part.begin), from, to, result.block, weight, mean_ > 0);
  return result;
}

void RenderJob::absorb(std::size_t unit, const Result& result) {
  film_.add(result.block, window_ ? &*window_ : nullptr);
  pass_.stats.merge(result.stats);
  cpu_seconds_ += result.cpu_seconds;
  count(unit);
}

// Counts a unit that was absorbed or skipped.
void RenderJob::count(std::size_t unit) {
  if (stage_ == Stage::pixels) {
    const RowPart part = row_part(unit);
    for (std::size_t i = part.row * width() + part.begin; i < part.row * width() + part.end; ++i)
      next_taken_[i] = samples_at_end(i);
    ++pass_.pixels_done;
    take_complete_row();
    report_progress();
    return;
  }
  pass_.light_done = std::min(pass_.light_done + LightTracingPass::block_size, pass_.light_end);
  if ((pass_.light_done - pass_.light_begin) % LightTracingPass::batch_size == 0) count_light_paths();
}

bool RenderJob::needs_results() const {
  const bool ends_pass =
      stage_ == Stage::more_light_paths || (stage_ == Stage::pixels && pass_.light_done >= pass_.all_light);
  if (!ends_pass) return false;
  const bool begins_plan = is_pilot() && pass_.mean < options_.spp && is_end_of_pilot(pass_.mean, options_.spp);
  return is_limited() || begins_plan;
}

// Tells the film of the light paths since the last call.
void RenderJob::count_light_paths() {
  if (pass_.light_done > pass_.light_counted)
    light_tracing_pass_->count_paths(pass_.light_counted, pass_.light_done, film_);
  pass_.light_counted = pass_.light_done;
}

// With the end of a row, a row above has all its splats.
void RenderJob::take_complete_row() {
  const std::size_t parts = pass_.pixel_units / height(), rows = pass_.pixels_done / parts;
  if (!window_ || pass_.pixels_done % parts != 0 || rows <= 2 * border()) return;
  film_.take_row(*window_, static_cast<int>(rows - 1 - 2 * border()));
}

// Ends a pass, finished or not. With splats, the rows of an unfinished pass that are not complete lose its samples. In
// the first pass all rows keep them, since two sets correct for missing splats of neighbours.
void RenderJob::end_pass() {
  const bool is_whole = pass_.pixels_done == pass_.pixel_units;
  total_.merge(pass_.stats);
  light_done_ = pass_.light_done;
  taken_ = next_taken_;
  window_.reset();
  if (is_whole) mean_ = pass_.mean;
  film_.set_noise_area(noise_area());
  if (!is_whole) return;
  if (options_.target_error || options_.progress) estimate_error();
}

void RenderJob::estimate_error() { error_ = film_.relative_errors().of(options_.error_scope); }

void RenderJob::report_progress() const {
  if (!options_.progress) return;
  const double share = double(pass_.pixels_done) / double(pass_.pixel_units);
  const double fraction =
      options_.seconds ? elapsed() / *options_.seconds : (mean_ + share * (pass_.mean - mean_)) / pass_.wanted;
  options_.progress(
      {std::min(fraction, 1.0), total_.samples + pass_.stats.samples, total_.rays, elapsed(), error_, [this] {
         int missing_rows = 0;
         return image_so_far(missing_rows);
       }});
}

// Without the rows of a pass with splats that are not complete. Within the first pass, missing rows repeat others;
// their number is in `missing_rows`.
Image RenderJob::image_so_far(int& missing_rows) const {
  Image image = film_.image();
  missing_rows = mean_ == 0 ? repeat_rows(film_, image) : 0;
  image.estimates = std::min(static_cast<std::uint32_t>(film_.sets()), *std::min_element(taken_.begin(), taken_.end()));
  return image;
}

RenderResult RenderJob::result(bool is_done) {
  if (stage_ != Stage::none) {
    if (stage_ != Stage::pixels) count_light_paths();
    end_pass();
    stage_ = Stage::none;
  }
  RenderResult result;
  result.image = image_so_far(result.missing_rows);
  result.partial = !is_done;
  result.samples = total_.samples;
  result.rays = total_.rays;
  result.spp = double(total_.samples) / double(taken_.size());
  result.estimates = result.image.estimates;
  result.seconds = elapsed();
  result.cpu_seconds = cpu_seconds_;
  const RelativeErrors errors = film_.relative_errors(result.image);
  result.relative_error = errors.image.value;
  result.worst_error = errors.worst_block.value;
  result.outlier_dominated = film_.outlier_dominated();
  result.invalid = total_.invalid;
  result.first_invalid = total_.first_invalid;
  result.out_of_time = options_.target_error && !result.partial && mean_ < wanted_by_error();
  return result;
}

} // namespace render

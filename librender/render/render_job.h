#pragma once
/// The work of a render in units.

#include <render/light_tracing_pass.h>
#include <render/renderer_choice.h>

#include <mc/run/job.h>

#include <chrono>

namespace render {

/// A render as an mc::Job. It decides which samples come next; Film keeps them.
///   passes : each pass takes every pixel to its number of samples for a mean over the image. A pass has up to three
///            stages: light paths, pixels, and again light paths.
///   units  : 1024 light paths, or some pixels of a row; see render_row() of PixelRenderer and TileRenderer.
///   plan   : made before the first pass after the pilot, for adaptive sampling, with the choice of the renderer.
class RenderJob {
 public:
  /// Result of a unit.
  struct Result {
    FilmBlock block;        ///< Samples.
    RenderStats stats;      ///< Their counts.
    double cpu_seconds = 0; ///< CPU time of the unit.
    /// The result, see mc/run/archive.h.
    template <class Archive> void archive(Archive& a) { a(block, stats, cpu_seconds); }
  };

  /// Prepares the render of a scene. Scene and options must outlive this.
  ///   throws : as render().
  RenderJob(const Scene& scene, const RenderOptions& options);

  /// As mc::Job.
  std::size_t next_stage();
  /// As mc::Job.
  std::optional<Result> compute(std::size_t unit) const;
  /// As mc::Job.
  void absorb(std::size_t unit, const Result& result);
  /// As mc::Job.
  void skip(std::size_t unit) { count(unit); }
  /// As mc::Job: at the end of a pass, a plan or a limit depends on the samples.
  bool needs_results() const;
  /// Whether the time limit is not reached, or the first pass is not finished.
  bool may_start() const { return !is_out_of_time(); }
  /// As mc::Job.
  template <class Archive> void archive(Archive& a) {
    if constexpr (!Archive::is_reader) a.reserve(archive_size());
    double seconds = elapsed();
    a(film_, taken_, next_taken_, plan_, renderers_, pilot_mean_, mean_, total_, error_.value, error_.bound, stage_,
      pass_, units_, light_done_, seconds, cpu_seconds_);
    bool has_window = window_.has_value();
    a(has_window);
    if (has_window && !window_) window_ = new_window();
    if (has_window) a(*window_);
    if constexpr (Archive::is_reader) {
      earlier_seconds_ = seconds;
      start_ = std::chrono::steady_clock::now();
      film_.set_noise_area(noise_area());
    }
  }
  /// As mc::Job.
  template <class Archive> void archive_stage(Archive& a) { a(taken_, plan_, renderers_, mean_, stage_, pass_); }

  /// Image and statistics of the samples so far. Call it once, after the run.
  ///   is_done : whether the run came to its end.
  RenderResult result(bool is_done);

 private:
  enum class Stage : std::uint8_t { none, light_paths, pixels, more_light_paths };
  // Numbers of a pass.
  struct Pass {
    double mean = 0,               // samples per pixel at its end
        wanted = 0;                // estimated samples per pixel at the end of the render
    std::uint64_t all_light = 0,   // light paths at its end
        light_begin = 0,           // first light path of the stage
        light_end = 0,             // end of its light paths
        light_done = 0,            // light paths so far
        light_counted = 0;         // light paths of which the film was told
    std::uint64_t pixel_units = 0, // number of units of pixels
        pixels_done = 0;           // number of those that were absorbed
    std::uint64_t columns = 0;     // columns of a unit of pixels
    RenderStats stats;
    template <class Archive> void archive(Archive& a) {
      a(mean, wanted, all_light, light_begin, light_end, light_done, light_counted, pixel_units, pixels_done, columns,
        stats);
    }
  };
  // The pixels of a unit: columns [begin, end) of a row, counted from the border.
  struct RowPart {
    std::size_t row, begin, end;
  };

  // At least the size of the archive, so that its memory does not grow by copies.
  std::size_t archive_size() const;
  double elapsed() const;
  bool is_limited() const { return options_.seconds || options_.target_error; }
  // The first pass is always completed.
  bool is_out_of_time() const { return options_.seconds && mean_ > 0 && elapsed() >= *options_.seconds; }
  std::size_t border() const { return splat_ ? static_cast<std::size_t>(splat_->reach()) : 0; }
  // Including the border, with samples that count for the image.
  std::size_t height() const { return static_cast<std::size_t>(extent_.crop.height) + 2 * border(); }
  std::size_t width() const { return static_cast<std::size_t>(extent_.crop.width) + 2 * border(); }
  const LightTracer* light_tracer() const { return light_tracer_ ? &*light_tracer_ : nullptr; }
  // Whether a plan is yet to be made.
  bool is_pilot() const { return options_.adaptive && pilot_mean_ == 0; }
  double noise_area() const;
  bool is_end_of_pilot(double mean, double wanted) const;
  Film new_window() const;
  Film checked_film() const;

  double wanted() const;
  double wanted_by_error() const;
  double end_of_pass(double wanted) const;
  std::size_t begin_stage();
  bool begin_pass();
  void take_complete_row();
  void end_pass();
  void make_plan();
  std::size_t begin_light_paths(std::uint64_t to);
  std::size_t begin_pixels();
  void count_light_paths();
  void estimate_error();
  void report_progress() const;
  Image image_so_far(int& missing_rows) const;
  std::optional<Result> compute_samples(std::size_t unit) const;
  void count(std::size_t unit);
  RowPart row_part(std::size_t unit) const;
  // With splats each set of each pixel takes part in each pass, since a pixel's splats count for others.
  std::uint32_t samples_at_end(std::size_t pixel) const {
    const std::uint32_t least = splat_ && !plan_.rates.empty() ? static_cast<std::uint32_t>(film_.sets()) : 0;
    return std::max(taken_[pixel] + least, plan_.samples(pixel, pass_.mean));
  }

  const RenderOptions& options_;
  ImageExtent extent_;
  std::optional<SplatFilter> splat_;
  std::optional<LightTracer> light_tracer_;
  PixelPoints points_;
  RendererChoice renderers_;
  std::optional<LightTracingPass> light_tracing_pass_;

  Film film_;
  std::vector<std::uint32_t> row_order_; ///< Rows that write to common pixels keep their order in every crop.
  std::optional<Film> window_;           ///< Splats of the pass on rows that are not complete; none in the first pass.
  std::vector<std::uint32_t> taken_,     ///< Number of samples of every pixel before the pass.
      next_taken_;                       ///< The same for pixels that were absorbed in the pass.
  SamplingPlan plan_;
  double pilot_mean_ = 0;        ///< Samples per pixel of the pilot; 0 until the plan is made.
  double mean_ = 0;              ///< Samples per pixel after the finished passes.
  std::uint64_t light_done_ = 0; ///< Number of light paths of the finished passes.
  RenderStats total_;
  RelativeError error_; ///< Error after the last pass.
  Stage stage_ = Stage::none;
  Pass pass_;
  std::uint64_t units_ = 0; ///< Number of units of the stage.

  double cpu_seconds_ = 0;     ///< Of all units.
  double earlier_seconds_ = 0; ///< Of the run behind the checkpoint.
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace render

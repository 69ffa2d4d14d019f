#include <converge/picture_errors.h>
#include <converge/picture_measurement.h>

#include <mc/core/error.h>
#include <mc/core/memory.h>
#include <mc/random/hash.h>
#include <mc/run/job.h>
#include <mc/run/part_run.h>
#include <render/film/accumulate.h>
#include <render/integrator/direction_mixture.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

namespace carlo {

namespace {

using render::Image;

bool is_black(const Image& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(),
                     [](const render::Spectrum& p) { return render::is_black(p); });
}

/// State of a measurement in progress.
class PictureSession {
 public:
  PictureSession(const render::SceneFile& file, const std::vector<RenderMethod>& methods, const PictureOptions& options)
      : file_(file), methods_(methods), options_(options), curves_(methods.size()) {}

  PictureMeasurement run() {
    require_memory(least_pictures(options_.max_spp) + least_pictures(options_.max_spp / 2)); // of the last two levels
    const mc::Checkpoint::Section section(options_.checkpoint, "pictures", [this](auto& a) { archive(a); });
    bool stopped = false;
    for (; spp_ <= options_.max_spp && (is_within_level() || is_time_left()); spp_ *= 2) {
      if (!is_within_level()) begin_level();
      try {
        stopped = !measure_level();
      } catch (const mc::MemoryError& e) {
        if (last_level_.empty()) throw;
        cut_short_ = e.what();
        break;
      }
      if (stopped) break;
      last_ = elapsed() - level_begin_;
    }
    if (options_.checkpoint && !stopped) options_.checkpoint->save_and_wait(); // when cancelled, a render saved
    PictureMeasurement result = collect();
    result.measurement.interrupted = stopped;
    result.cut_short = cut_short_;
    return result;
  }

 private:
  using Clock = std::chrono::steady_clock;

  enum class Phase : std::uint8_t { begin, reference, end };

  template <class Archive> void archive(Archive& a) {
    double seconds = elapsed();
    a(seconds, level_, last_level_, wanted_, phase_, reference_, references_, spp_, last_, level_begin_);
    for (ConvergenceCurve& curve : curves_) a(curve.errors, curve.replicates);
    if constexpr (Archive::is_reader) {
      earlier_ = seconds;
      start_ = Clock::now();
    }
  }

  // Including the time of the run behind a checkpoint.
  double elapsed() const {
    const double seconds = earlier_ + std::chrono::duration<double>(Clock::now() - start_).count();
    return options_.seconds > 0 ? mc::shared_value(seconds, options_.executor) : seconds;
  }
  bool is_within_level() const { return !wanted_.empty(); }
  // Twice the samples take twice as long; the first level is always measured.
  bool is_time_left() const { return options_.seconds <= 0 || elapsed() + 2 * last_ <= options_.seconds || spp_ == 4; }
  static bool is_due(const RenderMethod& method, int spp) { return !is_adaptive(method.allocation) || spp >= 32; }
  int first_wanted() const { return options_.replicates > 0 ? options_.replicates : first_pictures; }
  // Least number of pictures of all methods at a level.
  double least_pictures(int spp) const {
    return first_wanted() * double(std::count_if(methods_.begin(), methods_.end(),
                                                 [spp](const RenderMethod& m) { return is_due(m, spp); }));
  }
  // Throws MemoryError where more pictures, the reference and a render need more memory than is allowed.
  void require_memory(double pictures) const {
    constexpr double references = 2; // while one is added
    double film = 0;
    for (const RenderMethod& m : methods_)
      film = std::max(film, render::memory_needed(file_.scene, render_options(m, 1, 0, {})));
    const double picture = 2.0 * sizeof(render::Spectrum) * options_.width * options_.height;
    mc::require_memory((pictures + references) * picture + film,
                       fmt::format("{:.0f} pictures of {}x{} pixels", pictures, options_.width, options_.height),
                       "a smaller --size or fewer methods need less");
  }
  void show(double share, const std::string& where) const {
    const double before = spp_ - 4, all = 2.0 * options_.max_spp - 4; // samples of all levels
    if (options_.progress) options_.progress((before + share * spp_) / all, where);
  }

  void begin_level() {
    level_begin_ = elapsed();
    level_.assign(methods_.size(), PictureSeries{double(spp_)});
    wanted_.assign(methods_.size(), 0);
    for (std::size_t i = 0; i < methods_.size(); ++i)
      if (is_due(methods_[i], spp_)) wanted_[i] = first_wanted();
    phase_ = Phase::begin;
  }

  // Renders every method with the samples of this level, and refines the reference as needed. When cancelled, returns
  // false: the level is not among the results.
  bool measure_level() {
    if (phase_ == Phase::begin) {
      if (!render_missing()) return false;
      phase_ = Phase::reference;
    }
    if (phase_ == Phase::reference) {
      if (!refine_reference()) return false;
      if (options_.replicates == 0)
        for (std::size_t i = 0; i < methods_.size(); ++i)
          if (wanted_[i] > 0) wanted_[i] = pictures_needed(level_[i], reference_);
      phase_ = Phase::end;
    }
    if (!render_missing()) return false;
    for (std::size_t i = 0; i < methods_.size(); ++i) {
      if (wanted_[i] == 0) continue;
      for (const Image& image : level_[i].images)
        level_[i].replicates.values.push_back(std::sqrt(noise(image, reference_)));
      curves_[i].errors.push_back(error_of(level_[i], reference_));
      curves_[i].replicates.push_back(level_[i].replicates);
    }
    last_level_ = std::move(level_);
    wanted_.clear();
    return true;
  }

  // Renders the methods in turn until each has the wanted number of pictures. Returns false when cancelled.
  bool render_missing() {
    const int most = *std::max_element(wanted_.begin(), wanted_.end());
    double missing = 0;
    for (std::size_t i = 0; i < methods_.size(); ++i)
      missing += std::max(wanted_[i] - double(level_[i].images.size()), 0.0);
    require_memory(missing);
    mc::IndependentPieces pieces; // a part renders its share of each
    for (int r = 0; r < most; ++r)
      for (std::size_t i = 0; i < methods_.size(); ++i) {
        if (r >= wanted_[i] || std::size_t(r) < level_[i].images.size()) continue;
        const std::uint64_t seed = mc::hash(options_.seed, i, std::uint64_t(spp_), std::uint64_t(r));
        const std::string name = fmt::format("{} {} {}", methods_[i].name(), spp_, r);
        render::RenderResult result;
        if (!pieces.attempt([&] { result = render_picture(methods_[i], spp_, seed, name); })) continue;
        if (result.partial) return false;
        Replicates& replicates = level_[i].replicates;
        replicates.calls.push_back(result.spp);
        replicates.seconds.push_back(options_.cost_rays ? 1e-6 * double(result.rays) : result.cpu_seconds);
        level_[i].images.push_back(std::move(result.image));
        show(0.7 * (r + 1) / most, fmt::format("{} at {} spp", methods_[i].name(), spp_));
      }
    pieces.end();
    return true;
  }

  // The smallest mean noise of a method at this level. A single picture may have little by chance.
  double smallest_noise() const {
    double smallest = mc::infinity<double>;
    for (const PictureSeries& s : level_) {
      mc::Moments noises;
      for (const Image& image : s.images) noises.add(noise(image, reference_));
      if (noises.mean() > mc::sqr(rounding_of_pixels)) smallest = std::min(smallest, noises.mean());
    }
    mc::require(std::isfinite(smallest), "no picture has noise: there is no error to measure");
    return smallest;
  }

  // Adds to the reference until its error is a tenth of the smallest noise. Returns false when cancelled.
  bool refine_reference() {
    if (reference_.spp == 0 && !add_to_reference(16.0 * spp_)) return false;
    for (;;) {
      const double excess = reference_.noise / (smallest_noise() / 100) - 1;
      if (excess <= 0) return true;
      if (!add_to_reference(reference_.spp * std::max(excess, 0.25))) return false;
    }
  }

  bool add_to_reference(double spp) {
    show(0.8, fmt::format("the reference, {:.0f} spp", reference_.spp + spp));
    const RenderMethod best{.max_depth = file_.defaults.max_depth, .allocation = SampleAllocation::adaptive};
    const std::uint64_t seed = mc::hash(options_.seed, 77, references_ + 1);
    render::RenderResult r =
        render_picture(best, static_cast<int>(std::min(spp, 1e8)), seed, fmt::format("reference {}", references_));
    if (r.partial) return false;
    ++references_;
    mc::require(!is_black(r.image), "the picture is black: without light there is no error to measure");
    if (reference_.spp == 0) reference_.relmse_floor = relmse_floor_of(r.image);
    reference_.image =
        reference_.spp > 0 ? render::accumulate(reference_.image, reference_.spp, r.image, r.spp) : std::move(r.image);
    reference_.spp += r.spp;
    reference_.noise = noise(reference_.image, reference_);
    return true;
  }

  render::RenderResult render_picture(const RenderMethod& method, int spp, std::uint64_t seed,
                                      const std::string& name) const {
    return render::render(file_.scene, render_options(method, spp, seed, name));
  }

  render::RenderOptions render_options(const RenderMethod& method, int spp, std::uint64_t seed,
                                       const std::string& name) const {
    render::RenderOptions o;
    o.name = name;
    o.executor = options_.executor;
    o.width = options_.width;
    o.height = options_.height;
    o.spp = spp;
    o.strategy = method.strategy;
    o.sampler = method.sampler;
    o.max_depth = method.max_depth;
    o.aov = file_.defaults.aov;
    o.adaptive = is_adaptive(method.allocation);
    o.splat = method.allocation == SampleAllocation::splat;
    o.tiles = uses_tiles(method.allocation);
    if (!uses_tiles(method.allocation)) o.branches = 2;
    o.seed = seed;
    o.threads = options_.threads;
    o.cancel = options_.cancel;
    o.checkpoint = options_.checkpoint;
    return o;
  }

  // The result from the finished levels.
  PictureMeasurement collect() {
    PictureMeasurement result;
    if (options_.cost_rays) result.measurement.cost = ray_cost;
    const auto plain = plain_mc_method(file_);
    result.measurement.plain_mc = plain ? plain->name() : "";
    const std::size_t begun = std::size_t(
        std::count_if(curves_.begin(), curves_.end(), [](const ConvergenceCurve& c) { return !c.errors.empty(); }));
    std::vector<WorkAndBias> biases;
    for (std::size_t i = 0; i < methods_.size(); ++i) {
      ConvergenceCurve& curve = curves_[i];
      if (curve.errors.empty()) continue;
      SamplingMethod& method = result.methods.emplace_back();
      method.name = method.title = methods_[i].name();
      curve.method = &method;
      fit(curve);
      biases.push_back(bias_of(last_level_[i], reference_, begun));
      const bool is_plain =
          methods_[i].sampler == render::PixelSampler::independent && !is_adaptive(methods_[i].allocation);
      if (is_plain && !(biases.back().bias.bias.lo > 0)) curve.theory = ConvergenceRate{0.5, 0, "independent samples"};
      result.measurement.curves.push_back(std::move(curve));
      result.pictures.push_back(last_level_[i].images.front());
    }
    set_break_even_errors(biases);
    for (const WorkAndBias& one : biases) result.biases.push_back(one.bias);
    result.reference = std::move(reference_.image);
    result.reference_error = std::sqrt(reference_.noise);
    result.reference_spp = reference_.spp;
    return result;
  }

  const render::SceneFile& file_;
  const std::vector<RenderMethod>& methods_;
  const PictureOptions& options_;
  Clock::time_point start_ = Clock::now();
  double earlier_ = 0;                    ///< seconds before start_
  std::vector<ConvergenceCurve> curves_;  ///< one for each method
  std::vector<PictureSeries> last_level_, ///< last finished level, one series for each method
      level_;                             ///< the level under way
  std::vector<int> wanted_;               ///< number of its pictures of each method; empty between levels
  Phase phase_ = Phase::begin;
  double level_begin_ = 0; ///< seconds at its begin
  ReferencePicture reference_;
  std::uint64_t references_ = 0; ///< number of pictures averaged into the reference
  int spp_ = 4;                  ///< samples per pixel of the current level
  double last_ = 0;              ///< seconds of the last level
  std::string cut_short_;        ///< see PictureMeasurement
};

} // namespace

std::string RenderMethod::name() const {
  std::string text = fmt::format("{} {}", strategy.name, render::name(sampler));
  if (max_depth > 0) text += fmt::format(" depth {}", max_depth);
  constexpr std::array<const char*, 5> words = {"", " adaptive", " splat", " tiles", " adaptive tiles"};
  return text + words[static_cast<std::size_t>(allocation)];
}

std::optional<RenderMethod> plain_mc_method(const render::SceneFile& file) {
  const render::Strategy& strategy = render::strategy_from("bsdf");
  if (!finds_all_lights(file.scene, strategy)) return {};
  return RenderMethod{strategy, render::PixelSampler::independent, file.defaults.max_depth};
}

PictureMeasurement measure_pictures(const render::SceneFile& file, const std::vector<RenderMethod>& methods,
                                    const PictureOptions& options) {
  mc::require(!methods.empty(), "no method to render is named");
  mc::require(options.replicates == 0 || options.replicates >= 3,
              "{} pictures behind each error; at least 3 are needed", options.replicates);
  mc::require(options.max_spp >= 16 && options.max_spp <= 1 << 28,
              "{} samples per pixel at most; it must lie in 16 to 2^28", options.max_spp);
  return PictureSession(file, methods, options).run();
}

} // namespace carlo

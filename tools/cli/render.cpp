#include <cli/subcommand.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>
#include <terminal/version.h>

#include <render/film/interval.h>
#include <render/io/image_io.h>
#include <render/io/mitsuba.h>
#include <render/io/mitsuba/reference.h>
#include <render/render.h>
#include <render/scene/resolution.h>

#include <mc/core/error.h>

#include <cstdio>
#include <filesystem>
#include <mutex>

namespace carlo {

namespace {

struct RenderOptions {
  std::string scene;
  bool help_scene = false;            ///< print the reference of scene files, and stop
  std::string dialect = "mitsuba";    ///< whose defaults hold in the scene
  std::string output;                 ///< empty: the scene's name with .exr in the current folder
  std::optional<int> spp;             ///< samples per pixel
  std::optional<double> seconds;      ///< wall-clock budget [s]
  std::optional<double> target_error; ///< mean relative standard error to reach
  std::string error_of;               ///< of what; empty: picture
  std::string adaptive;               ///< on or off; empty: on with --time and --target-error
  std::string intervals;              ///< file for the half widths of 95 % intervals; empty: none
  std::string size;                   ///< "WxH"; empty: the scene's
  std::string strategy, sampler;      ///< empty: mis, sobol
  std::optional<int> max_depth;       ///< longest path in edges; -1: unlimited
  std::uint64_t seed = 0;
  int threads = 0;            ///< 0: all
  double exposure = 0;        ///< stops, PNG only
  bool allow_invalid = false; ///< write the image although samples were not finite
  std::string command;        ///< the command line, for the metadata
};

void parse_size(const std::string& text, int& width, int& height) {
  char rest = 0;
  mc::require(std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) == 2 && width > 0 && height > 0,
              "--size '{}' must be WIDTHxHEIGHT in pixels, e.g. 640x480", text);
}

// The folder is looked at before hours of rendering, not after.
void check_output(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  mc::require(folder.empty() || std::filesystem::is_directory(folder),
              "cannot write '{}': the folder '{}' does not exist; create it first", path, folder.string());
  const std::string extension = std::filesystem::path(path).extension().string();
  mc::require(extension == ".exr" || extension == ".pfm" || extension == ".png",
              "cannot write '{}': unknown image format '{}'; use .exr, .pfm or .png", path, extension);
}

std::vector<Option> rows(RenderOptions& o) {
  return {
      {"SCENE", "FILE", &o.scene, "Scene file (Mitsuba XML)"},
      {"--help-scene", "", &o.help_scene, "Print what a scene file may hold, as Markdown, and stop"},
      {"--dialect", "NAME", &o.dialect, "Whose defaults hold in the scene: mitsuba or lajolla"},
      {"-o,--output", "FILE", &o.output,
       "Image to write: .exr (radiance and variance), .pfm or .png (sRGB) [SCENE.exr here]"},
      {"--spp", "N", &o.spp, "Samples per pixel; this, --time or --target-error [the scene's]"},
      {"--time", "SECONDS", &o.seconds, "Wall-clock time to spend", false, {"--spp"}},
      {"--target-error",
       "RATIO",
       &o.target_error,
       "Mean relative standard error to reach: the pixels' standard errors relative to the radiance about them, in the "
       "dark to half of the picture's mean, root mean square; while one sample carries over half of the variance in at "
       "most 5 % of the pixels",
       false,
       {"--spp", "--time"}},
      {"--error-of", "WHAT", &o.error_of,
       "The error that counts: of the picture, or of its worst 16x16 block [picture]"},
      {"--adaptive", "on|off", &o.adaptive,
       "Samples where the error is, as a first quarter has seen it, or evenly [off with --spp, else on]"},
      {"--intervals", "FILE", &o.intervals, "Write half the widths of the pixels' 95 % intervals to this image"},
      {"--size", "WxH", &o.size, "Image size in pixels [the scene's]"},
      {"--strategy", "NAME", &o.strategy, "bsdf, hemisphere, light, mixture, nee or mis [mis]"},
      {"--sampler", "NAME", &o.sampler, "independent, stratified or sobol [sobol]"},
      {"--max-depth", "N", &o.max_depth,
       "Longest path in edges (1: light seen directly), -1 for no limit [the scene's]"},
      {"--seed", "N", &o.seed, "Seed; same seed, same bits, whatever the number of threads"},
      {"--threads", "N", &o.threads, "Threads, 0 for all of the machine's"},
      {"--exposure", "STOPS", &o.exposure, "Brightness added before a PNG is written"},
      {"--allow-invalid", "", &o.allow_invalid, "Write the image although some samples were not finite"},
  };
}

void warn_where_coarse(const std::string& path, const ::render::Scene& scene) {
  const ::render::Coarseness c = ::render::coarsest(scene);
  if (c.ratio <= ::render::too_coarse) return;
  std::fprintf(
      stderr,
      "carlo: warning: %s: a surface %.3g across has coordinates of %.3g, where the next number is %.2g further; "
      "its light and shadow may be wrong. Bring what lies far apart closer together\n",
      path.c_str(), c.size, c.distance, c.step);
}

std::string format_error(const ::render::RenderResult& result) {
  if (!std::isfinite(result.relative_error)) return "unknown (one sample per pixel)";
  return fmt::format("{:.2f} % (worst block {:.2f} %)", 100 * result.relative_error, 100 * result.worst_error);
}

// What the scene asks for, where the command does not say otherwise.
::render::RenderOptions settings_of(const RenderOptions& options, const ::render::RenderDefaults& defaults) {
  ::render::RenderOptions settings;
  settings.width = defaults.width;
  settings.height = defaults.height;
  if (!options.size.empty()) parse_size(options.size, settings.width, settings.height);
  settings.spp = options.spp.value_or(defaults.spp);
  settings.seconds = options.seconds;
  settings.target_error = options.target_error;
  mc::require(options.error_of.empty() || options.error_of == "picture" || options.error_of == "worst",
              "--error-of '{}' must be picture or worst", options.error_of);
  if (options.error_of == "worst") settings.error_of = ::render::ErrorOf::worst;
  mc::require(options.adaptive.empty() || options.adaptive == "on" || options.adaptive == "off",
              "--adaptive '{}' must be on or off", options.adaptive);
  if (!options.adaptive.empty()) settings.adaptive = options.adaptive == "on";
  if (!options.strategy.empty()) settings.strategy = ::render::strategy_from(options.strategy);
  if (!options.sampler.empty()) settings.sampler = ::render::sampler_from(options.sampler);
  mc::require(!options.max_depth || *options.max_depth == -1 || *options.max_depth >= 1,
              "--max-depth {} must be -1 or at least 1", options.max_depth.value_or(0));
  settings.max_depth = options.max_depth.value_or(defaults.max_depth);
  mc::require(options.threads >= 0, "--threads {} must be >= 0", options.threads);
  settings.threads = options.threads;
  settings.seed = options.seed;
  mc::require(options.intervals.empty() || settings.spp > 1 || settings.seconds || settings.target_error,
              "--intervals: one sample per pixel has no error bar; take two or more");
  return settings;
}

int render(const RenderOptions& options) {
  if (options.help_scene) {
    std::fputs(::render::mitsuba::reference().c_str(), stdout);
    return exit_ok;
  }
  mc::require(!options.scene.empty(), "render: SCENE is required (see carlo render --help)");
  const std::string output =
      options.output.empty() ? std::filesystem::path(options.scene).stem().string() + ".exr" : options.output;
  check_output(output);
  if (!options.intervals.empty()) check_output(options.intervals);

  const auto [scene, defaults] = ::render::read_mitsuba(options.scene, ::render::dialect_from(options.dialect));
  if (scene.lights().empty())
    std::fprintf(stderr, "carlo: warning: %s has no light; the image will be black\n", options.scene.c_str());

  warn_where_coarse(options.scene, scene);

  ::render::RenderOptions settings = settings_of(options, defaults);
  Progress progress;
  std::mutex mutex;
  settings.progress = [&](const ::render::Progress& p) {
    const std::lock_guard lock(mutex);
    progress.show(p.fraction, fmt::format("{}samples/s{}", format_count(double(p.samples) / p.seconds),
                                          std::isfinite(p.relative_error)
                                              ? fmt::format("  error {:.2f} %, {:.1f} % of the pixels undecided",
                                                            100 * p.relative_error, 100 * p.undecided)
                                              : ""));
  };

  const Interrupt interrupt;
  settings.cancel = interrupt.flag();
  ::render::RenderResult result = ::render::render(scene, settings);
  progress.clear();

  if (result.invalid > 0) {
    const auto& w = result.first_invalid;
    const std::string what =
        fmt::format("{} of {} samples are not finite; the first: pixel ({}, {}), pass {}, sample {}, seed {}",
                    result.invalid, result.samples, w.x, w.y, w.pass, w.index, options.seed);
    mc::require(options.allow_invalid, "{}: {}; nothing was written (--allow-invalid writes the image without them)",
                options.scene, what);
    std::fprintf(stderr, "carlo: warning: %s\n", what.c_str());
  }

  auto& metadata = result.image.metadata;
  metadata["carlo.command"] = options.command;
  metadata["carlo.commit"] = fmt::format("{} ({})", version, commit);
  metadata["carlo.seed"] = fmt::format("{}", options.seed);
  metadata["carlo.samples_per_pixel"] = fmt::format("{:.6g}", result.spp);
  metadata["carlo.invalid_samples"] = fmt::format("{}", result.invalid);
  if (result.partial) metadata["carlo.partial"] = "interrupted before the end";
  ::render::write_image(output, result.image, options.exposure);
  if (!options.intervals.empty() && !result.image.variance.empty())
    ::render::write_image(options.intervals, ::render::half_widths(result.image, 0.95));

  std::printf("%s: %dx%d, %.4g samples/pixel in %s (%s CPU): %ssamples/s, %srays/s, mean relative standard error %s, "
              "%llu invalid samples%s%s\n",
              output.c_str(), result.image.width, result.image.height, result.spp,
              format_seconds(result.seconds).c_str(), format_seconds(result.cpu_seconds).c_str(),
              format_count(double(result.samples) / result.seconds).c_str(),
              format_count(double(result.rays) / result.seconds).c_str(), format_error(result).c_str(),
              static_cast<unsigned long long>(result.invalid),
              result.undecided > 0
                  ? fmt::format(", {:.1f} % of the pixels decided by one sample", 100 * result.undecided).c_str()
                  : "",
              result.partial ? ", PARTIAL: interrupted" : "");
  return result.partial ? exit_interrupted : exit_ok;
}

} // namespace

Subcommand render_subcommand() {
  return make_subcommand<RenderOptions>("render", "Render a Mitsuba XML scene to EXR, PFM or PNG, with an error bar",
                                        rows, render);
}

} // namespace carlo

#include <gallery/scenes.h>
#include <gallery/strategy_strip.h>
#include <options/pixels.h>
#include <options/subcommand.h>
#include <picture/picture.h>
#include <picture/resume.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>

#include <render/film/interval.h>
#include <render/io/image/image_io.h>
#include <render/io/mesh_scene.h>
#include <render/io/mitsuba/mitsuba.h>
#include <render/io/mitsuba/plugins/reference.h>
#include <render/layers.h>
#include <render/render.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <string_view>
#include <tuple>

namespace carlo {

namespace {

struct RenderOptions {
  std::string scene;                  ///< a file, or the name of a scene of the gallery
  bool help_scene = false;            ///< print the reference of scene files, and stop
  std::string dialect = "mitsuba";    ///< whose defaults hold in the scene
  std::vector<std::string> variables; ///< "name=value" of the scene's $name
  std::string output;                 ///< empty: the scene's name with .exr in the current folder
  std::optional<int> spp;             ///< samples per pixel
  std::optional<double> seconds;      ///< wall-clock budget [s]
  std::optional<double> target_error; ///< mean relative standard error to reach
  std::string error_of;               ///< of what; empty: picture
  std::string adaptive;               ///< on or off; empty: on with --time and --target-error
  std::string intervals;              ///< file for the half widths of 95 % intervals; empty: none
  std::string size;                   ///< "WxH"; empty: the scene's
  std::string crop;                   ///< "X,Y,W,H"; empty: all of it
  std::string strategy, sampler;      ///< empty: bidirectional, sobol
  std::optional<int> max_depth;       ///< longest path in edges; -1: unlimited
  std::optional<int> branches;        ///< of a path; none: librender's
  std::uint64_t seed = 0;
  int threads = 0;      ///< 0: all
  bool splat = false;   ///< samples count for all pixels under the filter
  bool tiles = false;   ///< pixels share paths by tiles
  std::string tone;     ///< of a PNG; empty: the gallery's, or clamp
  std::string exposure; ///< of a PNG: stops, or auto; empty: the gallery's, or 0
  bool layers = false;  ///< EXR only: more channels
  bool resume = false;  ///< add to the picture that is there
  bool compare_strategies = false;
  bool allow_invalid = false; ///< write the image although samples were not finite
  std::string command;        ///< the command line, for the metadata
};

::render::Variables parse_variables(const std::vector<std::string>& texts) {
  ::render::Variables variables;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    mc::require(equals != std::string::npos && equals > 0, "-D '{}' must be NAME=VALUE, e.g. -D spp=16", text);
    const auto [at, added] = variables.emplace(text.substr(0, equals), text.substr(equals + 1));
    mc::require(added, "-D {}: it has the value '{}' already", text, at->second);
  }
  return variables;
}

::render::SceneFile read_scene(const std::string& file, const RenderOptions& options) {
  const ::render::Variables variables = parse_variables(options.variables);
  if (!::render::is_mesh_file(file))
    return ::render::read_mitsuba(file, ::render::dialect_from(options.dialect), variables);
  mc::require(variables.empty(), "-D: a mesh alone, as '{}', has no variables", file);
  return ::render::read_mesh_scene(file);
}

std::string output_of(const RenderOptions& options) {
  if (!options.output.empty()) return options.output;
  const std::string name = std::filesystem::path(options.scene).stem().string();
  return name + (options.compare_strategies ? "-strategies.png" : ".exr");
}

// The folder is looked at before hours of rendering, not after.
void check_output(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  mc::require(folder.empty() || std::filesystem::is_directory(folder),
              "cannot write '{}': the folder '{}' does not exist; create it first", path, folder.string());
  const std::string extension = mc::extension_of(path);
  mc::require(extension == ".exr" || extension == ".pfm" || extension == ".png",
              "cannot write '{}': unknown image format '{}'; use .exr, .pfm or .png", path, extension);
}

std::vector<Option> rows(RenderOptions& o) {
  return {
      {"SCENE", "FILE", &o.scene,
       "Scene file (Mitsuba XML), mesh alone (.obj, .ply, .serialized), or a name that carlo gallery --list shows"},
      {"--help-scene", "", &o.help_scene, "Print what a scene file may hold, as Markdown, and stop"},
      {"--dialect", "NAME", &o.dialect, "Whose defaults hold in the scene: mitsuba or lajolla"},
      {"-D", "NAME=VALUE", &o.variables, "The value of $NAME in the scene, whatever its own default; may be repeated"},
      {"-o,--output", "FILE", &o.output,
       "Image to write: .exr (radiance and variance), .pfm or .png (sRGB) [SCENE.exr here]"},
      {"--spp", "N", &o.spp, "Samples per pixel; or --time, --target-error, or both of these [the scene's]"},
      {"--time", "SECONDS", &o.seconds, "Wall-clock time to spend", false, {"--spp"}},
      {"--target-error",
       "RATIO",
       &o.target_error,
       "Mean relative standard error to reach: the pixels' standard errors relative to the radiance about them, in the "
       "dark to half of the picture's mean, root mean square, with 95 % confidence; it goes on below that while in "
       "more than 5 % of the pixels one sample carries over half of the variance, so that their errors are not known, "
       "which may take long: --time bounds it",
       false,
       {"--spp"}},
      {"--error-of", "picture|worst", &o.error_of,
       "The error that counts: of the picture, or of its worst 16x16 block [picture]"},
      {"--adaptive", "on|off", &o.adaptive,
       "Samples where the error is, as a first quarter has seen it, or evenly [off with --spp, else on]"},
      {"--intervals", "FILE", &o.intervals, "Write half the widths of the pixels' 95 % intervals to this image"},
      {"--size", "WxH", &o.size, "Image size in pixels [the scene's]"},
      {"--crop", "X,Y,W,H", &o.crop,
       "Only this part of the picture, from the pixel X, Y counted from the upper left corner: with --spp the same "
       "pixels, bit for bit"},
      {"--strategy", "NAME", &o.strategy,
       fmt::format("{}; light misses what other surfaces and the sky send [bidirectional]",
                   fmt::join(::render::strategy_names(), ", "))},
      {"--sampler", "NAME", &o.sampler, "independent, stratified or sobol [sobol]"},
      {"--splat", "", &o.splat,
       "Samples count for all pixels under the scene's filter about them, not for one: of filters wider than a pixel "
       "less noise, which neighbours share (a Gaussian of .5 pixels: a third of the variance); spent evenly"},
      {"--tiles",
       "",
       &o.tiles,
       "2x2 pixels share the light that their paths find to leave diffuse surfaces: about half the time to an error in "
       "rooms of diffuse walls, with noise that the four share",
       false,
       {"--splat"}},
      {"--max-depth", "N", &o.max_depth,
       "Longest path in edges (1: light seen directly), -1 for no limit [the scene's]"},
      {"--branches",
       "N",
       &o.branches,
       "Ways on from where a path first meets a surface that is no mirror or glass: more samples a second with 1, less "
       "time to an error with 2 [2]",
       false,
       {"--tiles"}},
      {"--resume",
       "",
       &o.resume,
       "Add to the EXR that is there, of the same scene, size and so on, by the numbers of samples: --spp and --time "
       "are of what is added",
       false,
       {"--target-error", "--intervals"}},
      {"--seed", "N", &o.seed, "Seed; same seed, same bits, whatever the number of threads"},
      {"--threads", "N", &o.threads, "Threads, 0 for all of the machine's"},
      {"--layers", "", &o.layers,
       "Add channels to an EXR: normal N, position P, depth Z, albedo, shape id, each where the middle of the pixel "
       "is"},
      {"--tone", "CURVE", &o.tone,
       "What a PNG does with bright light: clamp, reinhard or filmic [a gallery scene's own]"},
      {"--exposure", "STOPS", &o.exposure,
       "Brightness added before a PNG is written, or auto: middle grey in the middle [0; a gallery scene's own]"},
      {"--compare-strategies",
       "",
       &o.compare_strategies,
       "Print every strategy's error with the same samples and in the same --time (or the mean of what those samples "
       "took), and write a PNG of their pictures with 1, 4, 16, 64, 256 and 1024 samples per pixel, a row for each; "
       "small, unless there is --size",
       false,
       {"--resume", "--layers", "--intervals", "--target-error"}},
      {"--allow-invalid", "", &o.allow_invalid, "Write the image although some samples were not finite"},
  };
}

bool is(const std::string& path, const char* extension) { return mc::extension_of(path) == extension; }

// How a PNG is made, but for an exposure that the picture decides.
::render::Tone tone_of(const RenderOptions& options, const GalleryScene* named) {
  ::render::Tone tone = named ? tone_of(*named) : ::render::Tone();
  if (!options.tone.empty()) tone.curve = ::render::tone_curve_from(options.tone);
  if (options.exposure.empty() || options.exposure == "auto") return tone;
  char rest = 0;
  mc::require(std::sscanf(options.exposure.c_str(), "%lf%c", &tone.exposure, &rest) == 1 &&
                  std::abs(tone.exposure) <= 100,
              "--exposure '{}' must be a number of stops in [-100, 100], or auto", options.exposure);
  return tone;
}

// The pixels that are asked for.
::render::Crop part_of(const ::render::RenderOptions& settings) {
  return settings.crop.value_or(::render::Crop{0, 0, settings.width, settings.height});
}

// A word that is neither a file nor looks like one is a scene of the gallery.
const GalleryScene* named_scene(const std::string& word) {
  const bool is_file = word.find_first_of("./") != std::string::npos || std::filesystem::exists(word);
  return is_file ? nullptr : &gallery_scene(word);
}

// What the scene asks for, where the command does not say otherwise.
::render::RenderOptions settings_of(const RenderOptions& options, const ::render::RenderDefaults& defaults,
                                    const GalleryScene* named) {
  ::render::RenderOptions settings;
  if (named && !named->strategy.empty()) settings.strategy = ::render::strategy_from(named->strategy);
  if (named && !named->sampler.empty()) settings.sampler = ::render::sampler_from(named->sampler);
  settings.width = defaults.width;
  settings.height = defaults.height;
  if (!options.size.empty()) std::tie(settings.width, settings.height) = size_in(options.size);
  if (!options.crop.empty()) settings.crop = crop_in(options.crop);
  settings.spp = options.spp.value_or(named && named->spp > 0 ? named->spp : defaults.spp);
  settings.seconds = options.seconds;
  settings.target_error = options.target_error;
  mc::require(options.error_of.empty() || options.error_of == "picture" || options.error_of == "worst",
              "--error-of '{}' must be picture or worst", options.error_of);
  if (options.error_of == "worst") settings.error_of = ::render::ErrorOf::worst;
  mc::require(options.adaptive.empty() || options.adaptive == "on" || options.adaptive == "off",
              "--adaptive '{}' must be on or off", options.adaptive);
  if (!options.adaptive.empty()) settings.adaptive = options.adaptive == "on";
  mc::require(!options.splat || options.adaptive != "on", "--splat spends samples evenly; leave out --adaptive on");
  settings.splat = options.splat;
  settings.tiles = options.tiles;
  if (!options.strategy.empty()) settings.strategy = ::render::strategy_from(options.strategy);
  if (!options.sampler.empty()) settings.sampler = ::render::sampler_from(options.sampler);
  mc::require(!options.max_depth || *options.max_depth == -1 || *options.max_depth >= 1,
              "--max-depth {} must be -1 or at least 1", options.max_depth.value_or(0));
  settings.max_depth = options.max_depth.value_or(defaults.max_depth);
  mc::require(!options.branches || (*options.branches >= 1 && *options.branches <= ::render::most_branches),
              "--branches {} must be 1 to {}", options.branches.value_or(0), ::render::most_branches);
  settings.branches = options.branches.value_or(settings.branches);
  settings.shown = defaults.shown;
  mc::require(options.threads >= 0, "--threads {} must be >= 0", options.threads);
  settings.threads = options.threads;
  settings.seed = options.seed;
  mc::require(options.intervals.empty() || settings.spp > 1 || settings.seconds || settings.target_error,
              "--intervals: one sample per pixel has no error bar; take two or more");
  return settings;
}

std::string where_it_is(const ::render::Progress& p, const std::optional<double>& target_error) {
  const std::string text = format_count(double(p.samples) / p.seconds) + "samples/s";
  if (!std::isfinite(p.relative_error)) return text;
  const bool goes_on = target_error && p.relative_error <= *target_error && p.undecided > ::render::most_undecided;
  if (goes_on) // short, to be seen on a narrow terminal
    return fmt::format("error reached, {:.1f} % undecided: on to {:.0f} %", 100 * p.undecided,
                       100 * ::render::most_undecided);
  return text +
         fmt::format("  error {:.2f} %, {:.1f} % of the pixels undecided", 100 * p.relative_error, 100 * p.undecided);
}

constexpr int compared_side = 96; // pixels

int compare_all(const RenderOptions& options, const ::render::Scene& scene, ::render::RenderOptions settings,
                const ::render::Tone& tone, const std::string& output) {
  if (options.size.empty()) settings = shrunk(settings, compared_side);
  const int side = std::max(settings.width, settings.height);
  mc::require(settings.spp >= 2, "--compare-strategies: one sample per pixel has no error; take two or more");
  mc::require(options.exposure != "auto", "--exposure auto is for one picture; give stops to --compare-strategies");
  mc::require(is(output, ".png"), "--compare-strategies: cannot write '{}'; name a .png", output);
  const Interrupt interrupt;
  settings.cancel = interrupt.flag();
  const auto start = std::chrono::steady_clock::now();
  const std::vector<StrategyResult> same_samples = compare_strategies(scene, settings, side, settings.spp);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  const auto count = double(std::max<std::size_t>(same_samples.size(), 1)); // none: interrupted
  const double seconds = settings.seconds.value_or(spent.count() / count);
  const std::vector<StrategyResult> same_time = compare_strategies_in(scene, settings, seconds);
  const ::render::Image strip = strategy_strip(scene, settings, tone);
  if (interrupt.flag()->load()) {
    fmt::print("interrupted: nothing was written\n");
    return exit_interrupted;
  }
  ::render::write_image(output, strip);
  fmt::print("{}x{}, {} samples per pixel; {:.3g} s\n{}{}: a row for each, with {} samples per pixel\n", settings.width,
             settings.height, settings.spp, seconds, strategy_table(same_samples, same_time), output,
             fmt::join(strip_spp, ", "));
  return exit_ok;
}

// A picture must not take the place of what the next one is made from.
void refuse_inputs(const std::set<std::string>& files, const RenderOptions& options, const std::string& output) {
  for (const std::string& input : files)
    for (const std::string& written : {output, options.intervals})
      mc::require(written.empty() || !mc::same_place(written, input),
                  "'{}' is a file of the scene and would be overwritten; name another with {}", written,
                  written == output ? "-o" : "--intervals");
}

void warn_where_light_is_missed(const ::render::Scene& scene, const ::render::RenderOptions& settings) {
  if (settings.shown.what == ::render::Shown::radiance && misses_light(scene, settings.strategy, settings.max_depth))
    std::fprintf(stderr,
                 "carlo: warning: the strategy %s looks towards lamps and guides alone: it misses what other "
                 "surfaces reflect and the sky; use mis\n",
                 std::string(settings.strategy.name).c_str());
}

int render(const RenderOptions& options) {
  if (options.help_scene) {
    std::fputs(::render::mitsuba::reference().c_str(), stdout);
    return exit_ok;
  }
  mc::require(!options.scene.empty(), "render: SCENE is required (see carlo render --help)");
  const std::string output = output_of(options);
  check_output(output);
  if (!options.intervals.empty()) {
    check_output(options.intervals);
    mc::require(!mc::same_place(options.intervals, output),
                "--intervals '{}' would overwrite the picture; name another file", options.intervals);
  }
  mc::require(!options.layers || is(output, ".exr"), "--layers: '{}' has no place for them; write an .exr", output);

  const GalleryScene* named = named_scene(options.scene);
  const std::string file = named ? scene_file(*named) : options.scene;
  const ::render::SceneFile read = read_scene(file, options);
  const auto& [scene, defaults, origin, warnings, files] = read;
  refuse_inputs(files, options, output);
  warn_of_departures(read);
  if (scene.lights().empty() && defaults.shown.what == ::render::Shown::radiance)
    std::fprintf(stderr, "carlo: warning: %s has no light; the image will be black\n", file.c_str());

  warn_where_coarse(file, scene);

  ::render::RenderOptions settings = settings_of(options, defaults, named);
  ::render::Tone tone = tone_of(options, named);
  if (options.compare_strategies) return compare_all(options, scene, settings, tone, output);
  mc::require(is(output, ".png") || (options.tone.empty() && options.exposure.empty()),
              "{}: '{}' keeps radiance as it is; write a .png", options.tone.empty() ? "--exposure" : "--tone", output);
  warn_where_light_is_missed(scene, settings);
  Progress progress;
  std::mutex mutex;
  if (progress.shows())
    settings.progress = [&](const ::render::Progress& p) {
      const std::lock_guard lock(mutex);
      progress.show(p.fraction, where_it_is(p, options.target_error));
    };

  const ::render::Crop part = part_of(settings);
  const PictureOf shown = picture_of(file, options.dialect, options.variables, read, settings, part);
  std::optional<Begun> begun;
  if (options.resume) begun = begun_picture(output, shown, part, settings);
  const Interrupt interrupt;
  settings.cancel = interrupt.flag();
  ::render::RenderResult result = ::render::render(scene, settings);
  progress.clear();

  if (begun ? result.estimates == 0 : result.missing_rows == result.image.height) {
    fmt::print("interrupted before {}; {} {}\n", begun ? "every pixel had a new sample" : "a row was rendered", output,
               begun ? "stays as it was" : "was not written");
    return exit_interrupted;
  }
  const Provenance from{file, options.command, options.seed};
  if (const std::string invalid = invalid_samples(result, from); !invalid.empty()) {
    mc::require(options.allow_invalid, "{}: {}; nothing was written (--allow-invalid writes the image without them)",
                file, invalid);
    std::fprintf(stderr, "carlo: warning: %s\n", invalid.c_str());
  }
  sign(result, from);
  for (const auto& [key, value] : shown) result.image.metadata[key] = value;
  if (begun) add_to(*begun, result);
  if (options.layers) {
    const ::render::Whole whole{settings.width, settings.height, part};
    result.image.layers = layers(scene, whole, origin, settings.threads);
  }
  if (options.exposure == "auto") tone.exposure = auto_exposure(result.image);
  ::render::write_image(output, result.image, tone);
  if (!options.intervals.empty() && !result.image.variance.empty())
    ::render::write_image(options.intervals, ::render::half_widths(result.image, 0.95));

  fmt::print("{}: {}", output, summary_of(result, options.target_error));
  if (begun)
    fmt::print("with what was there: {:.4g} samples/pixel of {} runs{}\n", begun->spp + result.spp, begun->runs + 1,
               result.image.variance.empty() ? ", without an error bar: one of them, of one sample, has none" : "");
  return result.partial ? exit_interrupted : exit_ok;
}

} // namespace

Subcommand render_subcommand() {
  return make_subcommand<RenderOptions>("render", "Render a Mitsuba XML scene to EXR, PFM or PNG, with an error bar",
                                        rows, render);
}

} // namespace carlo

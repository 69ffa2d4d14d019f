#include <cli/render.h>
#include <gallery/scenes.h>
#include <gallery/strategy_strip.h>
#include <options/files.h>
#include <options/memory_option.h>
#include <options/picture_output.h>
#include <options/pixels.h>
#include <options/run_session.h>
#include <picture/picture.h>
#include <picture/render_report.h>
#include <picture/resume.h>
#include <terminal/columns.h>
#include <terminal/file_lock.h>
#include <terminal/interrupt.h>
#include <terminal/message.h>
#include <terminal/progress.h>
#include <terminal/ranks.h>
#include <terminal/result_writer.h>

#include <render/film/confidence_interval.h>
#include <render/io/image/image_io.h>
#include <render/io/mesh/mesh_scene.h>
#include <render/io/mitsuba/mitsuba.h>
#include <render/io/mitsuba/plugins/reference.h>
#include <render/layers.h>
#include <render/render.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <tuple>

namespace carlo {

namespace {

render::Variables parse_variables(const std::vector<std::string>& texts) {
  render::Variables variables;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    mc::require(equals != std::string::npos && equals > 0, "-D '{}' must be NAME=VALUE, e.g. -D spp=16", text);
    const auto [at, added] = variables.emplace(text.substr(0, equals), text.substr(equals + 1));
    mc::require(added, "-D {}: {} has the value '{}' already", text, at->first, at->second);
  }
  return variables;
}

render::SceneFile read_scene(const std::string& file, const RenderCommandOptions& options) {
  const render::Variables variables = parse_variables(options.variables);
  if (!render::is_mesh_file(file)) return render::read_mitsuba(file, render::dialect_from(options.dialect), variables);
  mc::require(variables.empty(), "-D: '{}' is a mesh alone, which has no variables", file);
  return render::read_mesh_scene(file);
}

bool is_picture(const std::string& path) { return mc::lowercase_extension(path) == ".exr"; }

// Whether the run adds to a picture.
bool resumes_picture(const RenderCommandOptions& o) { return o.resume && (o.resume->empty() || is_picture(*o.resume)); }

std::string output_of(const RenderCommandOptions& options) {
  if (!options.output.empty()) return options.output;
  if (resumes_picture(options) && !options.resume->empty()) return *options.resume;
  const std::string name = std::filesystem::path(options.scene).stem().string();
  return name + (options.compare_strategies ? "-strategies.png" : ".exr");
}

bool has_extension(const std::string& path, const char* extension) {
  return mc::lowercase_extension(path) == extension;
}

// The tone of a PNG, except for an exposure that depends on the picture.
render::ToneMapping tone_of(const RenderCommandOptions& options, const GalleryScene* named) {
  return parse_tone(options.tone, options.exposure, named ? tone_of(*named) : render::ToneMapping());
}

// The pixels to render.
render::Crop crop_of(const render::RenderOptions& settings) {
  return settings.crop.value_or(render::Crop{0, 0, settings.width, settings.height});
}

// A word that is neither a file nor looks like one is a scene of the gallery.
const GalleryScene* named_scene(const std::string& word) {
  const bool is_file = word.find_first_of("./") != std::string::npos || std::filesystem::exists(word);
  return is_file ? nullptr : &gallery_scene(word);
}

// None if the option is not given.
std::optional<bool> on_or_off(std::string_view option, const std::string& word) {
  mc::require(word.empty() || word == "on" || word == "off", "{} '{}' must be on or off", option, word);
  return word.empty() ? std::nullopt : std::optional(word == "on");
}

// The settings of the scene, overridden by those of the command line.
render::RenderOptions settings_of(const RenderCommandOptions& options, const render::RenderDefaults& defaults,
                                  const GalleryScene* named) {
  render::RenderOptions settings;
  if (named && !named->strategy.empty()) settings.strategy = render::strategy_from(named->strategy);
  if (named && !named->sampler.empty()) settings.sampler = render::sampler_from(named->sampler);
  settings.width = defaults.width;
  settings.height = defaults.height;
  if (!options.size.empty()) std::tie(settings.width, settings.height) = parse_size(options.size);
  if (!options.crop.empty()) settings.crop = parse_crop(options.crop);
  settings.spp = options.spp.value_or(named && named->spp > 0 ? named->spp : defaults.spp);
  settings.seconds = options.seconds;
  settings.target_error = options.target_error;
  mc::require(options.error_of.empty() || options.error_of == "picture" || options.error_of == "worst",
              "--error-of '{}' must be picture or worst", options.error_of);
  if (options.error_of == "worst") settings.error_scope = render::ErrorScope::worst_block;
  settings.adaptive = on_or_off("--adaptive", options.adaptive).value_or(settings.adaptive);
  settings.splat = on_or_off("--splat", options.splat).value_or(settings.splat);
  settings.tiles = on_or_off("--tiles", options.tiles);
  mc::require(!settings.tiles.value_or(false) || !options.branches,
              "--tiles on and --branches exclude each other: a tile shares one continuation of each path; leave one "
              "out");
  if (!options.strategy.empty()) settings.strategy = render::strategy_from(options.strategy);
  if (!options.sampler.empty()) settings.sampler = render::sampler_from(options.sampler);
  mc::require(!options.max_depth || *options.max_depth == -1 || *options.max_depth >= 1,
              "--max-depth {} must be -1 or at least 1", options.max_depth.value_or(0));
  settings.max_depth = options.max_depth.value_or(defaults.max_depth);
  mc::require(!options.branches || (*options.branches >= 1 && *options.branches <= render::max_branches),
              "--branches {} must be 1 to {}", options.branches.value_or(0), render::max_branches);
  settings.branches = options.branches;
  settings.aov = defaults.aov;
  mc::require(options.threads >= 0, "--threads {} must be >= 0", options.threads);
  settings.threads = options.threads;
  settings.seed = options.seed;
  mc::require(options.intervals.empty() || settings.spp > 1 || settings.seconds || settings.target_error,
              "--intervals: one sample per pixel has no error bar; take two or more");
  return settings;
}

// Parts of a progress line, the most important one first.
std::string progress_text(const render::Progress& p, bool has_target) {
  const std::string rate = format_count(double(p.samples) / p.seconds) + "samples/s";
  if (!std::isfinite(p.error.value)) return rate;
  const std::string bound = has_target ? fmt::format("  at most {:.2f} %", 100 * p.error.bound) : "";
  return fmt::format("error {:.2f} %{}  {}", 100 * p.error.value, bound, rate);
}

// Throws Error where the pixels, and `more` bytes, need more memory than is allowed.
void require_memory(const render::Scene& scene, const render::RenderOptions& settings, double more = 0) {
  const render::Crop part = crop_of(settings);
  mc::require_memory(render::memory_needed(scene, settings) + more,
                     fmt::format("render: {}x{} pixels", part.width, part.height),
                     "a smaller --size or --crop needs less");
}

constexpr int compared_side = 96; // pixels

int compare_all(const RenderCommandOptions& options, const render::Scene& scene, render::RenderOptions settings,
                const render::ToneMapping& tone, const std::string& output) {
  if (options.size.empty()) settings = shrink_to_fit(settings, compared_side);
  const int side = std::max(settings.width, settings.height);
  mc::require(settings.spp >= 2, "--compare-strategies: one sample per pixel has no error bar; take two or more");
  mc::require(options.exposure != "auto", "--exposure auto is for one picture; give stops to --compare-strategies");
  mc::require(has_extension(output, ".png"), "--compare-strategies: cannot write '{}'; name a .png", output);
  require_memory(scene, settings, strategy_strip_memory(scene, settings));
  const Interrupt interrupt;
  settings.cancel = interrupt.flag();
  const auto start = std::chrono::steady_clock::now();
  const std::vector<StrategyResult> same_samples = compare_strategies(scene, settings, side, settings.spp);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  const auto count = double(std::max<std::size_t>(same_samples.size(), 1)); // none: interrupted
  const double seconds = settings.seconds.value_or(spent.count() / count);
  const std::vector<StrategyResult> same_time = compare_strategies_for_time(scene, settings, seconds);
  const render::Image strip = strategy_strip(scene, settings, tone);
  if (interrupt.flag()->load()) {
    fmt::print("interrupted: nothing was written\n");
    return exit_interrupted;
  }
  ResultWriter results;
  results.write(output, false, [&](const std::string& file) { render::write_image(file, strip); });
  results.finish();
  fmt::print("{}x{}, {} samples per pixel; {:.3g} s\n{}{}: a row for each strategy, with {} samples per pixel\n",
             settings.width, settings.height, settings.spp, seconds, strategy_table(same_samples, same_time), output,
             fmt::join(strip_spp, ", "));
  return exit_ok;
}

// Throws Error where an output would overwrite a file of the scene, or the other output.
void refuse_inputs(const std::set<std::string>& files, const RenderCommandOptions& options, const std::string& output) {
  std::vector<UsedFile> used = {{output, "-o", true}};
  if (!options.intervals.empty()) used.push_back({options.intervals, "--intervals", true});
  for (const std::string& file : files) used.push_back({file, "a file of the scene"});
  require_distinct_files(used);
}

// Returns the text of missing_light_text(), for the metadata.
std::string warn_where_light_is_missed(const render::SceneFile& read, const render::RenderOptions& settings) {
  if (settings.aov.kind != render::Aov::radiance) return {};
  if (misses_light(read.scene, settings.strategy, settings.max_depth))
    warn("the strategy {} takes directions toward lights and importance targets only: it misses the light of other "
         "surfaces and of the sky; use mis",
         settings.strategy.name);
  std::string missing = missing_light_text(read, settings.strategy, settings.max_depth);
  if (!missing.empty()) warn("{}", missing);
  return missing;
}

// Throws Error for outputs that cannot be written.
void check_outputs(const RenderCommandOptions& options, const std::string& output) {
  require_picture_output(output);
  if (!options.intervals.empty()) require_picture_output(options.intervals);
  mc::require(!options.layers || has_extension(output, ".exr"), "--layers: '{}' cannot store them; write an .exr",
              output);
}

// Writes the picture and its intervals. Returns the name of the picture's file.
//   partial result : does not replace a picture, unless the run went on from it, or it is partial and no better.
std::string write_results(const RenderCommandOptions& options, const std::string& output,
                          const render::RenderResult& result, bool is_resumed, const render::ToneMapping& tone) {
  const auto spp_of = [&](const std::string& file) { return spp_of_partial(file, result.image.metadata); };
  const bool is_partial = result.partial && !is_resumed &&
                          !(spp_of(output).value_or(HUGE_VAL) <= result.spp); // else it goes on or is better
  const bool is_lesser =
      is_partial && std::filesystem::is_regular_file(output) && spp_of(partial_path(output)).value_or(0) > result.spp;
  ResultWriter results;
  std::string written = partial_path(output);
  if (is_lesser) print_message(fmt::format("'{}' has more samples; nothing was written", written));
  else
    written = results.write(output, is_partial,
                            [&](const std::string& file) { render::write_image(file, result.image, tone); });
  if (!is_lesser && !options.intervals.empty() && !result.image.variance.empty()) {
    const render::Image intervals = render::interval_half_widths(result.image, 0.95);
    results.write(options.intervals, is_partial,
                  [&](const std::string& file) { render::write_image(file, intervals); });
  }
  results.finish();
  return written;
}

// The picture that the run adds to; "" if there is none.
std::string picture_to_resume(const RenderCommandOptions& o, const std::string& output) {
  if (!resumes_picture(o)) return {};
  return o.resume->empty() ? output : *o.resume;
}

// The files of checkpoints. A picture to go on from is none.
CheckpointFiles checkpoint_files(const RenderCommandOptions& o) {
  CheckpointFiles files = o.checkpoint;
  if (o.resume && !resumes_picture(o)) files.resume = *o.resume;
  return files;
}

// Throws Error for options that exclude each other where a run goes on.
void refuse_contradictions(const RenderCommandOptions& o) {
  mc::require(!o.scene.empty(), "render: SCENE is required{} (see carlo render --help)",
              o.resume && !o.resume->empty() ? "; it stands before --resume, which takes '" + *o.resume + "'" : "");
  if (!resumes_picture(o)) return;
  constexpr const char* reason = "--resume of a picture averages runs, and {} is that of a single run; leave one out";
  mc::require(!o.target_error, reason, "--target-error");
  mc::require(o.intervals.empty(), reason, "--intervals");
  mc::require(o.checkpoint.checkpoint.empty(), reason, "--checkpoint");
  mc::require(!o.checkpoint.is_part() && o.checkpoint.merged.empty(), reason, "--part");
}

// A picture to render, and its outputs.
struct RenderWork {
  const RenderCommandOptions& options;
  const render::SceneFile& read;
  const RenderFingerprint& fingerprint;
  std::string file, output; // of the scene and of the picture
  bool replaces_resumed;    // whether the picture of --resume is the output
  std::optional<ResumeState> resumed;
  render::ToneMapping tone;
  std::string missing_light; // see warn_where_light_is_missed()
};

// Completes the picture, and writes it. Returns the exit code.
int write_picture(RenderWork& work, render::RenderResult& result, const render::RenderOptions& settings) {
  const auto& [options, read, fingerprint, file, output, replaces_resumed, resumed, tone, missing_light] = work;
  if (resumed ? result.estimates == 0 : result.missing_rows == result.image.height) {
    fmt::print("interrupted before {}; {} {}\n", resumed ? "every pixel had a new sample" : "a row was rendered",
               output, resumed ? "is unchanged" : "was not written");
    return exit_interrupted;
  }
  const Provenance from{file, options.command, options.seed};
  if (const std::string invalid = invalid_samples_text(result, from); !invalid.empty()) {
    mc::require(options.allow_invalid, "{}: {}; nothing was written (--allow-invalid writes the image without them)",
                file, invalid);
    warn("{}", invalid);
  }
  add_metadata(result, from);
  if (!missing_light.empty()) result.image.metadata["carlo.missing_light"] = missing_light;
  for (const auto& [key, value] : fingerprint) result.image.metadata[key] = value;
  if (resumed) accumulate_into(*resumed, result);
  if (options.layers) {
    const render::ImageExtent extent{settings.width, settings.height, crop_of(settings)};
    result.image.layers = layers(read.scene, extent, read.origin, settings.threads);
  }
  if (options.exposure == "auto") work.tone.exposure = auto_exposure(result.image);
  const std::string written = write_results(options, output, result, replaces_resumed, tone);

  fmt::print("{}", render_summary(written, result, options.target_error));
  if (resumed)
    fmt::print("  with the earlier runs: {:.4g} samples per pixel of {} runs{}\n", resumed->spp + result.spp,
               resumed->runs + 1, result.image.variance.empty() ? "; no error bar, as one run took one sample" : "");
  return result.partial ? exit_interrupted : exit_ok;
}

int run_render(const RenderCommandOptions& options) {
  if (options.help_scene || options.list_strategies) {
    fmt::print("{}",
               options.help_scene ? render::mitsuba::reference() : strategies_text(terminal_columns(STDOUT_FILENO)));
    return exit_ok;
  }
  refuse_contradictions(options);
  limit_memory(options.memory);
  const std::string output = output_of(options);
  if (!options.checkpoint.is_part()) check_outputs(options, output);

  const GalleryScene* named = named_scene(options.scene);
  const std::string file = named ? scene_file(*named) : options.scene;
  const render::SceneFile read = read_scene(file, options);
  const render::Scene& scene = read.scene;
  refuse_inputs(read.files, options, output);
  warn_about_scene_file(read);
  if (scene.lights().empty() && read.defaults.aov.kind == render::Aov::radiance)
    warn("{} has no light; the image will be black", file);

  warn_if_imprecise(file, scene);

  render::RenderOptions settings = settings_of(options, read.defaults, named);
  const render::ToneMapping tone = tone_of(options, named);
  if (options.compare_strategies) return compare_all(options, scene, settings, tone, output);
  mc::require(options.checkpoint.is_part() || has_extension(output, ".png") ||
                  (options.tone.empty() && options.exposure.empty()),
              "{}: '{}' stores radiance as it is; write a .png", options.tone.empty() ? "--exposure" : "--tone",
              output);
  const std::string missing_light = warn_where_light_is_missed(read, settings);
  const render::Crop part = crop_of(settings);
  ProgressLine progress;
  std::optional<RenderReport> report;
  if (!options.report.empty() && rank() == 0)
    report.emplace(options.report, std::filesystem::path(file).filename().string(), options.command, part);
  if (progress.is_visible() || report)
    settings.progress = [&](const render::Progress& p) {
      if (progress.is_visible()) progress.show(p.fraction, progress_text(p, options.target_error.has_value()));
      if (report) report->show(p);
    };

  const RenderFingerprint fingerprint =
      render_fingerprint(file, options.dialect, options.variables, read, settings, part);
  std::optional<FileLock> lock; // until the new picture is written
  std::optional<ResumeState> resumed;
  RunSession session(checkpoint_files(options), render_identity(fingerprint, settings), output, options.command);
  const std::string picture = picture_to_resume(options, output);
  if (!picture.empty() && std::filesystem::exists(picture)) lock.emplace(picture);
  if (!picture.empty()) resumed = load_resume_state(picture, fingerprint, part, settings);
  const Interrupt interrupt;
  settings.cancel = interrupt.flag();
  settings.checkpoint = session.checkpoint();
  settings.executor = session.executor();
  require_memory(scene, settings);
  RenderWork work{options, read, fingerprint, file, output, picture == output, std::move(resumed), tone, missing_light};
  return session.run([&] {
    render::RenderResult result = render::render(read.scene, settings);
    progress.clear();
    if (result.partial) print_how_to_resume(checkpoint_files(options));
    session.before_results();
    const int code = write_picture(work, result, settings);
    if (report) report->finish(result);
    return code;
  });
}

} // namespace

Subcommand render_subcommand() {
  return make_subcommand<RenderCommandOptions>(render_about(), render_rows, run_render);
}

} // namespace carlo

#include <gallery/contact_sheet.h>
#include <gallery/page.h>
#include <input/file_hash.h>
#include <options/checkpoint_options.h>
#include <options/files.h>
#include <options/memory_option.h>
#include <options/run_session.h>
#include <options/subcommand.h>
#include <picture/picture.h>
#include <picture/resume.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>
#include <terminal/result_writer.h>

#include <render/io/image/image_io.h>
#include <render/io/mitsuba/mitsuba.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <set>

namespace carlo {

namespace {

struct GalleryCommandOptions {
  std::vector<std::string> names; ///< empty: all
  std::string output = "out/gallery";
  bool list = false, table = false;
  std::optional<int> spp;
  std::optional<double> seconds, target_error; ///< of each scene
  double scale = 1;                            ///< factor of width and height
  std::uint64_t seed = 0;
  int thumbnail_side = 64; ///< pixels
  int threads = 0;
  std::optional<double> memory; ///< [GiB]
  CheckpointFiles checkpoint;
  std::string command;
};

/// A scene that was read and is not rendered yet.
struct SceneJob {
  const GalleryScene* scene;
  render::SceneFile file;
  render::RenderOptions settings;
  double work = 0; ///< number of samples; 1 where it is unknown
};

std::vector<Option> rows(GalleryCommandOptions& o) {
  OptionGroup expert{expert_options,
                     {
                         {"--seed", "N", &o.seed, "Seed of the random numbers. The same seed gives the same bits."},
                         {"--threads", "N", &o.threads, "Threads; 0 is all processors."},
                         {"--thumbnails", "PIXELS", &o.thumbnail_side,
                          "Width of the pictures in sheet.png. From 256 on each has its name below it."},
                         {"--table", "", &o.table, "Print which scene requires which feature as Markdown, and stop."},
                         memory_option(o.memory),
                         resume_row(o.checkpoint),
                     }};
  const std::vector<Option> files = checkpoint_rows(o.checkpoint, {"--time"});
  expert.options.insert(expert.options.end(), files.begin(), files.end());
  const Exclusion counted{"--spp", "--time and --target-error choose the number of samples"};
  return in_groups({
      {common_options,
       {
           {"NAME", "NAME", &o.names, "Scenes, see --list. Default: all."},
           output_folder(
               {"-o,--output", "FOLDER", &o.output, "Folder for the pictures (EXR and PNG), index.html and sheet.png."},
               {"index.html", "sheet.png"}),
           {"--spp", "N", &o.spp, "Samples per pixel. Default: each scene's."},
           {"--time", "SECONDS", &o.seconds, "Wall-clock time for each scene.", false, {counted}},
           {"--target-error",
            "RATIO",
            &o.target_error,
            "Mean relative standard error of the pixels to reach, see carlo render; --time bounds it.",
            false,
            {counted}},
           {"--scale", "RATIO", &o.scale, "Size of the pictures relative to the scenes' own, in (0, 4]."},
           {"--list", "", &o.list, "List the scenes, and stop."},
       }},
      expert,
  });
}

int list_scenes() {
  for (const GalleryScene& scene : gallery()) fmt::print("{:<32} {} ({})\n", scene.name, scene.title, scene.source);
  return exit_ok;
}

// The named scenes without duplicates, since files and parts of the page have the names of scenes.
std::vector<const GalleryScene*> chosen_scenes(const GalleryCommandOptions& o) {
  std::vector<const GalleryScene*> scenes;
  for (const std::string& name : o.names) {
    const GalleryScene* scene = &gallery_scene(name);
    if (std::find(scenes.begin(), scenes.end(), scene) == scenes.end()) scenes.push_back(scene);
  }
  if (o.names.empty())
    for (const GalleryScene& scene : gallery()) scenes.push_back(&scene);
  return scenes;
}

int scaled(int pixels, double scale) { return std::max(1, static_cast<int>(std::lround(pixels * scale))); }

SceneJob read(const GalleryScene& scene, const GalleryCommandOptions& o, const std::atomic<bool>* cancel) {
  SceneJob a{&scene, render::read_mitsuba(scene_file(scene)), {}};
  a.settings.width = scaled(a.file.defaults.width, o.scale);
  a.settings.height = scaled(a.file.defaults.height, o.scale);
  a.settings.spp = o.spp.value_or(scene.spp > 0 ? scene.spp : a.file.defaults.spp);
  a.settings.max_depth = a.file.defaults.max_depth;
  a.settings.aov = a.file.defaults.aov;
  a.settings.seconds = o.seconds;
  a.settings.target_error = o.target_error;
  a.settings.seed = o.seed;
  a.settings.threads = o.threads;
  a.settings.cancel = cancel;
  if (!scene.strategy.empty()) a.settings.strategy = render::strategy_from(scene.strategy);
  if (!scene.sampler.empty()) a.settings.sampler = render::sampler_from(scene.sampler);
  const bool counted = !o.seconds && !o.target_error;
  a.work = counted ? double(a.settings.width) * a.settings.height * a.settings.spp : 1;
  return a;
}

RenderedScene report(const SceneJob& a, const render::RenderResult& result) {
  RenderedScene r;
  r.scene = a.scene;
  r.width = result.image.width;
  r.height = result.image.height;
  r.spp = result.spp;
  r.seconds = result.seconds;
  r.samples_per_second = double(result.samples) / result.seconds;
  r.relative_error = result.relative_error;
  r.outlier_dominated = result.outlier_dominated;
  r.strategy = a.settings.strategy.name;
  r.sampler = name(a.settings.sampler);
  r.features = features_of(*a.scene);
  return r;
}

constexpr int most_columns = 12, sheet_width = 1280; // of sheet.png
constexpr int least_named = 256;                     // pixels of a picture with its name

/// Renders one scene after the other.
class GalleryRun {
 public:
  GalleryRun(const GalleryCommandOptions& options, std::filesystem::path folder, const std::atomic<bool>* cancel)
      : options_(options), folder_(std::move(folder)), cancel_(cancel) {}

  // Reads all scenes: a bad file is reported before any rendering.
  void read_all(const std::vector<const GalleryScene*>& scenes) {
    for (const GalleryScene* scene : scenes) {
      jobs_.push_back(read(*scene, options_, cancel_));
      work_ += jobs_.back().work;
    }
    refuse_inputs();
  }

  void render_all(const RunSession& session) {
    mc::Checkpoint* const checkpoint = session.checkpoint();
    const mc::Checkpoint::Section section(checkpoint, "gallery",
                                          [this](auto& a) { a(rendered_, thumbnails_, strategies_); });
    for (const RenderedScene& r : rendered_) print_line(r);
    require_pictures();
    for (SceneJob& job : jobs_) {
      job.settings.checkpoint = checkpoint;
      mc::require_memory(render::memory_needed(job.file.scene, job.settings),
                         fmt::format("{}: {}x{} pixels", job.scene->name, job.settings.width, job.settings.height),
                         "a smaller --scale needs less");
    }
    const std::size_t earlier = rendered_.size();
    mc::IndependentPieces pieces;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      SceneJob& job = jobs_[i];
      job.settings.executor = session.executor();
      bool is_cancelled = false;
      pieces.attempt([&] { is_cancelled = i >= earlier && !render_one(job, session); });
      if (is_cancelled) break;
      done_ += job.work;
    }
    progress_.clear();
    pieces.end();
    if (checkpoint && rendered_.size() == jobs_.size()) checkpoint->save_and_wait(); // else a render saved
  }

  // The options, and the scenes with the bytes of their files.
  mc::RunIdentity identity() const {
    GalleryCommandOptions options = options_;
    mc::RunIdentity identity = run_identity(rows(options), {"NAME", "--threads", "--memory", "--resume", "--every"});
    std::vector<std::string_view> names;
    std::set<std::string> files;
    for (const SceneJob& job : jobs_) {
      names.push_back(job.scene->name);
      files.insert(job.file.files.begin(), job.file.files.end());
    }
    identity.emplace_back("the scenes", fmt::format("{}", fmt::join(names, " ")));
    identity.emplace_back("the content of the scenes' files", hash_of_files(files));
    return identity;
  }

  const std::vector<RenderedScene>& rendered() const { return rendered_; }
  const std::vector<render::Image>& thumbnails() const { return thumbnails_; }
  ResultWriter& results() { return results_; }

 private:
  // Throws Error where a picture would replace a file of a scene.
  void refuse_inputs() const {
    std::vector<UsedFile> files;
    for (const SceneJob& job : jobs_)
      for (const char* extension : {".exr", ".png"})
        files.push_back({(folder_ / std::string(job.scene->name)).string() + extension, "-o", true});
    std::set<std::string> inputs;
    for (const SceneJob& job : jobs_) inputs.insert(job.file.files.begin(), job.file.files.end());
    for (const std::string& input : inputs) files.push_back({input, "a file of a scene"});
    require_distinct_files(files);
  }

  // Throws Error where a picture of the run behind a checkpoint is not in the folder.
  void require_pictures() const {
    for (const RenderedScene& r : rendered_)
      for (const char* extension : {".exr", ".png"}) {
        const std::string picture = (folder_ / r.scene->name).string() + extension;
        mc::require(std::filesystem::exists(picture),
                    "--resume: '{}' is missing, which the run before wrote; name its folder by -o", picture);
      }
  }

  void print_line(const RenderedScene& r) {
    progress_.clear();
    const std::string error =
        std::isfinite(r.relative_error) ? fmt::format("{:.2f} %", 100 * r.relative_error) : std::string("unknown");
    fmt::print("{:<32} {}x{}, {:.4g} samples/pixel in {}, error {}\n", r.scene->name, r.width, r.height, r.spp,
               format_seconds(r.seconds), error);
    std::fflush(stdout);
  }

  // Returns false when interrupted; an unfinished scene is not kept.
  bool render_one(SceneJob& a, const RunSession& session) {
    const std::string title(a.scene->name);
    a.settings.name = title;
    a.settings.progress = [&](const render::Progress& p) {
      progress_.show((done_ + p.fraction * a.work) / work_,
                     fmt::format("{} of {}: {}", rendered_.size() + 1, jobs_.size(), title));
    };
    mc::IndependentPieces pieces; // a part renders its share of both
    render::RenderResult result;
    pieces.attempt([&] { result = render::render(a.file.scene, a.settings); });
    if (result.partial) return false;
    std::vector<StrategyResult> compared;
    pieces.attempt([&] { compared = strategies(a); });
    pieces.end();
    session.before_results();
    const Provenance from{title, options_.command, options_.seed};
    const std::string invalid = invalid_samples_text(result, from);
    mc::require(invalid.empty(), "{}: {}", title, invalid);
    add_metadata(result, from);
    const render::Crop whole{0, 0, a.settings.width, a.settings.height};
    for (const auto& [key, value] : render_fingerprint(scene_file(*a.scene), "mitsuba", {}, a.file, a.settings, whole))
      result.image.metadata[key] = value; // for carlo render to go on with
    const std::string path = (folder_ / title).string();
    results_.write(path + ".exr", false, [&](const std::string& file) { render::write_image(file, result.image); });
    results_.write(path + ".png", false,
                   [&](const std::string& file) { render::write_image(file, result.image, tone_of(*a.scene)); });
    RenderedScene r = report(a, result);
    r.strategies = std::move(compared);
    if (cancel_->load()) return false;
    keep_thumbnail(a, result.image);
    print_line(r);
    rendered_.push_back(std::move(r));
    return true;
  }

  // Computed once for all scenes that share a file.
  const std::vector<StrategyResult>& strategies(const SceneJob& a) {
    const std::string file = scene_file(*a.scene);
    if (const auto found = strategies_.find(file); found != strategies_.end()) return found->second;
    if (!incomplete_.insert(file).second) throw mc::EndOfPart(); // another scene of the file tried before
    std::vector<StrategyResult> all;
    render::RenderOptions settings = a.settings;
    settings.name = "strategies of " + file;
    if (a.settings.aov.kind == render::Aov::radiance)
      all = compare_strategies(a.file.scene, settings, 64, std::min(64, a.settings.spp));
    return strategies_[file] = std::move(all);
  }

  void keep_thumbnail(const SceneJob& a, render::Image image) {
    const render::ToneMapping tone = tone_of(*a.scene);
    for (render::Spectrum& p : image.pixels) p = tone_map(p, tone).cast<render::Float>();
    thumbnails_.push_back(thumbnail(image, options_.thumbnail_side));
  }

  const GalleryCommandOptions& options_;
  std::filesystem::path folder_;
  const std::atomic<bool>* cancel_;
  ProgressLine progress_;
  ResultWriter results_;
  std::vector<SceneJob> jobs_;
  double work_ = 0, done_ = 0;
  std::vector<RenderedScene> rendered_;
  std::vector<render::Image> thumbnails_;
  std::map<std::string, std::vector<StrategyResult>> strategies_; ///< by the file of the scene
  std::set<std::string> incomplete_;                              ///< files whose strategies were tried
};

render::Image sheet_of(const GalleryRun& run, int side) {
  SheetLabels labels;
  if (side >= least_named)
    for (const RenderedScene& r : run.rendered()) labels.cells.emplace_back(r.scene->name);
  return contact_sheet(run.thumbnails(), std::clamp(sheet_width / side, 1, most_columns), side, labels);
}

// Writes what was rendered. Returns the exit code.
int write_page(GalleryRun& run, const GalleryCommandOptions& o, const std::filesystem::path& folder,
               std::size_t scenes) {
  const std::size_t finished = run.rendered().size();
  if (finished > 0) {
    const bool is_partial = finished < scenes;
    const render::Image sheet = sheet_of(run, o.thumbnail_side);
    run.results().write((folder / "sheet.png").string(), is_partial,
                        [&](const std::string& file) { render::write_image(file, sheet); });
    fmt::print("page: {}\n", run.results().write((folder / "index.html").string(), is_partial,
                                                 gallery_page(run.rendered(), scenes, o.command)));
  }
  run.results().finish();
  if (finished == scenes) return exit_ok;
  fmt::print("interrupted: {} of {} scenes were finished\n", finished, scenes);
  print_how_to_resume(o.checkpoint);
  return exit_interrupted;
}

int run_gallery(const GalleryCommandOptions& o) {
  mc::require(o.names.empty() || !(o.list || o.table), "gallery: --list and --table show all scenes; leave out '{}'",
              fmt::join(o.names, " "));
  if (o.list) return list_scenes();
  if (o.table) {
    fmt::print("{}", gallery_text());
    return exit_ok;
  }
  limit_memory(o.memory);
  mc::require(o.scale > 0 && o.scale <= 4, "--scale {} must lie in (0, 4]", o.scale);
  mc::require(o.threads >= 0, "--threads {} must be >= 0", o.threads);
  mc::require(!o.spp || *o.spp >= 1, "--spp {} must be at least 1", o.spp.value_or(0));
  mc::require(!o.seconds || *o.seconds > 0, "--time {} must be > 0", o.seconds.value_or(0));
  mc::require(!o.target_error || *o.target_error > 0, "--target-error {} must be > 0", o.target_error.value_or(0));
  mc::require(o.thumbnail_side >= 16 && o.thumbnail_side <= 1024, "--thumbnails {} must lie in [16, 1024]",
              o.thumbnail_side);
  const std::vector<const GalleryScene*> scenes = chosen_scenes(o);
  const std::filesystem::path folder = o.checkpoint.is_part() ? "" : mc::make_output_folder(o.output, "index.html");

  const Interrupt interrupt;
  GalleryRun run(o, folder, interrupt.flag());
  run.read_all(scenes);
  RunSession session(o.checkpoint, run.identity(), o.output, o.command);
  return session.run([&] {
    run.render_all(session);
    return write_page(run, o, folder, scenes.size());
  });
}

} // namespace

Subcommand gallery_subcommand() {
  return make_subcommand<GalleryCommandOptions>(
      {.name = "gallery",
       .summary = "Render scenes of books and courses, with a page that shows them",
       .examples = {{"carlo gallery --list", "names the scenes and their sources"},
                    {"carlo gallery cbox smallpt -o out", "renders two scenes"},
                    {"carlo gallery --time 10 -o out", "renders each scene for ten seconds"}}},
      rows, run_gallery);
}

} // namespace carlo

#include <converge/measure.h>
#include <converge/output.h>
#include <converge/page.h>
#include <input/points_file.h>
#include <options/expression_help.h>
#include <options/expression_options.h>
#include <options/files.h>
#include <options/integral_options.h>
#include <options/run_session.h>
#include <report/plot.h>
#include <report/report_json.h>
#include <terminal/interrupt.h>
#include <terminal/message.h>
#include <terminal/progress.h>
#include <terminal/result_writer.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <memory>

namespace carlo {

namespace {

struct ConvergeCommandOptions {
  IntegralOptions integral;
  SceneOptions scene;
  bool all = false;
  std::string samplers; ///< empty: random,stratified,sobol; of a scene all
  std::string points;   ///< a file of points, as one more sampler
  std::string scale;    ///< the range of their coordinates
  int replicates = 0;
  std::optional<double> time; ///< seconds for everything
  std::uint64_t seed = 1;
  int threads = 0;
  std::string output = "out/convergence", report;
  CheckpointFiles checkpoint;
  std::string command;
};

std::vector<SamplingMethod> methods_of(const ConvergeCommandOptions& o) {
  std::vector<SamplingMethod> chosen;
  const auto can_work = [&](const SamplingMethod& w) { return w.min_calls <= o.integral.max_n; };
  if (o.all) std::copy_if(sampling_methods().begin(), sampling_methods().end(), std::back_inserter(chosen), can_work);
  const std::string samplers = o.samplers.empty() ? "random,stratified,sobol" : o.samplers;
  if (!o.all)
    for (const std::string_view name : mc::split(samplers, ',')) {
      chosen.push_back(sampling_method(std::string(name)));
      mc::require(can_work(chosen.back()), "--max-n {}: {} takes N of at least {}; raise it, or leave {} out",
                  o.integral.max_n, name, chosen.back().min_calls, name);
    }
  if (!o.points.empty()) {
    chosen.push_back(points_file_method(o.points, o.scale));
    if (!o.scale.empty()) fmt::print("{}\n", chosen.back().note);
  }
  return chosen;
}

// Writes and prints one target; `pictures` for a scene. Returns whether gnuplot can draw; pass the answer on, so that
// the warning appears once.
bool write(ResultWriter& results, const IntegralTarget& target, const Measurement& m, const ConvergeCommandOptions& o,
           const std::filesystem::path& output, bool can_draw, const PictureMeasurement* pictures = nullptr) {
  const std::string name = safe_file_name(target.integral.name);
  const std::filesystem::path folder = result_folder(output, name + ".csv", m.interrupted);
  const std::string base = (folder / name).string();
  results.write(base + ".csv", false, to_csv(target, m));
  nlohmann::ordered_json about = {{"command", o.command}, {"commit", commit}, {"seed", o.seed}};
  if (pictures) about["reference"] = {{"spp", pictures->reference_spp}, {"error", pictures->reference_error}};
  if (pictures && !pictures->missing_light.empty()) about["reference"]["missing_light"] = pictures->missing_light;
  results.write(base + ".json", false, json_text(to_json(target, m, about)));
  results.write(base + ".gp", false, to_script(target, m, name));
  fmt::print("{}", summary(target, m));
  const auto cut =
      std::count_if(m.curves.begin(), m.curves.end(), [](const ConvergenceCurve& c) { return c.out_of_time; });
  if (cut > 0) fmt::print("  --time ended {} of them before N = {}\n", cut, o.integral.max_n);
  std::fflush(stdout);
  const bool anything =
      std::any_of(m.curves.begin(), m.curves.end(), [](const ConvergenceCurve& c) { return c.has_measurable_error(); });
  if (!can_draw || !anything) {
    remove_plot(folder, name);
    return can_draw;
  }
  results.attempt([&] { can_draw = draw_plot(folder, name, {name + ".csv"}); });
  if (!can_draw) warn("gnuplot is not installed; data and scripts are written, but no plots");
  return can_draw;
}

// Results of the targets, each written as soon as it is measured.
struct ConvergeRun {
  std::deque<Measurement> measurements; ///< of the first targets
  std::size_t curves = 0;               ///< finished
  bool interrupted = false;
};

ConvergeRun measure_all(ResultWriter& results, const std::vector<IntegralTarget>& targets,
                        const std::vector<SamplingMethod>& chosen, const ConvergeCommandOptions& o,
                        const std::filesystem::path& folder, const std::atomic<bool>* cancel,
                        const RunSession& session) {
  ReplicateLog log(session.checkpoint(), session.executor());
  ConvergeRun run;
  mc::IndependentPieces pieces;
  ProgressLine progress;
  bool can_draw = true;
  for (std::size_t i = 0; i < targets.size() && !run.interrupted; ++i) {
    MeasureOptions m{.max_n = o.integral.max_n,
                     .replicates = o.replicates,
                     .seed = o.seed,
                     .threads = o.threads,
                     .cancel = cancel,
                     .log = &log,
                     .parts = session.parts(),
                     .first_piece = i * chosen.size()};
    if (o.time) m.seconds = std::max(1e-3, *o.time - log.elapsed()) / static_cast<double>(targets.size() - i);
    m.progress = [&](double done, const std::string& where) {
      progress.show((static_cast<double>(i) + done) / static_cast<double>(targets.size()), where);
    };
    const bool is_measured = pieces.attempt([&] {
      run.measurements.push_back(measure_convergence(targets[i], chosen, m));
      session.before_results();
    });
    progress.clear();
    if (!is_measured) continue;
    const Measurement& done = run.measurements.back();
    run.curves += count_finished(done);
    run.interrupted = done.interrupted;
    if (!done.curves.empty()) can_draw = write(results, targets[i], done, o, folder, can_draw);
  }
  pieces.end();
  if (!run.interrupted) log.save(); // else the replicates under way are saved
  return run;
}

std::vector<Option> rows(ConvergeCommandOptions& o) {
  OptionGroup common{
      common_options,
      integral_option_rows(o.integral, "Names (see --list), groups (books, genz, rates; default: books)")};
  const std::vector<Option> own = {
      {"--samplers", "NAMES", &o.samplers,
       "Methods, comma-separated, see --list; for a scene, point sets of carlo render. Default: "
       "random,stratified,sobol; for a scene all."},
      {"--all",
       "",
       &o.all,
       "Every method; for a scene every strategy, spent evenly and adaptively, with splats and with tiles.",
       false,
       {{"--samplers", "--all takes every method"}}},
      output_folder(
          {"-o,--output", "FOLDER", &o.output, "Folder for CSV, JSON, gnuplot script, SVG, PNG and slopes.csv."},
          {"slopes.csv"}),
      output_folder({"--report", "FOLDER", &o.report, "Write a page with all curves to this folder (index.html)."},
                    {"index.html"}),
  };
  common.options.insert(common.options.end(), own.begin(), own.end());
  OptionGroup expert{
      expert_options,
      {
          input_file({"--points-file", "FILE", &o.points,
                      "Add the points of this file as a method: one point a row, in [0, 1)."}),
          {"--rescale", "LO:HI", &o.scale, rescale_help},
          {"--replicates", "N", &o.replicates,
           "Independent repetitions behind each error, 8 to 100000; 0 is enough to know the error to 10 %."},
          {"--time", "SECONDS", &o.time, "Wall-clock time for everything; larger N are left out."},
          {"--seed", "N", &o.seed, "Seed of the random numbers. The same seed gives the same errors."},
          {"--threads", "N", &o.threads, "Threads; 0 is all processors."},
          resume_row(o.checkpoint),
      }};
  const std::vector<Option> files = checkpoint_rows(o.checkpoint, {"--time"});
  expert.options.insert(expert.options.end(), files.begin(), files.end());
  return in_groups({common, expression_group(o.integral.expression), foreign_group(o.integral.foreign),
                    scene_group(o.scene), expert});
}

// The folder of the page, checked before any work; empty without --report.
std::filesystem::path page_folder(const ConvergeCommandOptions& o) {
  return o.report.empty() ? "" : mc::make_output_folder(o.report, "index.html");
}

void write_report(ResultWriter& results, const std::filesystem::path& output, const ConvergeCommandOptions& o,
                  const std::vector<PageEntry>& all, bool is_partial) {
  if (output.empty()) return;
  const std::filesystem::path folder = result_folder(output, "index.html", is_partial);
  write_convergence_page(results, folder, converge_header(o.command), all);
  fmt::print("page: {}\n", (folder / "index.html").string());
}

// The slopes of all targets; a partial table does not replace one that exists.
void write_slopes(ResultWriter& results, const std::filesystem::path& output, const std::string& slopes,
                  bool is_partial) {
  const std::filesystem::path folder = result_folder(output, "slopes.csv", is_partial);
  results.write((folder / "slopes.csv").string(), false, slopes_header() + slopes);
  fmt::print("data and plots: {}\n", folder.string());
}

// Throws Error where the files of a target would replace an input.
void refuse_inputs(const ConvergeCommandOptions& o, const std::vector<IntegralTarget>& targets) {
  std::vector<UsedFile> files = {{o.points, "the file of --points-file"},
                                 {o.integral.foreign.plugin, "the file of --plugin"}};
  for (const std::string& word : o.integral.integrands) files.push_back({word, "an input"});
  for (const IntegralTarget& target : targets)
    for (const char* extension : {".csv", ".json", ".gp", ".svg", ".png"})
      files.push_back({o.output + "/" + safe_file_name(target.integral.name) + extension, "-o", true});
  require_distinct_files(files);
}

RunSession session_of(ConvergeCommandOptions o) {
  return {o.checkpoint, measurement_identity(rows(o), o.integral.integrands), o.output, o.command};
}

// The folder of the results; none for a part.
std::filesystem::path output_folder_of(const ConvergeCommandOptions& o) {
  return o.checkpoint.is_part() ? "" : mc::make_output_folder(o.output, "slopes.csv");
}

int run_converge_scene(const ConvergeCommandOptions& o) {
  mc::require(o.points.empty(), "converge: --points-file is not for scenes");
  refuse_integral_options(o.integral);
  const Interrupt interrupt;
  const IntegralTarget target = scene_target(o.integral.integrands[0]);
  refuse_inputs(o, {target});
  const std::filesystem::path folder = output_folder_of(o);
  const std::filesystem::path page = page_folder(o);
  RunSession session = session_of(o);
  return session.run([&] {
    const PictureMeasurement pictures = measure_scene(o.scene, {.path = target.integral.source,
                                                                .samplers = o.samplers,
                                                                .all = o.all,
                                                                .pictures = o.replicates,
                                                                .seconds = o.time.value_or(0),
                                                                .seed = o.seed,
                                                                .threads = o.threads,
                                                                .cancel = interrupt.flag(),
                                                                .checkpoint = session.checkpoint(),
                                                                .executor = session.executor()});
    session.before_results();
    const bool interrupted = pictures.measurement.interrupted;
    if (interrupted) fmt::print("{}\n", interruption_summary(pictures));
    if (interrupted) print_how_to_resume(o.checkpoint);
    if (pictures.methods.empty()) return exit_interrupted;
    ResultWriter results;
    write(results, target, pictures.measurement, o, folder, true, &pictures);
    fmt::print("{}", bias_summary(pictures));
    write_slopes(results, folder, slopes_csv(target, pictures.measurement), interrupted);
    write_report(results, page, o, {{&target, &pictures.measurement, &pictures}}, interrupted);
    results.finish();
    return interrupted ? exit_interrupted : exit_ok;
  });
}

// Measures the targets, and writes the results. Returns the exit code.
int measure_and_report(const ConvergeCommandOptions& o, const std::vector<IntegralTarget>& targets,
                       const std::vector<SamplingMethod>& chosen, const std::filesystem::path& folder,
                       const std::filesystem::path& page, const Interrupt& interrupt, const RunSession& session) {
  ResultWriter results;
  const ConvergeRun run = measure_all(results, targets, chosen, o, folder, interrupt.flag(), session);
  if (run.interrupted) print_how_to_resume(o.checkpoint);
  std::string slopes;
  std::vector<PageEntry> measured;
  bool doubted = false;
  for (std::size_t i = 0; i < run.measurements.size(); ++i) {
    if (run.measurements[i].curves.empty()) continue;
    slopes += slopes_csv(targets[i], run.measurements[i]);
    measured.push_back({&targets[i], &run.measurements[i]});
    doubted = doubted || !run.measurements[i].truth_warning.empty();
  }
  if (run.interrupted)
    fmt::print("{}\n", interrupted_text(run.curves, targets.size() * chosen.size(), "curves", run.measurements.back()));
  write_slopes(results, folder, slopes, run.interrupted);
  write_report(results, page, o, measured, run.interrupted);
  results.finish();
  if (run.interrupted) return exit_interrupted;
  return doubted ? exit_failed : exit_ok;
}

int run_converge(const ConvergeCommandOptions& o) {
  if (o.integral.list) return list_integrals();
  mc::require(o.replicates == 0 || (o.replicates >= 8 && o.replicates <= 100'000),
              "--replicates {} must lie in [8, 100000], or be 0", o.replicates);
  mc::require(o.scale.empty() || !o.points.empty(), "--rescale is for a --points-file");
  mc::require(!o.time || (*o.time > 0 && *o.time <= 1e7), "--time {} must lie in (0, 1e7] seconds", o.time.value_or(0));
  if (is_scene(o.integral.integrands)) return run_converge_scene(o);
  refuse_scene_among(o.integral.integrands);
  refuse_scene_options(o.scene);
  const Interrupt interrupt;
  const std::vector<IntegralTarget> targets = targets_of(o.integral);
  const std::vector<SamplingMethod> chosen = methods_of(o);
  if (!o.integral.expression.domain.empty() && !o.integral.foreign.is_given())
    refuse_constant(o.integral.integrands[0], o.integral.expression);
  for (const SamplingMethod& w : chosen)
    for (const IntegralTarget& t : targets)
      mc::require(w.max_dimensions == 0 || w.max_dimensions >= t.integral.dim, "{}: {} columns; {} has {} dimensions",
                  w.name, w.max_dimensions, t.integral.name, t.integral.dim);
  refuse_inputs(o, targets);
  const bool is_logged = !o.checkpoint.checkpoint.empty() || !o.checkpoint.resume.empty();
  mc::require_memory(
      double(targets.size()) * (is_logged ? 2 : 1) *
          replicates_memory(chosen, {.max_n = o.integral.max_n, .replicates = o.replicates}),
      fmt::format("converge: the replicates of {} methods and {} integrals", chosen.size(), targets.size()),
      "fewer --replicates need less");
  const std::filesystem::path folder = output_folder_of(o);
  const std::filesystem::path page = page_folder(o);

  RunSession session = session_of(o);
  return session.run([&] { return measure_and_report(o, targets, chosen, folder, page, interrupt, session); });
}

} // namespace

Subcommand converge_subcommand() {
  return make_subcommand<ConvergeCommandOptions>(
      {.name = "converge",
       .summary =
           "Measure how fast the error of an estimate falls with samples and with time, and plot it beside theory",
       .examples = {{"carlo converge pi --max-n 16384", "compares random, stratified and Sobol' points"},
                    {"carlo converge \"exp(-x*x)*y\" -d \"x=0:1,y=-1:2\" --all --report out",
                     "measures every method on an expression, and writes a page"},
                    {"carlo converge scene.xml --strategies nee,mis", "measures the error of pictures"}},
       .failure = "a truth is doubtful: errors do not fall to it",
       .sections = {{"Output",
                     {{"slope", "Fitted exponent of N with a 95 % interval: -0.5 for independent samples. Steeper is "
                                "better."},
                      {"theory",
                       "The exponent of the literature. \"no steeper than\" where logarithms may slow the fall, "
                       "\"at least as steep as\" where only a bound is proven."}}},
                    expression_section()}},
      rows, run_converge);
}

} // namespace carlo

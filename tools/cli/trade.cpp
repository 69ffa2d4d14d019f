#include <converge/curve_style.h>
#include <converge/output.h>
#include <converge/page.h>
#include <converge/trade.h>
#include <options/expression_help.h>
#include <options/expression_options.h>
#include <options/integral_options.h>
#include <options/run_session.h>
#include <options/subcommand.h>
#include <report/plot.h>
#include <report/report_json.h>
#include <terminal/interrupt.h>
#include <terminal/message.h>
#include <terminal/progress.h>
#include <terminal/result_writer.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace carlo {

namespace {

using nlohmann::ordered_json;

struct TradeCommandOptions {
  IntegralOptions integral;
  SceneOptions scene;
  std::string samplers;        ///< of a scene; empty: all
  std::string errors, seconds; ///< lists of numbers
  std::optional<double> time;
  std::uint64_t seed = 1;
  int threads = 0;
  std::string output = "out/trade", report;
  CheckpointFiles checkpoint;
  std::string command;
};

std::vector<double> parse_positive_list(const char* option, const std::string& text, double most) {
  std::vector<double> all;
  for (const std::string_view part : mc::split(text, ',')) {
    const std::optional<double> x = mc::parse_double(part);
    mc::require(x && *x > 0 && *x <= most, "{}: '{}' in '{}' must be a number above 0, and {:g} at most", option, part,
                text, most);
    all.push_back(*x);
  }
  return all;
}

std::string text_of(const IntervalEstimate& r, std::string_view unit) {
  if (r.is_upper_bound()) return fmt::format("at most {:.3g}{}", r.hi, unit);
  if (r.is_lower_bound()) return fmt::format("at least {:.3g}{}", r.lo, unit);
  return fmt::format("{:.3g}{} [{:.3g}, {:.3g}]", r.value, unit, r.lo, r.hi);
}

// Prints the candidates that do not differ significantly from the first.
void print_ties(const std::vector<TradeCandidate>& candidates, IntervalEstimate TradeCandidate::*criterion,
                std::string_view unit) {
  const std::size_t count = count_ties(candidates, criterion);
  for (std::size_t i = 1; i < count; ++i)
    fmt::print("{}{} {}", i == 1 ? "      no significant difference: " : ", ", curve_label(*candidates[i].curve),
               text_of(reported_interval(candidates[i], criterion), unit));
  if (count > 1) fmt::print("\n");
}

// The smallest errors, where no method reaches the wanted one.
void print_nearest(const CandidatesForError& f) {
  constexpr std::size_t most = 4;
  fmt::print("  error {:g}: not reached", f.goal);
  for (std::size_t i = 0; i < std::min(f.nearest.size(), most); ++i)
    fmt::print("{} {} {}{:.3g} at N = {:.0f}", i == 0 ? "; smallest errors:" : ",", curve_label(*f.nearest[i].curve),
               f.nearest[i].error.is_upper_bound() ? "at most " : "", f.nearest[i].error.value, f.nearest[i].n);
  if (f.nearest.size() > most) fmt::print("; trade.csv has all {}", f.nearest.size());
  fmt::print("; raise --max-n (for a scene --max-spp)\n");
}

void print(const CandidatesForError& f, const CostUnit& cost) {
  if (f.candidates.empty()) return print_nearest(f);
  const TradeCandidate& best = f.candidates.front();
  fmt::print("  error {:g}: {} in {}{}, N about {:.0f}", f.goal, curve_label(*best.curve),
             text_of(reported_interval(best, &TradeCandidate::seconds), cost.unit), cost.qualifier, best.n);
  if (f.gain && f.gain->lo < f.gain->hi) fmt::print("; {} times faster than plain Monte Carlo", text_of(*f.gain, ""));
  fmt::print("\n");
  print_ties(f.candidates, &TradeCandidate::seconds, cost.unit);
}

void print(const CandidatesForTime& f, const CostUnit& cost) {
  if (f.candidates.empty()) {
    fmt::print("  {:g}{}: too little for any method\n", f.goal, cost.unit);
    return;
  }
  const TradeCandidate& best = f.candidates.front();
  fmt::print("  {:g}{}: {} with an error of {}, N about {:.0f}", f.goal, cost.unit, curve_label(*best.curve),
             text_of(reported_interval(best, &TradeCandidate::error), ""), best.n);
  if (best.is_largest_n) fmt::print(", its largest, in {:.3g}{}", best.seconds.value, cost.unit);
  if (f.gain) fmt::print("; {} times smaller than plain Monte Carlo's", text_of(*f.gain, ""));
  fmt::print("\n");
  print_ties(f.candidates, &TradeCandidate::error, "");
  const auto ended =
      std::count_if(f.candidates.begin(), f.candidates.end(), [](const TradeCandidate& o) { return o.is_largest_n; });
  if (ended > 0)
    fmt::print("      {} of {} methods reached their largest N before {:g}{}; their error may be smaller: raise "
               "--max-n (for a "
               "scene --max-spp)\n",
               ended, f.candidates.size(), f.goal, cost.unit);
}

// JSON has no infinity; null stands for it, and for a value of which only a bound is known.
ordered_json to_json(const IntervalEstimate& r) {
  const bool is_known = !r.is_upper_bound() && !r.is_lower_bound();
  return {{"value", is_known ? ordered_json(r.value) : ordered_json()}, {"lo", r.lo}, {"hi", r.hi}};
}
ordered_json to_json(const std::vector<TradeCandidate>& candidates, const CostUnit& cost) {
  ordered_json all = ordered_json::array();
  for (const TradeCandidate& o : candidates) {
    all.push_back({{"way", curve_label(*o.curve)},
                   {"n", o.n},
                   {std::string(cost.column), to_json(o.seconds)},
                   {"rms_error", to_json(o.error)}});
    if (o.is_largest_n) all.back()["ended"] = true;
  }
  return all;
}
template <class For>
ordered_json to_json(const For& f, IntervalEstimate TradeCandidate::*criterion, const CostUnit& cost) {
  ordered_json j = {{"wanted", f.goal}, {"as_good", f.candidates.empty() ? 0 : count_ties(f.candidates, criterion)}};
  if (f.gain) j["gain_over_plain"] = to_json(*f.gain);
  j["offers"] = to_json(f.candidates, cost);
  return j;
}

// gnuplot script: all points, and the Pareto front. Winners have broad lines.
std::string script(const std::string& title, const Measurement& m, const TradeResults& trade_results) {
  std::string s = plot_header("trade", 900, 640);
  s += fmt::format(
      "set title \"{}\" noenhanced\nset logscale xy\nset format xy \"10^{{%L}}\"\nset key outside right "
      "Left reverse samplen 2\nset xlabel \"{} of one estimate\"\nset ylabel \"root-mean-square "
      "error\"\nplot \"front.csv\" skip 1 using 3:4 with lines lw 8 lc rgb \"#e2e2e2\" title \"Pareto front\"",
      title, m.cost.axis);
  const std::vector<CurveStyle> styles = curve_styles(m, &trade_results);
  bool has_grey = false;
  for (const std::size_t i : drawing_order(styles)) {
    const std::string name = curve_label(m.curves[i]);
    const CurveStyle& style = styles[i];
    std::string key = fmt::format("title \"{}{}\" noenhanced", name, style.wins() ? " (winner)" : "");
    if (!style.color) key = has_grey ? "notitle" : "title \"other methods\"";
    has_grey = has_grey || !style.color;
    s +=
        fmt::format(", \\\n     \"trade.csv\" skip 1 using (strcol(1) eq \"{}\" ? $3 : NaN):4 with linespoints pt 7 ps "
                    "0.4 lw {} lc rgb \"{}\" {}",
                    name, style.wins() ? 3.5 : 1.5, color_on_white(style), key);
  }
  return s + "\n";
}

std::string csv(const std::vector<TradeCandidate>& candidates, const CostUnit& cost) {
  std::string text = fmt::format("way,n,{},rms_error,rms_lo,rms_hi\n", cost.column);
  for (const TradeCandidate& o : candidates)
    text += fmt::format("{},{:.0f},{:.6g},{},{:.9g},{:.9g}\n", curve_label(*o.curve), o.n, o.seconds.value,
                        o.error.is_upper_bound() ? "" : fmt::format("{:.9g}", o.error.value), o.error.lo, o.error.hi);
  return text;
}

std::vector<TradeCandidate> all_points(const Measurement& m) {
  std::vector<TradeCandidate> all;
  for (const ConvergenceCurve& c : m.curves)
    for (const mc::RmsError& e : c.errors)
      all.push_back({&c, e.n, {e.seconds, e.seconds, e.seconds}, {e.rms, e.lo, e.hi}});
  return all;
}

// Every point set over double and float, and every estimator; also with one point per call where the integrand takes
// batches.
std::vector<SamplingMethod> configurations(const IntegralTarget& target) {
  std::vector<SamplingMethod> all = sampling_methods();
  all.insert(all.end(), float_sampling_methods().begin(), float_sampling_methods().end());
  if (!target.has_batch) return all;
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(all[i]);
    all.back().scalar_calls = true;
  }
  return all;
}

std::vector<Option> rows(TradeCommandOptions& o) {
  OptionGroup common{common_options, integral_option_rows(o.integral, "Name (see --list)")};
  const std::vector<Option> own = {
      {"--error", "LIST", &o.errors,
       "RMS errors to reach, absolute: \"1e-2,1e-3\". Default: three decades below the integral; for a scene "
       "0.2,0.1,0.05."},
      {"--seconds",
       "LIST",
       &o.seconds,
       "CPU seconds to spend: \"0.001,0.01\"; with --cost rays millions of rays.",
       false,
       {{"--error", "one of them asks for the cheapest method, the other for the most accurate one"}}},
      output_folder({"-o,--output", "FOLDER", &o.output, "Folder for trade.json, .csv, .gp, .svg, .png and front.csv."},
                    {"trade.json", "trade.csv", "trade.gp", "trade.svg", "trade.png", "front.csv"}),
      output_folder(
          {"--report", "FOLDER", &o.report, "Write a page with the choice and all curves to this folder (index.html)."},
          {"index.html"}),
  };
  common.options.insert(common.options.end(), own.begin(), own.end());
  OptionGroup scene = scene_group(o.scene);
  scene.options.push_back({"--samplers", "NAMES", &o.samplers,
                           "Point sets of the pixels, comma-separated, see carlo render. Default: all."});
  OptionGroup expert{expert_options,
                     {
                         {"--time", "SECONDS", &o.time, "Wall-clock time for everything; larger N are left out."},
                         {"--seed", "N", &o.seed, "Seed of the random numbers. The same seed gives the same errors."},
                         {"--threads", "N", &o.threads, "Threads; 0 is all processors."},
                         resume_row(o.checkpoint),
                     }};
  const std::vector<Option> files = checkpoint_rows(o.checkpoint, {"--time"});
  expert.options.insert(expert.options.end(), files.begin(), files.end());
  return in_groups({common, expression_group(o.integral.expression), foreign_group(o.integral.foreign), scene, expert});
}

/// The wanted errors and times.
struct TradeGoals {
  std::vector<double> errors, seconds;
};

/// Output folders, checked before any work.
struct OutputFolders {
  std::filesystem::path data, page; ///< page: empty without --report; both empty for a part

  explicit OutputFolders(const TradeCommandOptions& o) {
    if (o.checkpoint.is_part()) return;
    data = mc::make_output_folder(o.output, "trade.json");
    if (!o.report.empty()) page = mc::make_output_folder(o.report, "index.html");
  }
};

// `evaluation_cost` takes offers and measures them again.
template <class Seconds>
TradeResults trade_results_of(const Measurement& m, const TradeGoals& wanted, const Seconds& evaluation_cost) {
  TradeResults a;
  for (const double error : wanted.errors)
    a.by_error.push_back(
        candidates_for_error(m, error, evaluation_cost(candidates_for_error(m, error, measured_cost).candidates)));
  for (const double budget : wanted.seconds)
    a.by_time.push_back(
        candidates_for_time(m, budget, evaluation_cost(candidates_for_time(m, budget, measured_cost).candidates)));
  a.pareto_front = pareto_front(m);
  return a;
}

// Adds the reference picture, and the bias of each method with its interval.
void add(const PictureMeasurement& p, ordered_json& j) {
  j["reference"] = {{"spp", p.reference_spp}, {"error", p.reference_error}};
  if (!p.missing_light.empty()) j["reference"]["missing_light"] = p.missing_light;
  j["biases"] = ordered_json::array();
  for (std::size_t i = 0; i < p.biases.size(); ++i)
    j["biases"].push_back({{"way", curve_label(p.measurement.curves[i])}, {"bias", to_json(p.biases[i].bias)}});
}

ordered_json to_json(const TradeCommandOptions& o, const PageEntry& one) {
  const Measurement& m = *one.measurement;
  const TradeResults& a = *one.trade_results;
  ordered_json j = {{"command", o.command}, {"commit", commit},
                    {"seed", o.seed},       {"integrand", one.target->integral.name},
                    {"truth", m.truth},     {"truth_error", m.truth_error},
                    {"cost", o.scene.cost}};
  if (m.heavy_tail) j["infinite_variance"] = {{"tail_index", *m.heavy_tail}};
  if (m.interrupted) j["interrupted"] = true;
  for (const FailedMethod& f : m.failures)
    j["failed"].push_back({{"way", method_label(*f.method)}, {"reason", f.reason}});
  if (one.pictures) add(*one.pictures, j);
  j["errors"] = j["seconds"] = ordered_json::array();
  for (const CandidatesForError& f : a.by_error) {
    j["errors"].push_back(to_json(f, &TradeCandidate::seconds, m.cost));
    if (f.candidates.empty()) j["errors"].back()["nearest"] = to_json(f.nearest, m.cost);
  }
  for (const CandidatesForTime& f : a.by_time) j["seconds"].push_back(to_json(f, &TradeCandidate::error, m.cost));
  j["front"] = to_json(a.pareto_front, m.cost);
  return j;
}

// Prints and writes the results. Returns the exit code.
int report(const TradeCommandOptions& o, const PageEntry& one, const OutputFolders& folders) {
  const Measurement& m = *one.measurement;
  const TradeResults& a = *one.trade_results;
  const bool exact = std::all_of(m.curves.begin(), m.curves.end(), [](const ConvergenceCurve& c) { return c.exact; });
  const bool anything =
      std::any_of(m.curves.begin(), m.curves.end(), [](const ConvergenceCurve& c) { return c.has_measurable_error(); });
  for (const CandidatesForError& f : a.by_error) print(f, m.cost);
  for (const CandidatesForTime& f : a.by_time) print(f, m.cost);
  if (exact) fmt::print("  every method is exact to rounding: there is no error to plot\n");
  for (const std::string& warning : {m.truth_warning, variance_warning(m)})
    if (!warning.empty()) fmt::print("  warning: {}\n", warning);
  ResultWriter results;
  const std::filesystem::path folder = result_folder(folders.data, "trade.json", m.interrupted);
  results.write((folder / "trade.csv").string(), false, csv(all_points(m), m.cost));
  results.write((folder / "front.csv").string(), false, csv(a.pareto_front, m.cost));
  results.write((folder / "trade.json").string(), false, json_text(to_json(o, one)));
  results.write((folder / "trade.gp").string(), false, script(one.target->integral.title, m, a));
  results.attempt([&] {
    if (!anything) remove_plot(folder, "trade");
    else if (!draw_plot(folder, "trade", {"trade.csv", "front.csv"}))
      warn("gnuplot is not installed; data and scripts are written, but no plots");
  });
  fmt::print("data and plots: {}\n", folder.string());
  if (!folders.page.empty()) {
    const std::filesystem::path page = result_folder(folders.page, "index.html", m.interrupted);
    write_convergence_page(results, page, trade_header(o.command), {one});
    fmt::print("page: {}\n", (page / "index.html").string());
  }
  results.finish();
  const auto is_reached = [](const auto& f) { return !f.candidates.empty(); };
  const bool reached = std::all_of(a.by_error.begin(), a.by_error.end(), is_reached) &&
                       std::all_of(a.by_time.begin(), a.by_time.end(), is_reached);
  return reached && m.truth_warning.empty() ? exit_ok : exit_failed;
}

RunSession session_of(TradeCommandOptions o) {
  return {o.checkpoint, measurement_identity(rows(o), o.integral.integrands), o.output, o.command};
}

int run_trade_scene(const TradeCommandOptions& o, TradeGoals wanted) {
  refuse_integral_options(o.integral);
  const Interrupt interrupt;
  const IntegralTarget target = scene_target(o.integral.integrands[0]);
  const OutputFolders folders(o);
  RunSession session = session_of(o);
  return session.run([&] {
    const PictureMeasurement pictures = measure_scene(o.scene, {.path = target.integral.source,
                                                                .samplers = o.samplers,
                                                                .for_trade = true,
                                                                .seconds = o.time.value_or(0),
                                                                .seed = o.seed,
                                                                .threads = o.threads,
                                                                .cancel = interrupt.flag(),
                                                                .checkpoint = session.checkpoint(),
                                                                .executor = session.executor()});
    session.before_results();
    const Measurement& m = pictures.measurement;
    if (m.interrupted) fmt::print("{}\n", interruption_summary(pictures));
    if (m.interrupted) print_how_to_resume(o.checkpoint);
    if (pictures.methods.empty()) return int(exit_interrupted);
    if (wanted.errors.empty() && wanted.seconds.empty()) wanted.errors = {0.2, 0.1, 0.05};
    fmt::print("{}: {} methods, {} of one picture\n", target.integral.title, m.curves.size(), m.cost.axis);
    fmt::print("{}", bias_summary(pictures));
    // The pictures were already rendered in turn.
    const TradeResults trade_results =
        trade_results_of(m, wanted, [](const std::vector<TradeCandidate>&) { return measured_cost; });
    const int code = report(o, {&target, &m, &pictures, &trade_results}, folders);
    return m.interrupted ? int(exit_interrupted) : code;
  });
}

// Measures the methods, and writes the choice. Returns the exit code.
int measure_and_report(const TradeCommandOptions& o, const IntegralTarget& target, TradeGoals wanted,
                       const OutputFolders& folders, const Interrupt& interrupt, const RunSession& session) {
  const std::vector<SamplingMethod> chosen = configurations(target);
  ProgressLine progress;
  MeasureOptions options{.max_n = o.integral.max_n, .seed = o.seed, .threads = o.threads, .cancel = interrupt.flag()};
  options.seconds = o.time.value_or(0);
  std::vector<double>&errors = wanted.errors, &seconds = wanted.seconds;
  if (!errors.empty()) options.error_goal = *std::min_element(errors.begin(), errors.end());
  if (!seconds.empty()) options.cpu_goal = *std::max_element(seconds.begin(), seconds.end());
  options.progress = [&](double done, const std::string& where) { progress.show(done, where); };
  ReplicateLog log(session.checkpoint(), session.executor());
  options.log = &log;
  options.parts = session.parts();
  Measurement m = measure_convergence(target, chosen, options);
  progress.clear();
  session.before_results();
  if (m.interrupted) print_how_to_resume(o.checkpoint); // the replicates under way are saved
  else log.save();
  if (m.curves.empty()) {
    fmt::print("interrupted: 0 of {} methods were measured, too few to choose from\n", chosen.size());
    return exit_interrupted;
  }
  if (errors.empty() && seconds.empty())
    for (const double share : {1e-2, 1e-3, 1e-4})
      errors.push_back(share * (std::abs(m.truth) > 4 * m.truth_error ? std::abs(m.truth) : m.magnitude));

  const auto in_turn = [&](const std::vector<TradeCandidate>& candidates) {
    return interleaved_cost(target, m, candidates, o.seed, interrupt.flag());
  };
  const TradeResults trade_results = trade_results_of(m, wanted, in_turn);
  m.interrupted = *interrupt.flag();
  if (m.interrupted) fmt::print("{}\n", interrupted_text(count_finished(m), chosen.size(), "methods", m));
  fmt::print("{}: {} method{}, RMS errors to 10 %, {} of one estimate\n", target.integral.title, m.curves.size(),
             m.curves.size() == 1 ? "" : "s", m.cost.axis);
  fmt::print("{}", failure_lines(m));
  const auto out_of_time =
      std::count_if(m.curves.begin(), m.curves.end(), [](const ConvergenceCurve& c) { return c.out_of_time; });
  if (out_of_time > 0)
    fmt::print("  --time ended {} of them before N = {}; with more of it others may be cheaper\n", out_of_time,
               options.max_n);
  const int code = report(o, {&target, &m, nullptr, &trade_results}, folders);
  return m.interrupted ? exit_interrupted : code;
}

int run_trade(const TradeCommandOptions& o) {
  if (o.integral.list) return list_integrals();
  mc::require(!o.time || (*o.time > 0 && *o.time <= 1e7), "--time {} must lie in (0, 1e7] seconds", o.time.value_or(0));
  TradeGoals wanted;
  if (!o.errors.empty()) wanted.errors = parse_positive_list("--error", o.errors, 1e300);
  if (!o.seconds.empty()) wanted.seconds = parse_positive_list("--seconds", o.seconds, 1e9);
  if (is_scene(o.integral.integrands)) return run_trade_scene(o, wanted);
  refuse_scene_among(o.integral.integrands);
  refuse_scene_options(o.scene);
  mc::require(o.samplers.empty(), "trade: --samplers is for a scene (.xml); an integral has all");
  const Interrupt interrupt;
  const std::vector<IntegralTarget> targets = targets_of(o.integral);
  const bool is_named = !o.integral.integrands.empty() || o.integral.foreign.is_given();
  mc::require(targets.size() == 1 && is_named, "trade: name one integrand; --list shows them");
  if (!o.integral.expression.domain.empty() && !o.integral.foreign.is_given())
    refuse_constant(o.integral.integrands[0], o.integral.expression);
  const IntegralTarget& target = targets.front();
  const OutputFolders folders(o);

  RunSession session = session_of(o);
  return session.run([&] { return measure_and_report(o, target, wanted, folders, interrupt, session); });
}

} // namespace

Subcommand trade_subcommand() {
  return make_subcommand<TradeCommandOptions>(
      {.name = "trade",
       .summary = "Find the cheapest method for a wanted error, or the most accurate one for a given time",
       .examples = {{"carlo trade pi --error 1e-3", "finds the method that reaches an error of 0.001 first"},
                    {"carlo trade genz_c0_8d --seconds 0.01,0.1", "finds the most accurate methods for these times"},
                    {"carlo trade scene.xml --cost rays --report out", "compares ways to render, and writes a page"}},
       .failure = "a wanted error or time was not reached, or a truth is doubtful",
       .sections = {expression_section()}},
      rows, run_trade);
}

} // namespace carlo

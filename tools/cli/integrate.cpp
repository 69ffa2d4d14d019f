#include <integrands/find.h>
#include <integrate/derived.h>
#include <integrate/histogram.h>
#include <integrate/integrate_sets.h>
#include <integrate/sweep.h>
#include <options/expression_help.h>
#include <options/expression_options.h>
#include <options/foreign_options.h>
#include <options/run_session.h>
#include <options/subcommand.h>
#include <report/integrate_output.h>
#include <report/plot.h>
#include <terminal/interrupt.h>
#include <terminal/message.h>
#include <terminal/progress.h>
#include <terminal/result_file.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>
#include <mc/estimate/adapt/density_file.h>
#include <mc/estimate/values/quantiles.h>
#include <mc/run/job_log.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace carlo {

namespace {

struct IntegrateCommandOptions {
  std::vector<std::string> integrands; ///< names, or expressions
  ExpressionContext expression;        ///< domain and names of expressions
  ForeignOptions foreign;
  ImportanceOptions importance;
  std::vector<std::string> names;   ///< of the integrands
  std::vector<std::string> derived; ///< functions of the integrals
  bool list = false;
  double rel_error = 1e-3, abs_error = 0;
  std::uint64_t max_calls = 10'000'000, min_calls = 10'000;
  std::string method = "auto";
  std::uint64_t seed = 1;
  int threads = 0;
  bool rounds = false;
  std::string histogram, quantiles;
  std::string save_density, load_density;
  std::string json, output;
  CheckpointFiles checkpoint;
  std::string command;
};

std::vector<Option> rows(IntegrateCommandOptions& o) {
  OptionGroup expert{
      expert_options,
      {
          {"--method", "NAME", &o.method, "Estimator: auto, plain, stratified, rqmc, vegas or tree."},
          output_file(
              {"--save-density", "FILE", &o.save_density, "Write the density that vegas, tree or auto learned."}),
          input_file(
              {"--load-density", "FILE", &o.load_density,
               "Start from a density that --save-density wrote for this integrand or a similar one. Learning goes on "
               "where it does not fit."}),
          {"--threads", "N", &o.threads, "Threads; 0 is all processors."},
          resume_row(o.checkpoint),
      }};
  const std::vector<Option> files = checkpoint_rows(o.checkpoint);
  expert.options.insert(expert.options.end(), files.begin(), files.end());
  return in_groups({
      {common_options,
       {
           {"INTEGRAND", "", &o.integrands,
            "Name (see --list) or expression, e.g. \"exp(-x*x)*cos(y)\". Several are evaluated at the same points."},
           domain_option(o.expression),
           {"--name", "NAME", &o.names,
            "Short name of an integrand for the output: once for each integrand, in their order."},
           {"--rel-error", "RATIO", &o.rel_error, "Relative standard error to reach; 0: none."},
           {"--abs-error", "ERROR", &o.abs_error,
            "Absolute standard error that also suffices, in units of the integral."},
           {"--max-calls", "N", &o.max_calls,
            "Most evaluations of the integrand. The values of a sweep share them, but at least 16384 each."},
           {"--min-calls", "N", &o.min_calls,
            "Fewest evaluations before the run may stop. More of them find smaller features of the integrand."},
           {"--seed", "N", &o.seed, "Seed of the random numbers. The same seed gives the same bits."},
           {"--list", "", &o.list, "List the named integrands, and stop."},
           output_file(
               {"--json", "FILE", &o.json, "Write the result and its rounds to this file; - is standard output."}),
       }},
      expression_group(o.expression),
      foreign_group(o.foreign),
      importance_group(o.importance),
      {"More results",
       {
           {"--derive", "EXPR", &o.derived,
            "Print a function of the integrals, e.g. \"A/B\" or \"A-B\", with the error that their covariance gives. A "
            "and B are names of --name; without names the integrals are I1, I2, ... The parts of a complex integral "
            "end in _re and _im. Can be given several times."},
           output_folder({"-o,--output", "FOLDER", &o.output,
                          "Folder for sweep.csv, .gp, .svg and .png of a sweep, as --set a=1:3:0.5 asks for."},
                         {"sweep.csv", "sweep.gp", "sweep.svg", "sweep.png"}),
           {"--rounds", "", &o.rounds, "Print the estimate of every round, and how well the rounds agree."},
           {"--histogram", "AXIS=BINS", &o.histogram,
            "Print the shares of the integral along a variable (u0, u1, ... of a named integrand), each with its "
            "error. AXIS=LO:HI:BINS: by any expression of the variables, e.g. \"x+y=0:2:20\". value=BINS: by the "
            "sizes of values, in powers of 2."},
           {"--quantiles", "LIST", &o.quantiles,
            "Print quantiles of the integrand over its domain, e.g. 0.05,0.5,0.95. Takes as many calls again, at least "
            "98 k and at most 2^24 / (dimensions + 2)."},
       }},
      expert,
  });
}

HelpSection automatic_section() {
  return {
      "How --method auto works",
      {
          {"1",
           "rqmc: 16 scrambled Sobol' sequences, whose lengths double until their means agree to the wanted error."},
          {"2", "From 4096 calls on, learns from half of the points where others should lie (a grid; a tree of boxes "
                "where few points dominate). The other half forecasts whether new sequences there reach the wanted "
                "error earlier."},
          {"3", "If so, starts them, compares after as many calls, and keeps the better ones. Refines the density when "
                "the calls have doubled."},
          {"4", "Stops at the wanted error, but not before --min-calls, or at --max-calls."},
          {"error bar", "Covers what the points met. No error bar covers a narrow peak that no point met: raise "
                        "--min-calls, or name its place with --peak."},
      }};
}

std::vector<double> probabilities(const std::string& list) {
  std::vector<double> all;
  if (list.empty()) return all;
  for (const std::string_view word : mc::split(list, ',')) {
    const std::optional<double> p = mc::parse_double(word);
    mc::require(p.has_value(), "--quantiles: '{}' is not a number", word);
    mc::require(*p > 0 && *p < 1, "--quantiles: {} must lie between 0 and 1", *p);
    all.push_back(*p);
  }
  return all;
}

// Takes the same number of calls as the integral. Returns false when interrupted.
bool find_quantiles(IntegrateResults& found, const IntegrandSet& set, const std::vector<double>& wanted,
                    const IntegrateCommandOptions& o, const Interrupt& interrupt) try {
  if (wanted.empty()) return true;
  const UnitCubeIntegral& e = set.integrands.front();
  const double volume = measure_of(set, "--quantiles");
  const std::uint64_t most = std::min<std::uint64_t>(o.max_calls, (1u << 24) / static_cast<unsigned>(e.dim + 2)),
                      calls = found.results.outputs.front().calls;
  found.quantiles = mc::quantiles([&](std::span<const double> u) { return e.f(u) / volume; }, e.dim, wanted,
                                  {.calls = std::clamp(calls, std::min<std::uint64_t>(98'304, most), most),
                                   .seed = o.seed,
                                   .threads = o.threads,
                                   .cancel = interrupt.flag()});
  return true;
} catch (const mc::Error&) {
  if (!*interrupt.flag()) throw;
  fmt::print(stderr, "interrupted before the quantiles were found\n");
  return false;
}

// Refuses names that are no variable names, stand twice, or are fewer or more than the integrands.
void require_names(const std::vector<std::string>& names, std::size_t integrands) {
  mc::require(names.empty() || names.size() == integrands,
              "--name is given {} times for {} integrands; give it once for each", names.size(), integrands);
  for (std::size_t i = 0; i < names.size(); ++i) {
    mc::with_context("--name", [&] { require_variable_name(names[i]); });
    mc::require(std::find(names.begin(), names.begin() + std::ptrdiff_t(i), names[i]) ==
                    names.begin() + std::ptrdiff_t(i),
                "--name '{}' is given twice", names[i]);
  }
}

// Names of the integrands of a set: those of --name, or I1, I2, ... The parts of a complex one end in _re and _im.
std::vector<std::string> names_of(const IntegrandSet& set, const std::vector<std::string>& given) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < set.integrands.size(); ++i) {
    const std::size_t text = set.texts[i];
    names.push_back(given.empty() ? fmt::format("I{}", text + 1) : given[text]);
    if (set.is_complex(i)) names.back() += "_re";
    if (i > 0 && set.is_complex(i - 1)) names.back() += "_im";
  }
  return names;
}

// The names of --name, or of the outputs of a program.
std::vector<std::string> given_names(const IntegrateCommandOptions& o) {
  return o.names.empty() && !o.foreign.command.empty() ? o.integrands : o.names;
}

// The integrands of a program, a plugin, or expressions, with points from the importance density.
IntegrandSet integrand_set(const IntegrateCommandOptions& o, const ExpressionContext& context) {
  const bool has_foreign_code = o.foreign.is_given() || !o.importance.plugin.empty() || !o.importance.command.empty();
  const ResourceLimits limits = resource_limits(o.foreign.timeout, o.foreign.memory, has_foreign_code);
  require_importance_options(o.importance);
  IntegrandSet set;
  if (o.foreign.is_given()) {
    JointIntegrand all = foreign_integrand(o.foreign, o.integrands, context);
    set = {std::move(all.outputs), {}, nullptr, std::move(all.f)};
    for (std::size_t k = 0; k < set.integrands.size(); ++k) set.texts.push_back(k);
  } else {
    set = find_integrands(o.integrands, context);
  }
  if (!o.importance.is_given()) return set;
  mc::require(o.histogram.empty() && o.quantiles.empty(),
              "integrate: --histogram and --quantiles need uniform points; leave out {}",
              o.importance.peaks.empty() ? "the importance density" : "--peak");
  JointIntegrand all = with_importance({set.integrands, set.f}, o.importance, limits);
  return {std::move(all.outputs), set.texts, set.expression, std::move(all.f), true};
}

// Fills the points, integrands and names of `found`. Returns the integrands of each point.
IntegrandSets integrands_of(const IntegrateCommandOptions& o, IntegrateResults& found) {
  mc::require(!o.foreign.dim || o.foreign.is_given(), "--dim is for a --command");
  mc::require(!o.integrands.empty() || o.foreign.is_given(),
              "integrate: name an integrand or give an expression; --list shows the names");
  IntegrandSets sets;
  found.points.clear();
  for (const SweepPoint& point : sweep_points(o.expression.settings)) {
    ExpressionContext context = o.expression;
    context.settings = point.settings;
    sets.push_back(integrand_set(o, context));
    mc::require(sets.back().dim() == sets.front().dim() && sets.back().is_exact_sum() == sets.front().is_exact_sum(),
                "--set: the sums of one value are sampled, those of another are not; sweep within {} terms",
                ExpressionIntegral::summed_terms);
    found.points.push_back(point.swept);
    found.integrands.insert(found.integrands.end(), sets.back().integrands.begin(), sets.back().integrands.end());
  }
  constexpr std::size_t most_integrals = 500;
  mc::require(sets.size() == 1 || found.integrands.size() <= most_integrals,
              "--set: {} integrals; at most {} are possible", found.integrands.size(), most_integrals);
  const std::vector<std::string> given = given_names(o);
  require_names(o.names, sets.front().texts.back() + 1);
  if (!given.empty()) found.names = names_of(sets.front(), given);
  for (std::size_t i = 0; i < found.integrands.size() && !found.names.empty(); ++i)
    found.integrands[i].title = found.names[i % found.names.size()];
  mc::require(found.integrands.size() == 1 || (o.histogram.empty() && o.quantiles.empty()),
              "integrate: --histogram and --quantiles are of one integrand; {} were given", found.integrands.size());
  mc::require(!found.is_sweep() || !o.rounds, "integrate: --rounds is of one run, not of a sweep");
  mc::require(found.is_sweep() || o.output.empty() || o.checkpoint.is_part(),
              "--output is for a sweep, as --set a=1:3:0.5; --json writes a single result");
  return sets;
}

void add_derived(IntegrateResults& found, const std::vector<std::string>& names,
                 const std::vector<std::string>& expressions) {
  for (std::size_t p = 0; p < found.points.size(); ++p)
    for (const std::string& expression : expressions)
      found.derived.push_back(derived_value(expression, names, found.results, p * names.size()));
}

// Writes the table of a sweep, and draws it.
void write_sweep(ResultWriter& results, const IntegrateResults& found, const std::filesystem::path& output,
                 bool is_partial) {
  if (output.empty()) return;
  const std::filesystem::path folder = result_folder(output, "sweep.csv", is_partial);
  results.write((folder / "sweep.csv").string(), false, sweep_csv(found));
  results.write((folder / "sweep.gp").string(), false, sweep_script(found));
  const auto known = [](const mc::Integral& r) { return std::isfinite(r.estimate.std_error); };
  results.attempt([&] {
    if (std::none_of(found.results.outputs.begin(), found.results.outputs.end(), known)) remove_plot(folder, "sweep");
    else if (!draw_plot(folder, "sweep", {"sweep.csv"}))
      warn("gnuplot is not installed; data and script are written, but no plot");
  });
  fmt::print("data and plot: {}\n", folder.string());
}

mc::IntegrateOptions settings_of(const IntegrateCommandOptions& o) {
  mc::IntegrateOptions settings;
  settings.rel_error = o.rel_error;
  settings.abs_error = o.abs_error;
  settings.max_calls = o.max_calls;
  settings.min_calls = o.min_calls;
  settings.method = mc::parse_method(o.method);
  settings.seed = o.seed;
  settings.threads = o.threads;
  if (!o.load_density.empty())
    settings.density = std::make_shared<mc::AdaptedDensity>(mc::load_density(o.load_density));
  return settings;
}

// Whether all errors are known and every integral has the wanted one, as an exit code. Prints a remedy where an error
// is known but too large. A wanted error of 0 asks for all calls, not for an error.
int exit_code_of(const IntegrateResults& found, const mc::IntegrateOptions& o) {
  const auto outputs = found.results.outputs.begin();
  const auto end = outputs + std::ptrdiff_t(found.integrands.size());
  if (!std::all_of(outputs, end, [](const mc::Integral& r) { return r.error_bar == mc::ErrorBar::known; }))
    return exit_failed;
  if (std::ranges::any_of(found.derived, &DerivedValue::has_pole)) return exit_failed;
  const bool reached = std::all_of(outputs, end, [&](const mc::Integral& r) {
    const double wanted = std::max(o.abs_error, o.rel_error * std::abs(r.estimate.value));
    return r.stop == mc::StopReason::converged || r.estimate.std_error <= wanted;
  });
  if (reached || (o.rel_error == 0 && o.abs_error == 0)) return exit_ok;
  const auto may_be_zero = [](const mc::Integral& r) { return r.interval.lo <= 0 && r.interval.hi >= 0; };
  if (o.abs_error == 0 && std::any_of(outputs, end, may_be_zero))
    fmt::print("the wanted error was not reached: it is relative to an integral that may be 0; give --abs-error\n");
  else fmt::print("the wanted error was not reached; raise --max-calls\n");
  return exit_failed;
}

/// Files of the results, and the quantiles that are wanted.
struct IntegrateOutputs {
  ResultFile json;
  std::filesystem::path folder = {}; ///< of a sweep
  std::vector<double> quantiles = {};

  explicit IntegrateOutputs(const std::string& file) : json(file) {}
};

// Everything that the estimates depend on.
mc::RunIdentity identity_of(IntegrateCommandOptions o) {
  return run_identity(rows(o), {"--list", "--name", "--derive", "--rounds", "--quantiles", "--threads", "--timeout",
                                "--memory", "--resume", "--every"});
}

// Returns false when interrupted before the first estimate.
bool estimate(IntegrateResults& found, const IntegrandSets& sets, const Histogram& histogram,
              mc::IntegrateOptions& settings) {
  ProgressLine progress;
  settings.progress = [&](const mc::IntegrateProgress& p) {
    progress.show(double(p.calls) / double(settings.max_calls),
                  fmt::format("{:.8g} ± {:.2g}", p.estimate.value, p.estimate.std_error));
  };
  try {
    found.results = integrate_sets(sets, histogram, settings);
  } catch (const mc::NotFinite& e) {
    throw mc::Error(in_variables(e, sets));
  } catch (const mc::Error&) {
    if (!*settings.cancel) throw;
    progress.clear();
    fmt::print(stderr, "interrupted before anything was estimated\n");
    return false;
  }
  return true;
}

// Prints and writes the results. Returns the exit code.
int report(const IntegrateCommandOptions& o, IntegrateResults& found, const IntegrandSets& sets,
           const Histogram& histogram, const mc::IntegrateOptions& settings, const IntegrateOutputs& outputs,
           const Interrupt& interrupt) {
  for (const IntegrandSet& one : sets)
    if (one.expression) found.replaced += one.expression->take_replaced();
  found.replacement = o.expression.nan.value_or(0);
  for (std::size_t i = 0; i < found.integrands.size(); ++i)
    if (found.results.outputs[i].error_bar == mc::ErrorBar::all_zero) refuse_underflow(found.integrands[i]);
  const mc::Integral r = found.results.outputs.front();
  for (std::size_t k = 0; k < histogram.bins.size(); ++k) {
    const bool is_outside = histogram.has_outside && (k == 0 || k + 1 == histogram.bins.size());
    if (is_outside && found.results.outputs[1 + k].estimate.value == 0) continue;
    found.histogram.push_back(histogram.bins[k]);
    found.histogram.back().integral = found.results.outputs[1 + k];
  }
  const bool cancelled =
      r.stop == mc::StopReason::cancelled || !find_quantiles(found, sets.front(), outputs.quantiles, o, interrupt);

  for (mc::Integral& integral : found.results.outputs) { // a call of a sweep evaluates all of its points
    integral.calls *= sets.size();
    for (mc::IntegrateRound& round : integral.rounds) round.calls *= sets.size();
  }
  add_derived(found, names_of(sets.front(), given_names(o)), o.derived);
  ResultWriter results;
  if (found.is_sweep()) {
    fmt::print("{}{}", sweep_table(found), calls_text(found));
    write_sweep(results, found, outputs.folder, cancelled);
  } else
    fmt::print("{}{}{}{}", integrate_summary(found), o.rounds ? round_table(r) : "", histogram_table(found),
               quantile_table(found));
  if (outputs.json.is_wanted()) outputs.json.write(results, cancelled, integrals_json(found, o.command, o.seed));
  if (!o.save_density.empty()) {
    mc::require(r.density != nullptr || cancelled,
                "--save-density: nothing was learned by {} in {} calls, and {} is not written; "
                "--method vegas or tree always learns",
                name(r.method), r.calls, o.save_density);
    if (r.density)
      results.write(o.save_density, cancelled, [&](const std::string& file) { mc::save_density(file, *r.density); });
  }
  results.finish();
  return cancelled ? exit_interrupted : exit_code_of(found, settings);
}

int run_integrate(const IntegrateCommandOptions& o) {
  if (o.list) {
    for (const UnitCubeIntegral* e : named_integrands()) std::printf("%-26s %s\n", e->name.c_str(), e->title.c_str());
    return exit_ok;
  }
  mc::require(o.save_density != "-", "--save-density: a density goes to a file; name one");
  if (!o.save_density.empty()) mc::require_writable(o.save_density);
  IntegrateOutputs outputs(o.json);
  IntegrateResults found{.integrands = {}, .results = {}};
  const IntegrandSets sets = integrands_of(o, found);
  const IntegrandSet& set = sets.front();
  for (const std::string& expression : o.derived)
    mc::with_context("--derive", [&] { parse_function(expression, names_of(set, given_names(o))); });
  if (!o.output.empty() && !o.checkpoint.is_part()) outputs.folder = mc::make_output_folder(o.output, "sweep.csv");
  outputs.quantiles = probabilities(o.quantiles);
  if (!outputs.quantiles.empty()) measure_of(set, "--quantiles");
  mc::IntegrateOptions settings = settings_of(o);
  constexpr std::uint64_t least_of_sweep = 1 << 14;
  if (found.is_sweep()) settings.max_calls = std::max(o.max_calls / sets.size(), std::min(o.max_calls, least_of_sweep));
  Histogram histogram;
  if (!o.histogram.empty()) histogram = make_histogram(o.histogram, set, o.seed);
  const Interrupt interrupt;
  settings.cancel = interrupt.flag();
  RunSession session(o.checkpoint, identity_of(o), o.output, o.command);
  mc::require(!o.expression.nan || !session.is_shared(),
              "--nan counts the values that it replaces within one process: leave out --nan, or run without a "
              "checkpoint, parts and mpirun");
  return session.run([&]() -> int {
    mc::JobLog log(session.checkpoint(), session.executor());
    if (session.is_shared()) settings.executor = log.executor();
    const bool is_estimated = estimate(found, sets, histogram, settings);
    session.before_results();
    if (*interrupt.flag()) print_how_to_resume(o.checkpoint);
    else log.save();
    return is_estimated ? report(o, found, sets, histogram, settings, outputs, interrupt) : exit_interrupted;
  });
}

} // namespace

Subcommand integrate_subcommand() {
  return make_subcommand<IntegrateCommandOptions>(
      {.name = "integrate",
       .summary = "Estimate an integral, of a named integrand or an expression, with an error bar",
       .examples =
           {{"carlo integrate \"exp(-x*x)*cos(y)\" -d \"x=0:1,y=-1:2\" --rel-error 1e-4",
             "integrates over a rectangle to a relative error of 0.01 %"},
            {"carlo integrate \"exp(-x*x/2)\" -d \"x=-inf:inf\" --histogram x=10",
             "shows which parts of the line the integral comes from"},
            {"carlo integrate \"a*r\" --let \"r=sqrt(x*x+y*y)\" -d \"x=0:1,y=0:x\" --where \"r<1\" --set a=1:2:0.5",
             "integrates over a part of a triangle, for three values of a parameter"}},
       .failure = "the wanted error was not reached, or the error is not known",
       .sections = {automatic_section(), expression_section()}},
      rows, run_integrate);
}

} // namespace carlo

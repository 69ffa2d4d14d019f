#include <converge/output.h>
#include <converge/page.h>
#include <converge/trade.h>
#include <integrands/expression.h>
#include <options/expression_help.h>
#include <options/integral_options.h>
#include <options/subcommand.h>
#include <report/plot.h>
#include <report/report_json.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>
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

namespace carlo {

namespace {

using nlohmann::ordered_json;

struct TradeOptions {
  IntegralOptions integral;
  SceneOptions scene;
  std::string samplers;        ///< of a scene; empty: all
  std::string errors, seconds; ///< lists of numbers
  std::optional<double> time;
  std::uint64_t seed = 1;
  int threads = 0;
  std::string output = "out/trade", report;
  std::string command;
};

std::vector<double> numbers(const char* option, const std::string& text, double most) {
  std::vector<double> all;
  for (const std::string_view part : mc::split(text, ',')) {
    const std::optional<double> x = mc::parse_double(part);
    mc::require(x && *x > 0 && *x <= most, "{}: '{}' in '{}' must be a number above 0, and {:g} at most", option, part,
                text, most);
    all.push_back(*x);
  }
  return all;
}

std::string text_of(const Ranged& r, std::string_view unit) {
  if (r.is_at_most()) return fmt::format("at most {:.3g}{}", r.hi, unit);
  if (r.is_at_least()) return fmt::format("at least {:.3g}{}", r.lo, unit);
  return fmt::format("{:.3g}{} [{:.3g}, {:.3g}]", r.value, unit, r.lo, r.hi);
}

// Prints the candidates that do not differ significantly from the first.
void print_ties(const std::vector<Offer>& offers, Ranged Offer::*by, std::string_view unit) {
  const std::size_t count = as_good(offers, by);
  for (std::size_t i = 1; i < count; ++i)
    fmt::print("{}{} {}", i == 1 ? "      not told from it: " : ", ", label(*offers[i].curve),
               text_of(shown(offers[i], by), unit));
  if (count > 1) fmt::print("\n");
}

// The smallest errors, where no method reaches the wanted one.
void print_nearest(const ForError& f) {
  constexpr std::size_t most = 4;
  fmt::print("  error {:g}: no way came there", f.wanted);
  for (std::size_t i = 0; i < std::min(f.nearest.size(), most); ++i)
    fmt::print("{} {} {}{:.3g} at N = {:.0f}", i == 0 ? "; nearest:" : ",", label(*f.nearest[i].curve),
               f.nearest[i].error.is_at_most() ? "at most " : "", f.nearest[i].error.value, f.nearest[i].n);
  if (f.nearest.size() > most) fmt::print("; all {} are in trade.csv", f.nearest.size());
  fmt::print("; raise --max-n, of a scene --max-spp\n");
}

void print(const ForError& f, const Cost& cost) {
  if (f.offers.empty()) return print_nearest(f);
  const Offer& best = f.offers.front();
  fmt::print("  error {:g}: {} in {}{}, N about {:.0f}", f.wanted, label(*best.curve),
             text_of(shown(best, &Offer::seconds), cost.unit), cost.of, best.n);
  if (f.gain && f.gain->lo < f.gain->hi) fmt::print("; {} times faster than plain Monte Carlo", text_of(*f.gain, ""));
  fmt::print("\n");
  print_ties(f.offers, &Offer::seconds, cost.unit);
}

void print(const ForSeconds& f, const Cost& cost) {
  if (f.offers.empty()) {
    fmt::print("  {:g}{}: no way can begin with so little\n", f.wanted, cost.unit);
    return;
  }
  const Offer& best = f.offers.front();
  fmt::print("  {:g}{}: {} with an error of {}, N about {:.0f}", f.wanted, cost.unit, label(*best.curve),
             text_of(shown(best, &Offer::error), ""), best.n);
  if (best.ended) fmt::print(", its largest, in {:.3g}{}", best.seconds.value, cost.unit);
  if (f.gain) fmt::print("; {} times smaller than plain Monte Carlo's", text_of(*f.gain, ""));
  fmt::print("\n");
  print_ties(f.offers, &Offer::error, "");
  const auto ended = std::count_if(f.offers.begin(), f.offers.end(), [](const Offer& o) { return o.ended; });
  if (ended > 0)
    fmt::print(
        "      {} of {} ways ended before {:g}{}, at their largest N, and may err less; raise --max-n, of a scene "
        "--max-spp\n",
        ended, f.offers.size(), f.wanted, cost.unit);
}

// JSON has no infinity; null stands for it, and for a value of which only a bound is known.
ordered_json to_json(const Ranged& r) {
  const bool is_known = !r.is_at_most() && !r.is_at_least();
  return {{"value", is_known ? ordered_json(r.value) : ordered_json()}, {"lo", r.lo}, {"hi", r.hi}};
}
ordered_json to_json(const std::vector<Offer>& offers, const Cost& cost) {
  ordered_json all = ordered_json::array();
  for (const Offer& o : offers) {
    all.push_back({{"way", label(*o.curve)},
                   {"n", o.n},
                   {std::string(cost.column), to_json(o.seconds)},
                   {"rms_error", to_json(o.error)}});
    if (o.ended) all.back()["ended"] = true;
  }
  return all;
}
template <class For> ordered_json to_json(const For& f, Ranged Offer::*by, const Cost& cost) {
  ordered_json j = {{"wanted", f.wanted}, {"as_good", f.offers.empty() ? 0 : as_good(f.offers, by)}};
  if (f.gain) j["gain_over_plain"] = to_json(*f.gain);
  j["offers"] = to_json(f.offers, cost);
  return j;
}

// gnuplot script: all points, and the Pareto front.
std::string script(const std::string& title, const Measurement& m) {
  std::string s = plot_head("trade", 900, 640);
  s += fmt::format("set title \"{}\" noenhanced\nset logscale xy\nset format xy \"10^{{%L}}\"\nset key outside right "
                   "Left reverse samplen 1\nset xlabel \"{} of one estimate\"\nset ylabel \"root-mean-square "
                   "error\"\nplot \"front.csv\" skip 1 using 3:4 with lines lw 6 lc rgb \"#dddddd\" title \"best\"",
                   title, m.cost.axis);
  for (std::size_t i = 0; i < m.curves.size(); ++i) {
    std::string name = label(m.curves[i]);
    s +=
        fmt::format(", \\\n     \"trade.csv\" skip 1 using (strcol(1) eq \"{}\" ? $3 : NaN):4 with linespoints pt 7 ps "
                    "0.4 lc rgb \"{}\" title \"{}\" noenhanced",
                    name, color(i), name);
  }
  return s + "\n";
}

std::string csv(const std::vector<Offer>& offers, const Cost& cost) {
  std::string text = fmt::format("way,n,{},rms_error,rms_lo,rms_hi\n", cost.column);
  for (const Offer& o : offers)
    text += fmt::format("{},{:.0f},{:.6g},{},{:.9g},{:.9g}\n", label(*o.curve), o.n, o.seconds.value,
                        o.error.is_at_most() ? "" : fmt::format("{:.9g}", o.error.value), o.error.lo, o.error.hi);
  return text;
}

std::vector<Offer> all_points(const Measurement& m) {
  std::vector<Offer> all;
  for (const Curve& c : m.curves)
    for (const mc::RmsError& e : c.errors)
      all.push_back({&c, e.n, {e.seconds, e.seconds, e.seconds}, {e.rms, e.lo, e.hi}});
  return all;
}

// Every point set over double and float, and every estimator; also with one point per call where the integrand takes
// batches.
std::vector<Way> configurations(const Target& target) {
  std::vector<Way> all = ways();
  all.insert(all.end(), float_ways().begin(), float_ways().end());
  if (!target.has_batch) return all;
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(all[i]);
    all.back().one_by_one = true;
  }
  return all;
}

std::vector<Option> rows(TradeOptions& o) {
  OptionGroup common{common_options, integral_rows(o.integral)};
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
      {"-o,--output", "FOLDER", &o.output, "Folder for trade.json, .csv, .gp, .svg, .png and front.csv."},
      {"--report", "FOLDER", &o.report, "Write a page with the choice and all curves to this folder (index.html)."},
  };
  common.options.insert(common.options.end(), own.begin(), own.end());
  OptionGroup scene = scene_group(o.scene);
  scene.options.push_back({"--samplers", "NAMES", &o.samplers,
                           "Point sets of the pixels, comma-separated, see carlo render. Default: all."});
  const OptionGroup expert{
      expert_options,
      {
          {"--time", "SECONDS", &o.time, "Wall-clock time for everything; larger N are left out."},
          {"--seed", "N", &o.seed, "Seed of the random numbers. The same seed gives the same errors."},
          {"--threads", "N", &o.threads, "Threads; 0 is all processors."},
      }};
  return in_groups({common, plugin_group(o.integral), scene, expert});
}

/// The wanted errors and times.
struct Wanted {
  std::vector<double> errors, seconds;
};

/// Output folders, checked before any work.
struct Folders {
  std::filesystem::path data, page; ///< page: empty without --report

  explicit Folders(const TradeOptions& o) : data(mc::make_output_folder(o.output, "trade.json")) {
    if (!o.report.empty()) page = mc::make_output_folder(o.report, "index.html");
  }
};

// `seconds_of_one` takes offers and measures them again.
template <class Seconds> Answers answers_of(const Measurement& m, const Wanted& wanted, const Seconds& seconds_of_one) {
  Answers a;
  for (const double error : wanted.errors)
    a.errors.push_back(offers_for_error(m, error, seconds_of_one(offers_for_error(m, error, as_measured).offers)));
  for (const double budget : wanted.seconds)
    a.seconds.push_back(
        offers_for_seconds(m, budget, seconds_of_one(offers_for_seconds(m, budget, as_measured).offers)));
  a.front = pareto_front(m);
  return a;
}

// Adds the reference picture, and the bias of each method with its interval.
void add(const Pictures& p, ordered_json& j) {
  j["reference"] = {{"spp", p.reference_spp}, {"error", p.reference_error}};
  j["biases"] = ordered_json::array();
  for (std::size_t i = 0; i < p.biases.size(); ++i)
    j["biases"].push_back({{"way", label(p.measurement.curves[i])}, {"bias", to_json(p.biases[i].bias)}});
}

ordered_json to_json(const TradeOptions& o, const Measured& one) {
  const Measurement& m = *one.measurement;
  const Answers& a = *one.answers;
  ordered_json j = {{"command", o.command}, {"commit", commit},
                    {"seed", o.seed},       {"integrand", one.target->integral.name},
                    {"truth", m.truth},     {"truth_error", m.truth_error},
                    {"cost", o.scene.cost}};
  if (m.heavy_tail) j["infinite_variance"] = {{"tail_index", *m.heavy_tail}};
  if (m.interrupted) j["interrupted"] = true;
  if (one.pictures) add(*one.pictures, j);
  j["errors"] = j["seconds"] = ordered_json::array();
  for (const ForError& f : a.errors) {
    j["errors"].push_back(to_json(f, &Offer::seconds, m.cost));
    if (f.offers.empty()) j["errors"].back()["nearest"] = to_json(f.nearest, m.cost);
  }
  for (const ForSeconds& f : a.seconds) j["seconds"].push_back(to_json(f, &Offer::error, m.cost));
  j["front"] = to_json(a.front, m.cost);
  return j;
}

// Prints and writes the results. Returns the exit code.
int tell(const TradeOptions& o, const Measured& one, const Folders& folders) {
  const Measurement& m = *one.measurement;
  const Answers& a = *one.answers;
  const bool exact = std::all_of(m.curves.begin(), m.curves.end(), [](const Curve& c) { return c.exact; });
  const bool anything = std::any_of(m.curves.begin(), m.curves.end(), [](const Curve& c) { return c.is_drawn(); });
  for (const ForError& f : a.errors) print(f, m.cost);
  for (const ForSeconds& f : a.seconds) print(f, m.cost);
  if (exact) fmt::print("  every way is exact to rounding: there is no error to plot\n");
  for (const std::string& warning : {m.doubt, about_variance(m)})
    if (!warning.empty()) fmt::print("  warning: {}\n", warning);
  const std::filesystem::path& folder = folders.data;
  mc::write_file((folder / "trade.csv").string(), csv(all_points(m), m.cost));
  mc::write_file((folder / "front.csv").string(), csv(a.front, m.cost));
  mc::write_file((folder / "trade.json").string(), to_json(o, one).dump(1) + "\n");
  mc::write_file((folder / "trade.gp").string(), script(one.target->integral.title, m));
  if (!anything) remove_plot(folder, "trade");
  else if (!draw_plot(folder, "trade", {"trade.csv", "front.csv"}))
    std::fprintf(stderr, "carlo: warning: gnuplot is not installed; data and scripts are written, but no plots\n");
  fmt::print("data and plots: {}\n", folder.string());
  if (!folders.page.empty()) {
    write_page(folders.page, trade_head(o.command), {one});
    fmt::print("page: {}\n", (folders.page / "index.html").string());
  }
  const auto is_reached = [](const auto& f) { return !f.offers.empty(); };
  const bool reached = std::all_of(a.errors.begin(), a.errors.end(), is_reached) &&
                       std::all_of(a.seconds.begin(), a.seconds.end(), is_reached);
  return reached && m.doubt.empty() ? exit_ok : exit_failed;
}

int trade_scene(const TradeOptions& o, Wanted wanted) {
  refuse_integral_options(o.integral);
  const Interrupt interrupt;
  const Target target = scene_target(o.integral.integrands[0]);
  const Folders folders(o);
  const Pictures pictures = measure_scene(o.scene, {.path = target.integral.source,
                                                    .samplers = o.samplers,
                                                    .to_choose = true,
                                                    .seconds = o.time.value_or(0),
                                                    .seed = o.seed,
                                                    .threads = o.threads,
                                                    .cancel = interrupt.flag()});
  const Measurement& m = pictures.measurement;
  if (m.interrupted) fmt::print("{}\n", interrupted_pictures(pictures));
  if (pictures.ways.empty()) return exit_interrupted;
  if (wanted.errors.empty() && wanted.seconds.empty()) wanted.errors = {0.2, 0.1, 0.05};
  fmt::print("{}: {} ways, {} of one picture\n", target.integral.title, m.curves.size(), m.cost.axis);
  fmt::print("{}", about_pictures(pictures));
  // The pictures were already rendered in turn.
  const Answers answers = answers_of(m, wanted, [](const std::vector<Offer>&) { return as_measured; });
  const int code = tell(o, {&target, &m, &pictures, &answers}, folders);
  return m.interrupted ? exit_interrupted : code;
}

int trade(const TradeOptions& o) {
  if (o.integral.list) return list_integrals();
  mc::require(!o.time || (*o.time > 0 && *o.time <= 1e7), "--time {} must lie in (0, 1e7] seconds", o.time.value_or(0));
  Wanted wanted;
  if (!o.errors.empty()) wanted.errors = numbers("--error", o.errors, 1e300);
  if (!o.seconds.empty()) wanted.seconds = numbers("--seconds", o.seconds, 1e9);
  if (is_scene(o.integral.integrands)) return trade_scene(o, wanted);
  refuse_scene_among(o.integral.integrands);
  refuse_scene_options(o.scene);
  mc::require(o.samplers.empty(), "trade: --samplers is for a scene (.xml); an integral has all");
  const Interrupt interrupt;
  const std::vector<Target> targets = targets_of(o.integral);
  mc::require(targets.size() == 1 && !o.integral.integrands.empty(), "trade: name one integrand; --list shows them");
  if (!o.integral.domain.empty()) refuse_constant(o.integral.integrands[0], o.integral.domain);
  const Target& target = targets.front();
  const Folders folders(o);

  const std::vector<Way> chosen = configurations(target);
  Progress progress;
  MeasureOptions options{.max_n = o.integral.max_n, .seed = o.seed, .threads = o.threads, .cancel = interrupt.flag()};
  options.seconds = o.time.value_or(0);
  std::vector<double>&errors = wanted.errors, &seconds = wanted.seconds;
  if (!errors.empty()) options.error_goal = *std::min_element(errors.begin(), errors.end());
  if (!seconds.empty()) options.cpu_goal = *std::max_element(seconds.begin(), seconds.end());
  options.progress = [&](double done, const std::string& where) { progress.show(done, where); };
  Measurement m = measure(target, chosen, options);
  progress.clear();
  if (m.curves.empty()) {
    fmt::print("interrupted: 0 of {} ways were measured, too few to choose from\n", chosen.size());
    return exit_interrupted;
  }
  if (errors.empty() && seconds.empty())
    for (const double share : {1e-2, 1e-3, 1e-4})
      errors.push_back(share * (std::abs(m.truth) > 4 * m.truth_error ? std::abs(m.truth) : m.size));

  const auto in_turn = [&](const std::vector<Offer>& offers) {
    return taken_in_turn(target, m, offers, o.seed, interrupt.flag());
  };
  const Answers answers = answers_of(m, wanted, in_turn);
  m.interrupted = *interrupt.flag();
  if (m.interrupted) fmt::print("{}\n", interrupted_text(finished(m), chosen.size(), "ways", m));
  fmt::print("{}: {} way{}, RMS errors to 10 %, {} of one estimate\n", target.integral.title, m.curves.size(),
             m.curves.size() == 1 ? "" : "s", m.cost.axis);
  const auto out_of_time =
      std::count_if(m.curves.begin(), m.curves.end(), [](const Curve& c) { return c.out_of_time; });
  if (out_of_time > 0)
    fmt::print("  --time ended {} of them before N = {}; with more of it others may be cheaper\n", out_of_time,
               options.max_n);
  const int code = tell(o, {&target, &m, nullptr, &answers}, folders);
  return m.interrupted ? exit_interrupted : code;
}

} // namespace

Subcommand trade_subcommand() {
  return make_subcommand<TradeOptions>(
      {.name = "trade",
       .summary = "Find the cheapest method for a wanted error, or the most accurate one for a given time",
       .examples = {{"carlo trade pi --error 1e-3", "finds the method that reaches an error of 0.001 first"},
                    {"carlo trade genz_c0_8d --seconds 0.01,0.1", "finds the most accurate methods for these times"},
                    {"carlo trade scene.xml --cost rays --report out", "compares ways to render, and writes a page"}},
       .failure = "a wanted error or time was not reached, or a truth is doubtful",
       .sections = {expression_section()}},
      rows, trade);
}

} // namespace carlo

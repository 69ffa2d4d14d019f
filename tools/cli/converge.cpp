#include <cli/subcommand.h>
#include <integrands/experiments.h>
#include <report/plot.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/parallel.h>
#include <mc/core/sum.h>
#include <mc/core/text.h>
#include <mc/sampler/independent.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>
#include <mc/stats/power_law.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>

namespace carlo {

namespace {

struct ConvergeOptions {
  std::vector<std::string> experiments; ///< empty: all
  bool list = false;
  std::string samplers = "random,stratified,sobol";
  std::uint64_t max_n = 1 << 18;
  int replicates = 128;
  std::uint64_t seed = 1;
  int threads = 0;
  std::string output = "out/convergence";
  std::string command;
};

constexpr std::array<std::string_view, 3> known_samplers = {"random", "stratified", "sobol"};

struct Curve {
  std::string sampler;
  std::vector<mc::RmsError> errors;
  double theory = 0;  ///< slope; 0: none stated
  bool exact = false; ///< no error beyond rounding, so no slope
  mc::PowerLaw law;
};

double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

template <mc::Sampler T> double mean(const Experiment& e, const T& sampler, std::uint64_t n) {
  std::array<double, 8> u{};
  const std::span<const double> point(u.data(), static_cast<std::size_t>(e.dim));
  mc::CompensatedSum sum;
  for (std::uint64_t i = 0; i < n; ++i) {
    for (int d = 0; d < e.dim; ++d)
      u[static_cast<std::size_t>(d)] = mc::coordinate<double>(sampler, i, static_cast<std::uint32_t>(d));
    sum.add(e.f(point));
  }
  return sum.value() / double(n);
}

double estimate(const Experiment& e, std::string_view sampler, std::uint64_t n, std::uint64_t seed) {
  if (sampler == "random") return mean(e, mc::Independent{seed}, n);
  if (sampler == "stratified")
    return mean(e, mc::Stratified(static_cast<std::uint32_t>(n), seed, static_cast<std::uint32_t>(e.dim)), n);
  return mean(e, mc::Sobol(seed), n);
}

// Nothing when it was interrupted.
std::optional<Curve> measure(const Experiment& e, const std::string& sampler, const ConvergeOptions& o,
                             const std::atomic<bool>* cancel, const std::function<void(double)>& progress) {
  Curve curve;
  curve.sampler = sampler;
  curve.theory = sampler == "random" ? -0.5 : sampler == "stratified" ? e.stratified_slope : 0;
  const auto r = static_cast<std::size_t>(o.replicates);
  std::vector<mc::RmsError> fitted;
  double worst = 0;
  for (std::uint64_t n = 16; n <= o.max_n; n *= 2) {
    std::vector<double> estimates(r), seconds(r);
    mc::parallel_for(r, o.threads, [&](std::size_t i) {
      if (*cancel) return;
      const double start = thread_cpu_seconds();
      estimates[i] = estimate(e, sampler, n, mc::hash(o.seed, n, i));
      seconds[i] = thread_cpu_seconds() - start;
    });
    if (*cancel) return {};
    mc::RmsError error = mc::rms_error(double(n), estimates, e.truth);
    std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(r / 2), seconds.end());
    error.seconds = seconds[r / 2]; // the median: the first repetition also fills caches and tables
    curve.errors.push_back(error);
    worst = std::max(worst, error.rms);
    if (double(n) >= e.fit_from) fitted.push_back(error);
    progress(double(n));
  }
  curve.exact = worst <= 1e-12 * std::max(1.0, std::abs(e.truth));
  if (!curve.exact && fitted.size() >= 3)
    curve.law = mc::fit_power_law(fitted, static_cast<std::uint32_t>(o.replicates));
  return curve;
}

std::string slope_text(const Curve& c) {
  if (c.exact) return "exact to rounding";
  std::string text = fmt::format("slope {:+.3f} [{:+.3f}, {:+.3f}]", c.law.slope, c.law.lo, c.law.hi);
  if (c.theory != 0) text += fmt::format(", theory {:+.3f}", c.theory);
  return text;
}

std::string csv(const Experiment& e, const std::vector<Curve>& curves) {
  std::string text = "experiment,sampler,n,rms_error,rms_lo,rms_hi,cpu_seconds\n";
  for (const Curve& c : curves)
    for (const mc::RmsError& p : c.errors)
      text += fmt::format("{},{},{:.0f},{:.9g},{:.9g},{:.9g},{:.6g}\n", e.name, c.sampler, p.n, p.rms, p.lo, p.hi,
                          p.seconds);
  return text;
}

std::string json(const Experiment& e, const std::vector<Curve>& curves, const ConvergeOptions& o) {
  nlohmann::ordered_json j = {{"command", o.command},
                              {"commit", commit},
                              {"seed", o.seed},
                              {"experiment", e.name},
                              {"title", e.title},
                              {"source", e.source},
                              {"dimension", e.dim},
                              {"truth", e.truth},
                              {"replicates", o.replicates},
                              {"fit_from", e.fit_from},
                              {"curves", nlohmann::ordered_json::array()}};
  for (const Curve& c : curves) {
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (const mc::RmsError& p : c.errors)
      points.push_back(
          {{"n", p.n}, {"rms_error", p.rms}, {"rms_lo", p.lo}, {"rms_hi", p.hi}, {"cpu_seconds", p.seconds}});
    nlohmann::ordered_json k = {{"sampler", c.sampler}, {"exact", c.exact}, {"points", points}};
    if (!c.exact)
      k["slope"] = {{"value", c.law.slope}, {"lo", c.law.lo}, {"hi", c.law.hi}, {"constant", c.law.constant}};
    if (c.theory != 0) k["theory"] = c.theory;
    j["curves"].push_back(k);
  }
  return j.dump(1) + "\n";
}

// Two panels: error against N and against CPU time. Colour-blind safe colours, labels at the ends of the curves.
std::string script(const Experiment& e, const std::vector<Curve>& curves) {
  static constexpr std::array colors = {"#4477aa", "#ee6677", "#228833"};
  std::string s = plot_head(e.name, 1000, 440) + fmt::format(R"(set multiplot layout 1,2 title "{}" font ",15"
set logscale xy
set format y "10^{{%L}}"
set key left bottom Left reverse samplen 2 spacing 1.2 tc rgb "#333333"
set ylabel "root-mean-square error"
)",
                                                             e.title);
  const auto panel = [&](const char* column, bool with_guides) {
    std::string plot = "plot ";
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const Curve& c = curves[i];
      if (c.exact) continue;
      const auto color = colors[static_cast<std::size_t>(
          std::find(known_samplers.begin(), known_samplers.end(), c.sampler) - known_samplers.begin())];
      const std::string pick = fmt::format("(strcol(2) eq \"{}\" ? ", c.sampler);
      plot += fmt::format("\"{0}.csv\" skip 1 using {1}{2} : NaN):5:6 with filledcurves fs solid 0.18 noborder lc rgb "
                          "\"{3}\" notitle, \\\n     ",
                          e.name, pick, fmt::format("${}", column), color);
      plot += fmt::format(
          "\"{0}.csv\" skip 1 using {1}{2} : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb \"{3}\" title \"{4}\", "
          "\\\n     ",
          e.name, pick, fmt::format("${}", column), color,
          with_guides ? fmt::format("{}: N^{{{:.2f} ± {:.2f}}}", c.sampler, c.law.slope, (c.law.hi - c.law.lo) / 2)
                      : c.sampler);
      if (with_guides && c.theory != 0)
        plot += fmt::format("{0:.6g} * x**({1:.6g}) with lines dt 3 lw 1 lc rgb \"{2}\" notitle, \\\n     ",
                            c.errors.back().rms / std::pow(c.errors.back().n, c.theory), c.theory, color);
    }
    return plot + "NaN notitle\n";
  };
  s += "set xlabel \"samples N\"\nset format x \"10^{%L}\"\n" + panel("3", true);
  s += "set xlabel \"CPU seconds\"\nset format x \"10^{%L}\"\n" + panel("7", false);
  return s + "unset multiplot\n";
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

// Writes and prints the curves of an experiment. Returns whether gnuplot is there, which is not asked again without.
bool write(const Experiment& e, const std::vector<Curve>& curves, const ConvergeOptions& o,
           const std::filesystem::path& folder, bool can_draw) {
  const std::string base = (folder / e.name).string();
  mc::write_file(base + ".csv", csv(e, curves));
  mc::write_file(base + ".json", json(e, curves, o));
  mc::write_file(base + ".gp", script(e, curves));
  std::printf("%s: %s\n", e.name.c_str(), e.title.c_str());
  for (const Curve& c : curves)
    std::printf("  %-11s RMS error %.3g at N = %.0f, %s\n", c.sampler.c_str(), c.errors.back().rms, c.errors.back().n,
                slope_text(c).c_str());
  const bool anything = std::any_of(curves.begin(), curves.end(), [](const Curve& c) { return !c.exact; });
  if (!can_draw || !anything || draw_plot(folder, e.name)) return can_draw;
  std::fprintf(stderr, "carlo: warning: gnuplot is not installed; data and scripts are written, but no plots\n");
  return false;
}

std::vector<Option> rows(ConvergeOptions& o) {
  return {
      {"EXPERIMENT", "", &o.experiments, "Experiments by name [all]"},
      {"--list", "", &o.list, "List the experiments, and stop"},
      {"--samplers", "NAMES", &o.samplers, "Comma-separated: random, stratified, sobol"},
      {"--max-n", "N", &o.max_n, "Largest number of samples"},
      {"--replicates", "N", &o.replicates, "Independent repetitions behind each RMS error"},
      {"--seed", "N", &o.seed, "Seed"},
      {"--threads", "N", &o.threads, "Threads, 0 for all of the machine's"},
      {"-o,--output", "FOLDER", &o.output, "Folder for CSV, JSON, gnuplot script, SVG and PNG"},
  };
}

int converge(const ConvergeOptions& o) {
  if (o.list) {
    for (const Experiment& e : experiments()) std::printf("%-24s %s\n", e.name.c_str(), e.title.c_str());
    return exit_ok;
  }
  mc::require(o.replicates >= 8, "--replicates {} is too few for an error of the error; at least 8 are needed",
              o.replicates);
  mc::require(o.max_n >= 64 && o.max_n <= (1u << 28), "--max-n {} must lie between 64 and 2^28", o.max_n);
  const std::vector<std::string> samplers = split(o.samplers);
  for (const std::string& s : samplers)
    mc::require(std::find(known_samplers.begin(), known_samplers.end(), s) != known_samplers.end(),
                "unknown sampler '{}'{}; use random, stratified or sobol", s, mc::did_you_mean(s, known_samplers));
  std::vector<const Experiment*> chosen;
  for (const std::string& name : o.experiments) chosen.push_back(&experiment(name));
  if (chosen.empty())
    for (const Experiment& e : experiments()) chosen.push_back(&e);

  const std::filesystem::path folder(o.output);
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  mc::require(!failed, "cannot create the folder '{}': {}", o.output, failed.message());

  const Interrupt interrupt;
  bool can_draw = true;
  Progress progress;
  // Work grows with N: the last N takes half of a curve's time.
  const double total = double(chosen.size() * samplers.size());
  double done = 0;
  for (const Experiment* e : chosen) {
    std::vector<Curve> curves;
    for (const std::string& sampler : samplers) {
      std::optional<Curve> curve = measure(*e, sampler, o, interrupt.flag(), [&](double n) {
        progress.show((done + n / double(o.max_n)) / total, fmt::format("{} {} N = {:.0f}", e->name, sampler, n));
      });
      if (!curve) break;
      curves.push_back(std::move(*curve));
      ++done;
    }
    progress.clear();
    if (!curves.empty()) can_draw = write(*e, curves, o, folder, can_draw);
    if (!*interrupt.flag()) continue;
    std::printf("interrupted: %.0f of %.0f curves were finished\ndata and plots: %s\n", done, total,
                folder.string().c_str());
    return exit_interrupted;
  }
  std::printf("data and plots: %s\n", folder.string().c_str());
  return exit_ok;
}

} // namespace

Subcommand converge_subcommand() {
  return make_subcommand<ConvergeOptions>(
      "converge", "Measure how error falls with samples and with seconds; write data and plots", rows, converge);
}

} // namespace carlo

#include <integrands/expression.h>
#include <integrands/find.h>
#include <integrands/variable_bounds.h>
#include <options/expression_help.h>
#include <options/subcommand.h>
#include <report/integrate_output.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>
#include <terminal/result_file.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>
#include <mc/estimate/adapt/density_file.h>
#include <mc/estimate/values/histogram.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

namespace carlo {

namespace {

struct IntegrateCommandOptions {
  std::vector<std::string> integrands; ///< names, or expressions
  std::string domain;                  ///< "x=0:1,y=-1:2" for an expression
  bool list = false;
  double rel_error = 1e-3, abs_error = 0;
  std::uint64_t max_calls = 10'000'000;
  std::string method = "auto";
  std::uint64_t seed = 1;
  int threads = 0;
  bool rounds = false;
  std::string histogram, quantiles;
  std::string save_density, load_density;
  std::string json;
  std::string command;
};

std::vector<Option> rows(IntegrateCommandOptions& o) {
  return in_groups({
      {common_options,
       {
           {"INTEGRAND", "", &o.integrands,
            "Name (see --list) or expression, e.g. \"exp(-x*x)*cos(y)\". Several are evaluated at the same points."},
           {"-d,--domain", "BOUNDS", &o.domain, "Bounds of an expression's variables, e.g. \"x=0:2*_pi,y=-inf:inf\"."},
           {"--rel-error", "RATIO", &o.rel_error, "Relative standard error to reach."},
           {"--abs-error", "ERROR", &o.abs_error,
            "Absolute standard error that also suffices, in units of the integral."},
           {"--max-calls", "N", &o.max_calls, "Most evaluations of the integrand."},
           {"--seed", "N", &o.seed, "Seed of the random numbers. The same seed gives the same bits."},
           {"--list", "", &o.list, "List the named integrands, and stop."},
           {"--json", "FILE", &o.json, "Write the result and its rounds to this file; - is standard output."},
       }},
      {"More results",
       {
           {"--rounds", "", &o.rounds, "Print the estimate of every round, and how well the rounds agree."},
           {"--histogram", "AXIS=BINS", &o.histogram,
            "Print the shares of the integral along a variable (u0, u1, ... of a named integrand). value=BINS: the "
            "shares of values by size, in powers of 2."},
           {"--quantiles", "LIST", &o.quantiles,
            "Print quantiles of the integrand over its domain, e.g. 0.05,0.5,0.95. Takes as many calls again, at least "
            "98 k and at most 2^24 / (dimensions + 1)."},
       }},
      {expert_options,
       {
           {"--method", "NAME", &o.method, "Estimator: auto, plain, stratified, rqmc, vegas or tree."},
           {"--save-density", "FILE", &o.save_density, "Write the density that vegas, tree or auto learned."},
           {"--load-density", "FILE", &o.load_density,
            "Start from a density that --save-density wrote for this integrand or a similar one. Learning goes on "
            "where "
            "it does not fit."},
           {"--threads", "N", &o.threads, "Threads; 0 is all processors."},
       }},
  });
}

double number(std::string_view word, const char* option) {
  const std::optional<double> value = mc::parse_double(word);
  mc::require(value.has_value(), "{}: '{}' is not a number", option, word);
  return *value;
}

std::vector<VariableBounds> bounds_of(const IntegrateCommandOptions& o, int dim) {
  if (!o.domain.empty()) return parse_bounds(o.domain);
  std::vector<VariableBounds> bounds(static_cast<std::size_t>(dim));
  for (std::size_t d = 0; d < bounds.size(); ++d) bounds[d] = {fmt::format("u{}", d), 0, 1};
  return bounds;
}

// Bins, and the function that finds the bin of a point and its value.
struct HistogramBins {
  std::vector<HistogramBin> bins;
  mc::BinFunction bin_of;
};

// Bins of equal length in u. On an infinite side their lengths in x grow outward.
HistogramBins bins_along_variable(const std::vector<VariableBounds>& bounds, const std::string& variable,
                                  std::size_t count) {
  const auto side =
      std::find_if(bounds.begin(), bounds.end(), [&](const VariableBounds& s) { return s.name == variable; });
  mc::require(side != bounds.end(), "--histogram: there is no variable '{}'; use one of the domain's, or value",
              variable);
  const auto axis = static_cast<std::size_t>(side - bounds.begin());
  const auto n = static_cast<double>(count);
  HistogramBins all{{}, [=](std::span<const double> u, double) { return static_cast<std::size_t>(u[axis] * n); }};
  for (std::size_t k = 0; k < count; ++k) {
    const double lo = map_to_bounds(*side, static_cast<double>(k) / n).x,
                 hi = map_to_bounds(*side, static_cast<double>(k + 1) / n).x;
    all.bins.push_back({fmt::format("{} in [{:.4g}, {:.4g})", variable, lo, hi), lo, hi, {}});
  }
  return all;
}

// Bins by size: powers of 2 below the largest of 4096 values of the integrand times the volume of the domain.
HistogramBins bins_by_value(const UnitCubeIntegral& e, double volume, std::size_t count, std::uint64_t seed) {
  const double top_quantile[] = {1 - 1e-9};
  const double largest = mc::quantiles([&](std::span<const double> u) { return std::abs(e.f(u)); }, e.dim, top_quantile,
                                       {.calls = 4096, .seed = seed})
                             .front()
                             .value;
  mc::require(largest > 0, "--histogram: the integrand was 0 at 4096 points; there is no size to start from");
  const double top = std::ldexp(volume, std::ilogb(largest / volume));
  HistogramBins all{{}, [=](std::span<const double>, double value) { return mc::octave_bin(top, value, count); }};
  for (std::size_t k = 0; k < count; ++k) {
    const double lo = k + 1 < count ? std::ldexp(top / volume, -static_cast<int>(k)) : 0.0;
    const double hi =
        k > 0 ? std::ldexp(top / volume, 1 - static_cast<int>(k)) : std::numeric_limits<double>::infinity();
    all.bins.push_back({fmt::format("|value| in [{:.4g}, {:.4g})", lo, hi), lo, hi, {}});
  }
  return all;
}

// The factor between the values of UnitCubeIntegral::f and those of the expression.
double volume_of(const std::vector<VariableBounds>& bounds, const char* option) {
  double volume = 1;
  for (const VariableBounds& s : bounds) {
    mc::require(s.is_finite(), "{}: the domain is infinite along {}; values need a finite volume", option, s.name);
    volume *= s.hi - s.lo;
  }
  return volume;
}

HistogramBins bins_of(const IntegrateCommandOptions& o, const UnitCubeIntegral& e) {
  const std::size_t equals = o.histogram.find('=');
  mc::require(equals != std::string::npos, "--histogram '{}' must be AXIS=BINS, e.g. x=20", o.histogram);
  const std::string axis = o.histogram.substr(0, equals);
  const double count = number(std::string_view(o.histogram).substr(equals + 1), "--histogram");
  mc::require(count >= 2 && count <= 1000 && count == std::floor(count),
              "--histogram: {} bins; a whole number between 2 and 1000 is needed", count);
  const std::vector<VariableBounds> bounds = bounds_of(o, e.dim);
  const bool a_variable =
      std::any_of(bounds.begin(), bounds.end(), [&](const VariableBounds& s) { return s.name == axis; });
  const auto bins = static_cast<std::size_t>(count);
  return axis == "value" && !a_variable ? bins_by_value(e, volume_of(bounds, "--histogram"), bins, o.seed)
                                        : bins_along_variable(bounds, axis, bins);
}

std::vector<double> probabilities(const std::string& list) {
  std::vector<double> all;
  if (!list.empty())
    for (const std::string_view word : mc::split(list, ',')) all.push_back(number(word, "--quantiles"));
  for (const double p : all) mc::require(p > 0 && p < 1, "--quantiles: {} must lie between 0 and 1", p);
  return all;
}

// Takes the same number of calls as the integral. Returns false when interrupted.
bool find_quantiles(IntegrateResults& found, const std::vector<double>& wanted, const IntegrateCommandOptions& o,
                    const Interrupt& interrupt) try {
  if (wanted.empty()) return true;
  const UnitCubeIntegral& e = found.integrands.front();
  const double volume = volume_of(bounds_of(o, e.dim), "--quantiles");
  const std::uint64_t most = std::min<std::uint64_t>(o.max_calls, (1u << 24) / static_cast<unsigned>(e.dim + 1)),
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

// Integrates all integrands together, or one with its histogram.
mc::VectorIntegral results_of(const std::vector<UnitCubeIntegral>& all, const HistogramBins& bins,
                              const mc::IntegrateOptions& o) {
  const UnitCubeIntegral& e = all.front();
  if (!bins.bins.empty()) return mc::integrate_histogram(e.f, e.dim, bins.bins.size(), bins.bin_of, o);
  if (all.size() == 1) return {{mc::integrate_unit(e.f, e.dim, o)}, {1}};
  const mc::VectorIntegrand f = [&](std::span<const double> u, std::span<double> values) {
    for (std::size_t i = 0; i < all.size(); ++i) values[i] = all[i].f(u);
  };
  return mc::integrate_unit(f, static_cast<int>(all.size()), e.dim, o);
}

// The message about a point u where the integrand is not finite, in the integrand's own variables.
std::string in_variables(const mc::NotFinite& e, const std::vector<UnitCubeIntegral>& all, const std::string& domain) {
  if (!all.front().describe_point) return e.what();
  const std::string message = mc::NotFinite(e.bad, e.points, e.u, all.front().describe_point(e.u)).what();
  const auto bad =
      std::find_if(all.begin(), all.end(), [&](const UnitCubeIntegral& x) { return !std::isfinite(x.f(e.u)); });
  if (domain.empty() || bad == all.end() || !std::isnan(bad->f(e.u))) return message;
  const std::vector<VariableBounds> bounds = parse_bounds(domain);
  const bool finite = std::all_of(bounds.begin(), bounds.end(), [](const VariableBounds& s) { return s.is_finite(); });
  return message + (finite ? "; it is nan there"
                           : "; it is nan there: inf * 0 or inf - inf? Merge the exponents or bound the domain");
}

std::vector<UnitCubeIntegral> integrands_of(const IntegrateCommandOptions& o) {
  mc::require(!o.integrands.empty(), "integrate: name an integrand or give an expression; --list shows the names");
  std::vector<UnitCubeIntegral> all;
  for (const std::string& text : o.integrands) {
    all.push_back(find_integrand(text, o.domain));
    mc::require(all.back().dim == all.front().dim, "integrate: '{}' has {} dimensions, '{}' {}; they must be the same",
                all.back().name, all.back().dim, all.front().name, all.front().dim);
  }
  mc::require(all.size() == 1 || (o.histogram.empty() && o.quantiles.empty()),
              "integrate: --histogram and --quantiles are of one integrand; {} were given", all.size());
  return all;
}

mc::IntegrateOptions settings_of(const IntegrateCommandOptions& o) {
  mc::IntegrateOptions settings;
  settings.rel_error = o.rel_error;
  settings.abs_error = o.abs_error;
  settings.max_calls = o.max_calls;
  settings.method = mc::parse_method(o.method);
  settings.seed = o.seed;
  settings.threads = o.threads;
  if (!o.load_density.empty())
    settings.density = std::make_shared<mc::AdaptedDensity>(mc::load_density(o.load_density));
  return settings;
}

// Whether every integral has the wanted error, as an exit code. Prints a remedy where an error is known but too large.
int exit_code_of(const IntegrateResults& found, const mc::IntegrateOptions& o) {
  const auto outputs = found.results.outputs.begin();
  const auto end = outputs + std::ptrdiff_t(found.integrands.size());
  if (!std::all_of(outputs, end, [](const mc::Integral& r) { return r.error_bar == mc::ErrorBar::known; }))
    return exit_failed;
  const bool reached = std::all_of(outputs, end, [&](const mc::Integral& r) {
    const double wanted = std::max(o.abs_error, o.rel_error * std::abs(r.estimate.value));
    return r.stop == mc::StopReason::converged || r.estimate.std_error <= wanted;
  });
  if (!reached) fmt::print("the wanted error was not reached; raise --max-calls\n");
  return reached ? exit_ok : exit_failed;
}

int run_integrate(const IntegrateCommandOptions& o) {
  if (o.list) {
    for (const UnitCubeIntegral* e : named_integrands()) std::printf("%-26s %s\n", e->name.c_str(), e->title.c_str());
    return exit_ok;
  }
  mc::require(o.save_density != "-", "--save-density: a density goes to a file; name one");
  if (!o.save_density.empty()) mc::require_writable(o.save_density);
  mc::require(o.json.empty() || o.json != o.save_density,
              "--json and --save-density would both write '{}'; name another file", o.json);
  const ResultFile json(o.json);
  IntegrateResults found{.integrands = integrands_of(o), .results = {}};
  const UnitCubeIntegral& first = found.integrands.front();
  const std::vector<double> wanted = probabilities(o.quantiles);
  if (!wanted.empty()) volume_of(bounds_of(o, first.dim), "--quantiles");
  mc::IntegrateOptions settings = settings_of(o);
  HistogramBins bins;
  if (!o.histogram.empty()) bins = bins_of(o, first);
  ProgressLine progress;
  settings.progress = [&](const mc::IntegrateProgress& p) {
    progress.show(double(p.calls) / double(o.max_calls),
                  fmt::format("{:.8g} ± {:.2g}", p.estimate.value, p.estimate.std_error));
  };
  const Interrupt interrupt;
  settings.cancel = interrupt.flag();
  try {
    found.results = results_of(found.integrands, bins, settings);
  } catch (const mc::NotFinite& e) {
    throw mc::Error(in_variables(e, found.integrands, o.domain));
  } catch (const mc::Error&) {
    if (!*interrupt.flag()) throw;
    progress.clear();
    fmt::print(stderr, "interrupted before anything was estimated\n");
    return exit_interrupted;
  }
  progress.clear();
  for (std::size_t i = 0; i < found.integrands.size(); ++i)
    if (found.results.outputs[i].error_bar == mc::ErrorBar::all_zero) refuse_underflow(found.integrands[i]);
  const mc::Integral r = found.results.outputs.front();
  for (std::size_t k = 0; k < bins.bins.size(); ++k) {
    found.histogram.push_back(bins.bins[k]);
    found.histogram.back().integral = found.results.outputs[1 + k];
  }
  const bool cancelled = r.stop == mc::StopReason::cancelled || !find_quantiles(found, wanted, o, interrupt);

  fmt::print("{}{}{}{}", integrate_summary(found), o.rounds ? round_table(r) : "", histogram_table(found),
             quantile_table(found));
  if (json.is_wanted()) json.write(integrals_json(found, o.command, o.seed));
  if (!o.save_density.empty()) {
    mc::require(r.density != nullptr,
                "--save-density: nothing was learned by {} in {} calls, and {} is not written; "
                "--method vegas or tree always learns",
                name(r.method), r.calls, o.save_density);
    mc::save_density(o.save_density, *r.density);
  }
  return cancelled ? exit_interrupted : exit_code_of(found, settings);
}

} // namespace

Subcommand integrate_subcommand() {
  return make_subcommand<IntegrateCommandOptions>(
      {.name = "integrate",
       .summary = "Estimate an integral, of a named integrand or an expression, with an error bar",
       .examples = {{"carlo integrate \"exp(-x*x)*cos(y)\" -d \"x=0:1,y=-1:2\" --rel-error 1e-4",
                     "integrates over a rectangle to a relative error of 0.01 %"},
                    {"carlo integrate \"exp(-x*x/2)\" -d \"x=-inf:inf\" --histogram x=10",
                     "shows which parts of the line the integral comes from"},
                    {"carlo integrate pi --method rqmc --json pi.json",
                     "integrates a named integrand, and writes JSON"}},
       .failure = "the wanted error was not reached, or the error is not known",
       .sections = {expression_section()}},
      rows, run_integrate);
}

} // namespace carlo

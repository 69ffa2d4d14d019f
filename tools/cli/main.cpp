/// carlo: the command line. The only file that includes CLI11.

#include <cli/commands.h>
#include <terminal/version.h>

#include <mc/core/error.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

namespace {

constexpr const char* exit_codes =
    "Exit codes: 0 done and every check passed; 1 a check failed; 2 bad usage, file or value; 130 interrupted.";

constexpr const char* validate_files =
    "--samples-file: one sample a row, numbers separated by commas or blanks; # begins a comment, a first row of names "
    "is left out.\n"
    "  x on an interval; x,y on a rectangle; a unit vector x,y,z, to 1e-5, on the sphere.\n"
    "--pdf-file: W numbers in each of H rows; cell (column i, row j) holds the mean of the density over\n"
    "  x in lo + (hi-lo) [i,i+1]/W, y in lo + (hi-lo) [j,j+1]/H, the first row at the least y; an interval has one "
    "row;\n"
    "  on the sphere azimuth 2 pi [i,i+1]/W from +x toward +y, angle pi [j,j+1]/H from +z, per steradian.\n"
    "  An image is grey (R = G = B), its top row first. The integral is 1 to 1e-4, or any with --unnormalized.\n";

// 1e6 is a count too.
const CLI::Validator count(
    [](std::string& text) {
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (end != text.c_str() && *end == 0 && value == std::floor(value) && std::abs(value) <= 0x1p53)
        text = fmt::format("{:.0f}", value);
      return std::string();
    },
    "");

void add_render(CLI::App& app, carlo::RenderOptions& o) {
  auto* c = app.add_subcommand("render", "Render a Mitsuba XML scene to EXR, PFM or PNG, with an error bar");
  c->footer(exit_codes);
  c->add_option("SCENE", o.scene, "Scene file (Mitsuba XML)");
  c->add_flag("--help-scene", o.help_scene, "Print what a scene file may hold, as Markdown, and stop");
  c->add_option("--dialect", o.dialect, "Whose defaults hold in the scene: mitsuba or lajolla")->capture_default_str();
  c->add_option("-o,--output", o.output,
                "Image to write: .exr (radiance and variance), .pfm or .png (sRGB) [SCENE.exr here]");
  auto* budget = c->add_option_group("budget", "How long (one of these; default: the scene's samples per pixel)");
  budget->add_option("--spp", o.spp, "Samples per pixel")->transform(count);
  budget->add_option("--time", o.seconds, "Wall-clock seconds");
  budget->add_option("--target-error", o.target_error, "Mean relative standard error of the pixels to reach");
  budget->require_option(0, 1);
  c->add_option("--size", o.size, "Image size WxH in pixels [the scene's]");
  c->add_option("--strategy", o.strategy, "bsdf, hemisphere, light, mixture, nee or mis [mis]");
  c->add_option("--sampler", o.sampler, "independent, stratified or sobol [sobol]");
  c->add_option("--max-depth", o.max_depth, "Longest path in edges, -1 for no limit [the scene's]");
  c->add_option("--seed", o.seed, "Seed; same seed, same bits, whatever the number of threads")->capture_default_str();
  c->add_option("--threads", o.threads, "Threads, 0 for all of the machine's")->capture_default_str();
  c->add_option("--exposure", o.exposure, "Stops added before a PNG is written")->capture_default_str();
  c->add_flag("--allow-invalid", o.allow_invalid, "Write the image although some samples were not finite");
}

void add_compare(CLI::App& app, carlo::CompareOptions& o) {
  auto* c =
      app.add_subcommand("compare", "Say whether two images agree: error metrics, and z-tests where variance is known");
  c->footer(exit_codes);
  c->add_option("A", o.a, "Image")->required();
  c->add_option("B", o.b, "Image, the reference of relative metrics")->required();
  c->add_option("--metric", o.metric,
                "Print only this: mse, rmse, mae, relmse, max or mean_ratio [all, and the verdict]");
  c->add_option("--diff", o.diff, "Write the difference image to this file");
  c->add_option("--alpha", o.alpha, "Chance that two correct images are called different, over all tests")
      ->capture_default_str();
  c->add_option("--tolerance", o.tolerance, "Difference, relative to B, that still counts as agreement")
      ->capture_default_str();
}

void add_validate(CLI::App& app, carlo::ValidateOptions& o) {
  auto* c = app.add_subcommand("validate",
                               "Check samplers against their laws: chi-square, KS, mass, Jacobian, inverse, oracle");
  c->footer(fmt::format("{}\n{}", validate_files, exit_codes));
  c->add_option("NAME", o.names,
                "Samplers to check, by name (see --list); book-slips [SLIP...]: the wrong samplers of the books and "
                "what rejects them");
  c->add_flag("--all", o.all, "Check every sampler");
  c->add_flag("--list", o.list, "List every sampler with its parameters, and stop");
  c->add_option("--alpha", o.alpha, "Chance of a false rejection, over all tests of the run")->capture_default_str();
  auto* samples = c->add_option("--samples", o.samples, "Samples per case")->transform(count)->capture_default_str();
  c->add_option("--detect", o.detect,
                "Choose the samples that catch this relative error of a density (0.003: 0.3 %) with probability .99")
      ->excludes(samples);
  c->add_option("--seed", o.seed, "Seed")->capture_default_str();
  c->add_option("--scalar", o.scalar, "float or double [both]");
  c->add_option("--threads", o.threads, "Threads, 0 for all of the machine's")->capture_default_str();
  c->add_option("--json", o.json, "Write the results to this file");
  c->add_option("--junit", o.junit, "Write the results to this file as JUnit XML");
  c->add_option("--report", o.report, "Write a page with maps and curves of every case to this folder (index.html)");
  c->add_option("--plugin", o.plugin, "Check the samplers of this shared object, compiled against <mc/check/plugin.h>");
  c->add_option("--params", o.parameters,
                "Parameters of the plugin's samplers, \"alpha=0.1,n=3\"; each --params is a case")
      ->allow_extra_args(false);
  c->add_option("--timeout", o.timeout, "Seconds that the plugin may take per case")->capture_default_str();
  c->add_option("--samples-file", o.samples_file,
                "Check these samples against the density of --pdf-file; all of them count")
      ->excludes(samples);
  c->add_option("--pdf-file", o.pdf_file, "Density on a grid: .csv, .exr or .pfm");
  c->add_option("--domain", o.domain,
                "Of the grid: \"x=lo:hi\", \"x=lo:hi,y=lo:hi\" or sphere [by the columns: 1 or 2 in 0:1, 3 sphere]");
  c->add_flag("--unnormalized", o.unnormalized, "The grid is only proportional to the density");
  c->add_flag("--open-interval", o.open_interval, "u lies in (0,1): accept samplers that break where a u is exactly 0");
}

void add_converge(CLI::App& app, carlo::ConvergeOptions& o) {
  auto* c =
      app.add_subcommand("converge", "Measure how error falls with samples and with seconds; write data and plots");
  c->footer(exit_codes);
  c->add_option("EXPERIMENT", o.experiments, "Experiments by name [all]");
  c->add_flag("--list", o.list, "List the experiments, and stop");
  c->add_option("--samplers", o.samplers, "Comma-separated: random, stratified, sobol")->capture_default_str();
  c->add_option("--max-n", o.max_n, "Largest number of samples N")->transform(count)->capture_default_str();
  c->add_option("--replicates", o.replicates, "Independent repetitions behind each RMS error")->capture_default_str();
  c->add_option("--seed", o.seed, "Seed")->capture_default_str();
  c->add_option("--threads", o.threads, "Threads, 0 for all of the machine's")->capture_default_str();
  c->add_option("-o,--output", o.output, "Folder for CSV, JSON, gnuplot script, SVG and PNG")->capture_default_str();
}

void add_integrate(CLI::App& app, carlo::IntegrateOptions& o) {
  auto* c = app.add_subcommand("integrate", "Integrate a named integrand or an expression, with an error bar");
  c->footer(exit_codes);
  c->add_option("INTEGRAND", o.integrand, "Name (see --list) or expression, e.g. \"exp(-x*x)*cos(y)\"");
  c->add_option("-d,--domain", o.domain, "Bounds of an expression's variables, e.g. \"x=0:1,y=-1:2\"");
  c->add_flag("--list", o.list, "List the named integrands, and stop");
  c->add_option("--rel-error", o.rel_error, "Relative standard error to reach")->capture_default_str();
  c->add_option("--abs-error", o.abs_error, "Absolute standard error that also suffices")->capture_default_str();
  c->add_option("--max-calls", o.max_calls, "Most evaluations of the integrand")
      ->transform(count)
      ->capture_default_str();
  c->add_option("--method", o.method, "auto, plain, stratified, rqmc or vegas")->capture_default_str();
  c->add_option("--seed", o.seed, "Seed")->capture_default_str();
  c->add_option("--threads", o.threads, "Threads, 0 for all of the machine's")->capture_default_str();
  c->add_option("--json", o.json, "Write the result to this file");
}

int run(int argc, char** argv) {
  CLI::App app("carlo: Monte Carlo samplers validated, convergence measured, scenes rendered with error bars");
  app.set_version_flag("--version", fmt::format("carlo {} ({})", carlo::version, carlo::commit));
  app.require_subcommand(1);
  app.footer(exit_codes);

  carlo::RenderOptions render;
  carlo::CompareOptions compare;
  carlo::ValidateOptions validate;
  carlo::ConvergeOptions converge;
  carlo::IntegrateOptions integrate;
  add_validate(app, validate);
  add_converge(app, converge);
  add_integrate(app, integrate);
  add_render(app, render);
  add_compare(app, compare);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e); // --help, --version
    throw mc::Error(fmt::format("{} (see carlo --help)", e.what()));
  }

  std::string command = "carlo";
  for (int i = 1; i < argc; ++i) command += fmt::format(" {}", argv[i]);
  render.command = validate.command = converge.command = integrate.command = command;

  if (app.got_subcommand("render")) return carlo::render(render);
  if (app.got_subcommand("compare")) return carlo::compare(compare);
  if (app.got_subcommand("validate")) return carlo::validate(validate);
  if (app.got_subcommand("converge")) return carlo::converge(converge);
  return carlo::integrate(integrate);
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "carlo: out of memory; ask for a smaller image or fewer samples\n");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "carlo: %s\n", e.what());
  }
  return carlo::exit_bad_input;
}

#include <catalogue/catalogue.h>
#include <cli/validate.h>
#include <input/samples_file.h>
#include <plugin/command.h>
#include <plugin/plugin.h>
#include <report/validate_output.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>
#include <terminal/result_file.h>

#include <mc/check/check_subject.h>
#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/parallel.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>
#include <mc/stats/multiple_testing.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <set>

namespace carlo {
namespace {

std::string plain(const Case& c) { return c.name + (c.parameters.empty() ? "" : "(" + c.parameters + ")"); }

// The cases that a word names: a sampler, or one case as --list prints it. What the user brought is checked whole if
// none is named.
std::vector<const Case*> select(const ValidateOptions& o, const Catalogue& catalogue, bool brought) {
  mc::require(o.scalar.empty() || o.scalar == "float" || o.scalar == "double",
              "validate: --scalar '{}' must be float or double", o.scalar);
  std::vector<const Case*> chosen;
  const auto wanted = [&](const Case& c) { return o.scalar.empty() || c.scalar == o.scalar; };
  if (o.all || ((o.list || brought) && o.names.empty())) {
    for (const Case& c : catalogue)
      if (wanted(c)) chosen.push_back(&c);
  }
  for (const std::string& name : o.names) {
    bool known = false;
    for (const Case& c : catalogue) {
      if (name != c.name && name != plain(c)) continue;
      known = true;
      if (wanted(c)) chosen.push_back(&c);
    }
    if (known) continue;
    std::set<std::string> names;
    for (const Case& c : catalogue) names.insert(c.name);
    throw mc::Error(
        fmt::format("validate: unknown sampler '{}'{} ({})", name, mc::did_you_mean(name, names),
                    brought ? "--list shows what your file brings" : "carlo validate --list names them all"));
  }
  std::vector<const Case*> unique;
  for (const Case* c : chosen)
    if (std::find(unique.begin(), unique.end(), c) == unique.end()) unique.push_back(c);
  mc::require(o.list || !unique.empty(), "validate: {}",
              o.names.empty() ? "name a sampler, or give --all or --list" : "no case over this scalar");
  return unique;
}

// Every case draws its own numbers, the same ones whichever cases run beside it and wherever its file stands.
std::uint64_t seed_of(const Case& c, const ValidateOptions& o) {
  std::string title = c.title();
  if (!o.samples_file.empty()) title = "samples";
  if (!o.sampler_command.empty()) title = "command"; // c.title() says where the program stands
  std::uint64_t seed = o.seed;
  for (const char letter : title) seed = mc::hash(seed, static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
  return seed;
}

std::string error_text(double e) {
  if (e > 1) return ">100 %";
  return e > 0 ? fmt::format("{:.2g} %", 100 * e) : std::string("-");
}

std::string line_of(std::size_t width, const Case& c, const mc::Report& r) {
  const std::string ns = r.ns_per_sample > 0 ? fmt::format("{:.1f}", r.ns_per_sample) : "-";
  return fmt::format("{:<{}} {:<7} {:<12} {:>8.2g} {:>9} {:>9} {:>7} {:>6.2f}\n", plain(c), width, c.scalar,
                     name(r.verdict()), r.p(), error_text(r.detectable), error_text(r.detectable_cell), ns, r.seconds);
}

constexpr const char* file_formats =
    "detects: relative error of the density, of random sign over patches that each hold four cells' share or more and\n"
    "  are compact, not over ten times as long as wide, caught with probability .99; in a cell: in a single such "
    "patch.\n"
    "--samples-file: one sample a row, numbers separated by commas or blanks; # begins a comment, a first row of names "
    "is left out.\n"
    "--domain: parts separated by commas, in the order of the columns, of three dimensions at most:\n"
    "  NAME=LO:HI, also -inf and inf; disk, annulus=INNER (x, y); triangle (x, y >= 0, x + y <= 1); ball, sphere,\n"
    "  hemisphere (x, y, z; unit vectors to 1e-5); or discrete=N, outcomes 0 to N-1 (i), whose probabilities --pdf or\n"
    "  the numbers of --pdf-file give. A grid lies on x=LO:HI, x=LO:HI,y=LO:HI or the sphere.\n"
    "--pdf-file: W numbers in each of H rows; cell (column i, row j) holds the mean of the density over\n"
    "  x in lo + (hi-lo) [i,i+1]/W, y in lo + (hi-lo) [j,j+1]/H, the first row at the least y; an interval has one "
    "row;\n"
    "  on the sphere azimuth 2 pi [i,i+1]/W from +x toward +y, angle pi [j,j+1]/H from +z, per steradian.\n"
    "  An image is grey (R = G = B), its top row first. The integral is 1 to 1e-4, or any with --unnormalized.\n"
    "--command: questions \"sample N K\\n\" with N K doubles u, and \"pdf N C\\n\" with N C doubles x, on the "
    "program's\n"
    "  input; the answers, N C doubles x (not finite: it fails) or N densities, on its output, flushed; "
    "little-endian.\n"
    "--pdf: an expression of muParser with _pi and _e, against length, area, volume or solid angle.\n";

std::vector<Option> rows(ValidateOptions& o) {
  return {
      {"NAME", "", &o.names, "Samplers to check, by name (see --list)"},
      {"--all", "", &o.all, "Check every sampler"},
      {"--list", "", &o.list, "List every sampler with its parameters, and stop"},
      {"--alpha", "PROBABILITY", &o.alpha, "Chance of a false rejection, over all tests of the run"},
      {"--samples", "N", &o.samples, "Samples per case"},
      {"--detect",
       "RATIO",
       &o.detect,
       "Choose the samples that catch this relative error of a density (0.003: 0.3 %) with probability .99",
       false,
       {"--samples"}},
      {"--seed", "N", &o.seed, "Seed"},
      {"--scalar", "TYPE", &o.scalar, "float or double [both]"},
      {"--threads", "N", &o.threads, "Threads, 0 for all of the machine's"},
      {"--json", "FILE", &o.json, "Write the results to this file, - for standard output"},
      {"--junit", "FILE", &o.junit, "Write the results to this file as JUnit XML, - for standard output"},
      {"--report", "FOLDER", &o.report, "Write a page with maps and curves of every case to this folder (index.html)"},
      {"--plugin", "FILE", &o.plugin, "Check the samplers of this shared object, compiled against <mc/check/plugin.h>"},
      {"--params", "NAME=VALUE,...", &o.parameters,
       "Parameters of the plugin's samplers: \"alpha=0.1,n=3\", every one of a list \"alpha=0.1,0.2\" or of a range "
       "\"alpha=0.1:0.5:0.1\"; each --params is a case or more"},
      {"--command", "PROGRAM", &o.sampler_command,
       "Check the sampler of this program, which answers over pipes: \"python3 mine.py\", see below"},
      {"--uniforms", "N", &o.uniforms, "Numbers that one sample of --command takes [the dimensions of --domain]"},
      {"--timeout", "SECONDS", &o.timeout, "Time that a plugin or program may take per case [60]"},
      {"--memory", "GIB", &o.memory, "Memory that a plugin or program may take [4]"},
      {"--samples-file",
       "FILE",
       &o.samples_file,
       "Check these samples against a density, --pdf-file or --pdf; all of them count",
       false,
       {"--samples"}},
      {"--pdf-file", "FILE", &o.pdf_file, "Density on a grid: .csv, .exr or .pfm"},
      {"--pdf", "EXPRESSION", &o.pdf, "Density in the variables of --domain: \"exp(-x*x/2)/sqrt(2*_pi)\""},
      {"--domain", "DOMAIN", &o.domain,
       "Of the samples or of --command, see below [by the columns: 1 or 2 in 0:1, 3 sphere]"},
      {"--breaks", "AXIS=PLACES,...", &o.breaks,
       "Where the density of --pdf or --command jumps along the axes of the domain: \"x=0.25,0.5\", \"r=0.5\", "
       "\"theta=0:90:15\" in degrees; what is constant between is then exact"},
      {"--unnormalized", "", &o.unnormalized, "The density is given up to a factor"},
      {"--open-interval", "", &o.open_interval,
       "u lies in (0,1): accept samplers that break at single u, where one is exactly 0 or the density is 0 at one "
       "point, and samples on the very edge of the domain, whatever the density is there"},
  };
}

// What the user brought, to be checked instead of the catalogue.
struct Brought {
  Catalogue cases;
  std::uint64_t samples = 0; ///< of a file; 0: as many as are asked for
};

Brought bring(const ValidateOptions& o, const std::atomic<bool>* cancel) {
  mc::require(int(!o.plugin.empty()) + int(!o.samples_file.empty()) + int(!o.sampler_command.empty()) <= 1,
              "validate: give one of --plugin, --command and --samples-file");
  mc::require(o.sampler_command.empty() || !o.domain.empty(), "validate: --command needs the --domain it draws from");
  mc::require(o.domain.empty() || !o.samples_file.empty() || !o.sampler_command.empty(),
              "validate: --domain is that of a --command or a --samples-file");
  mc::require(!o.unnormalized || !o.pdf.empty() || !o.pdf_file.empty(),
              "validate: --unnormalized is of the density of a --samples-file, --pdf or --pdf-file");
  mc::require(o.uniforms >= 0 && (o.uniforms == 0 || !o.sampler_command.empty()),
              "validate: --uniforms {} is for a --command, and >= 1", o.uniforms);
  mc::require(o.parameters.empty() || !o.plugin.empty(), "validate: --params sets parameters of a --plugin");
  mc::require((o.pdf_file.empty() && o.pdf.empty()) || !o.samples_file.empty(),
              "validate: {} needs the samples to hold against it: --samples-file",
              o.pdf.empty() ? "--pdf-file" : "--pdf");
  mc::require(o.pdf_file.empty() || o.pdf.empty(), "validate: give --pdf-file or --pdf, not both");
  mc::require(o.breaks.empty() || !o.pdf.empty() || !o.sampler_command.empty(),
              "validate: --breaks is for a --pdf or a --command");
  Brought brought;
  const bool is_foreign = !o.plugin.empty() || !o.sampler_command.empty();
  const WorkerOptions worker{
      .limits = limits_of(o.timeout, o.memory, is_foreign), .program = o.worker, .cancel = cancel};
  if (!o.plugin.empty()) brought.cases = plugin_cases(o.plugin, o.parameters, o.names, worker);
  if (!o.sampler_command.empty())
    brought.cases.push_back(command_case({o.sampler_command, o.domain, o.breaks, o.uniforms}, worker));
  if (!o.samples_file.empty()) {
    const SamplesFileCase file =
        samples_file_case({o.samples_file, o.pdf_file, o.pdf, o.domain, o.breaks, o.unnormalized});
    brought.cases.push_back(file.one);
    brought.samples = file.samples;
  }
  return brought;
}

// Sets the samples, and refuses what cannot be done before the work begins.
void require_possible(ValidateOptions& o, double alpha, std::uint64_t available) {
  if (o.detect) {
    mc::require(*o.detect >= 1e-4 && *o.detect <= 1, "validate: --detect {} must lie in [0.0001, 1]", *o.detect);
    o.samples = mc::samples_to_detect(*o.detect, alpha);
    fmt::print("{} samples per case to detect {:g} %\n", o.samples, 100 * *o.detect);
  }
  mc::require(available == 0 || o.samples <= available,
              "{}: it holds {} samples to count beside those for the bins; --detect {} needs {}", o.samples_file,
              available, o.detect.value_or(0), o.samples);
  mc::require(o.samples >= 1000, "validate: --samples {}; at least 1000 are needed", o.samples);
}

// The cases that finished, with their reports.
struct Finished {
  std::vector<const Case*> cases;
  std::vector<mc::Report> reports;
  std::vector<Unchecked> unchecked;
};

mc::Report check(const Case& one, const ValidateOptions& o, double alpha, const std::atomic<bool>* cancel) {
  CaseOptions c;
  c.samples = o.samples;
  c.seed = seed_of(one, o);
  c.alpha = alpha;
  c.evidence = !o.report.empty();
  c.open_interval = o.open_interval;
  const std::function<void()> stop = [cancel] {
    if (*cancel) throw Interrupted();
  };
  c.before_draws = &stop;
  return mc::with_context(one.title(), [&] { return one.check(c); });
}

// Prints the line of each case as soon as those before it are printed.
Finished check_all(const std::vector<const Case*>& cases, const ValidateOptions& o, double alpha,
                   const std::atomic<bool>* cancel) {
  std::vector<std::optional<mc::Report>> reports(cases.size());
  std::vector<std::string> errors(cases.size());
  std::size_t printed = 0, finished = 0;
  std::mutex mutex;
  Progress progress;
  std::size_t width = 24;
  for (const Case* c : cases) width = std::max(width, plain(*c).size());
  fmt::print("{:<{}} {:<7} {:<12} {:>8} {:>9} {:>9} {:>7} {:>6}\n", "sampler", width, "scalar", "verdict", "p",
             "detects", "in a cell", "ns", "s");
  const auto print = [&](std::size_t i) {
    if (reports[i]) fmt::print("{}", line_of(width, *cases[i], *reports[i]));
    else fmt::print("{:<{}} {:<7} {}\n", plain(*cases[i]), width, cases[i]->scalar, "error");
  };
  const auto is_done = [&](std::size_t i) { return reports[i] || !errors[i].empty(); };
  mc::parallel_for(cases.size(), o.threads, [&](std::size_t i) {
    if (*cancel) return;
    mc::Report report;
    try {
      report = check(*cases[i], o, alpha, cancel);
    } catch (const Interrupted&) {
      return;
    } catch (const mc::Error& e) { // one crash is no reason to lose what the others show
      errors[i] = e.what();
    }
    const std::lock_guard lock(mutex);
    if (errors[i].empty()) reports[i] = std::move(report);
    ++finished;
    if (is_done(printed)) progress.clear();
    for (; printed < cases.size() && is_done(printed); ++printed) print(printed);
    std::fflush(stdout);
    progress.show(static_cast<double>(finished) / static_cast<double>(cases.size()),
                  fmt::format("{} of {} cases", finished, cases.size()));
  });
  progress.clear();
  Finished all;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!is_done(i)) continue;
    if (i >= printed) print(i);
    if (!reports[i]) {
      all.unchecked.push_back({cases[i], errors[i]});
      continue;
    }
    all.cases.push_back(cases[i]);
    all.reports.push_back(std::move(*reports[i]));
  }
  return all;
}

// What did not pass, then how many did.
void print_summary(const Run& run, std::size_t asked) {
  std::size_t passed = 0, inconclusive = 0;
  for (std::size_t i = 0; i < run.cases.size(); ++i) {
    const mc::Report& r = run.reports[i];
    passed += r.passed();
    inconclusive += r.verdict() == mc::Verdict::inconclusive;
    if (!r.passed())
      fmt::print("\n{}\n  again: {}\n", r.to_string(), command_again(*run.cases[i], run.settings, asked));
  }
  fmt::print("\n{} of {} cases passed{} at family-wise alpha {:g}; {} samples each, seed {}\n", passed,
             run.cases.size(), inconclusive > 0 ? fmt::format(", {} inconclusive", inconclusive) : std::string(),
             run.settings.alpha, run.settings.samples, run.settings.seed);
  if (!run.unchecked.empty()) fmt::print("{} of {} cases could not be checked\n", run.unchecked.size(), asked);
  if (run.interrupted) fmt::print("interrupted: {} of {} cases were finished\n", run.cases.size(), asked);
}

} // namespace

int validate(const ValidateOptions& options) {
  mc::require(options.names.empty() || options.names.front() != "book-slips",
              "validate: book-slips is a subcommand of its own: carlo slips [SLIP...]");
  ValidateOptions o = options;
  const Interrupt interrupt;
  const Brought brought = bring(o, interrupt.flag());
  if (brought.samples > 0) o.samples = brought.samples;
  const std::vector<const Case*> cases =
      select(o, brought.cases.empty() ? catalogue() : brought.cases, !brought.cases.empty());
  if (o.list) {
    mc::require(o.json.empty() && o.junit.empty(), "validate: --list checks nothing; leave out --json and --junit");
    for (const Case* c : cases) fmt::print("{:<44} {}\n", plain(*c), c->scalar);
    return exit_ok;
  }
  mc::require(o.alpha > 0 && o.alpha < 1, "validate: --alpha {} must lie in (0, 1)", o.alpha);
  const double alpha = mc::sidak_level(o.alpha, 1 / static_cast<double>(cases.size()));
  mc::require(o.json.empty() || o.json != o.junit, "--json and --junit would both write '{}'; name another file",
              o.json);
  const ResultFile json(o.json), junit(o.junit);
  require_possible(o, alpha, brought.samples);
  const std::string page = o.report.empty() ? "" : (mc::output_folder(o.report, "index.html") / "index.html").string();

  const Finished finished = check_all(cases, o, alpha, interrupt.flag());
  std::string errors;
  for (const Unchecked& u : finished.unchecked) errors += (errors.empty() ? "" : "\ncarlo: ") + u.error;
  mc::require(errors.empty() || !finished.cases.empty(), "{}", errors);
  const Run run{{o.command, o.seed, o.samples, o.alpha, !o.samples_file.empty(), o.open_interval},
                finished.cases,
                finished.reports,
                finished.cases.size() + finished.unchecked.size() < cases.size(),
                finished.unchecked};
  print_summary(run, cases.size());
  if (junit.is_wanted()) junit.write(run_junit(run));
  if (json.is_wanted()) json.write(run_json(run));
  if (!page.empty()) {
    write_page(page, run);
    fmt::print("page: {}\n", page);
  }
  mc::require(errors.empty(), "{}", errors);
  if (run.interrupted) return exit_interrupted;
  const bool passed = std::all_of(run.reports.begin(), run.reports.end(), [](const auto& r) { return r.passed(); });
  return passed ? exit_ok : exit_failed;
}

Subcommand validate_subcommand() {
  return make_subcommand<ValidateOptions>(
      "validate", "Check samplers against their laws: chi-square, KS, mass, Jacobian, inverse, oracle", rows, validate,
      file_formats);
}

} // namespace carlo

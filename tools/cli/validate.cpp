// carlo validate: every sampler against its laws.
#include <catalogue/catalogue.h>
#include <cli/commands.h>
#include <input/samples_file.h>
#include <plugin/plugin.h>
#include <report/validate_output.h>
#include <terminal/progress.h>

#include <mc/check/check_subject.h>
#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/parallel.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>
#include <mc/stats/multiple_testing.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
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
    if (!brought) names.insert("book-slips");
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

// Every case draws its own numbers, the same ones whichever cases run beside it.
std::uint64_t seed_of(const Case& c, std::uint64_t seed) {
  for (const char letter : c.title())
    seed = mc::hash(seed, static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
  return seed;
}

// The page's file in that folder, which is created where it is missing.
std::string page_in(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  mc::require(!error && std::filesystem::is_directory(folder),
              "validate: --report '{}' is no folder and cannot be made one{}; name another", folder,
              error ? fmt::format(" ({})", error.message()) : std::string());
  const std::string file = (std::filesystem::path(folder) / "index.html").string();
  mc::require_writable(file);
  return file;
}

std::string error_text(double e) { return e > 0 ? fmt::format("{:.2g} %", 100 * e) : std::string("-"); }

std::string line_of(std::size_t width, const Case& c, const mc::Report& r) {
  const std::string ns = r.ns_per_sample > 0 ? fmt::format("{:.1f}", r.ns_per_sample) : "-";
  return fmt::format("{:<{}} {:<7} {:<12} {:>8.2g} {:>9} {:>9} {:>7} {:>6.2f}\n", plain(c), width, c.scalar,
                     name(r.verdict()), r.p(), error_text(r.detectable), error_text(r.detectable_cell), ns, r.seconds);
}

} // namespace

int validate(const ValidateOptions& options) {
  if (!options.names.empty() && options.names.front() == "book-slips") return book_slips(options);
  ValidateOptions o = options;
  mc::require(o.plugin.empty() || o.samples_file.empty(), "validate: give --plugin or --samples-file, not both");
  mc::require(o.parameters.empty() || !o.plugin.empty(), "validate: --params sets parameters of a --plugin");
  mc::require(o.pdf_file.empty() || !o.samples_file.empty(),
              "validate: --pdf-file needs the samples to hold against it: --samples-file");
  Catalogue brought;
  if (!o.plugin.empty()) brought = plugin_cases(o.plugin, o.parameters, o.timeout);
  std::uint64_t available = 0; // samples of a file
  if (!o.samples_file.empty()) {
    const SamplesFileCase file = samples_file_case({o.samples_file, o.pdf_file, o.domain, o.unnormalized});
    brought.push_back(file.one);
    o.samples = available = file.samples;
  }
  const std::vector<const Case*> cases = select(o, brought.empty() ? catalogue() : brought, !brought.empty());
  if (o.list) {
    for (const Case* c : cases) fmt::print("{:<44} {}\n", plain(*c), c->scalar);
    return exit_ok;
  }
  mc::require(o.alpha > 0 && o.alpha < 1, "validate: --alpha {} must lie in (0, 1)", o.alpha);
  const double alpha = mc::sidak_level(o.alpha, 1 / static_cast<double>(cases.size()));
  if (o.detect) {
    mc::require(*o.detect >= 1e-4 && *o.detect <= 1, "validate: --detect {} must lie in [0.0001, 1]", *o.detect);
    o.samples = mc::samples_to_detect(*o.detect, alpha);
    fmt::print("{} samples per case to detect {:g} %\n", o.samples, 100 * *o.detect);
  }
  mc::require(available == 0 || o.samples <= available,
              "{}: it holds {} samples to count beside those for the bins; --detect {} needs {}", o.samples_file,
              available, o.detect.value_or(0), o.samples);
  mc::require(o.samples >= 1000, "validate: --samples {}; at least 1000 are needed", o.samples);
  // An unwritable place is refused before the work, not after it.
  for (const std::string& file : {o.json, o.junit})
    if (!file.empty()) mc::require_writable(file);
  const std::string page = o.report.empty() ? "" : page_in(o.report);

  std::vector<mc::Report> reports(cases.size());
  std::vector<char> done(cases.size(), 0);
  std::size_t printed = 0, finished = 0;
  std::mutex mutex;
  Progress progress;
  std::size_t width = 24;
  for (const Case* c : cases) width = std::max(width, plain(*c).size());
  fmt::print("{:<{}} {:<7} {:<12} {:>8} {:>9} {:>9} {:>7} {:>6}\n", "sampler", width, "scalar", "verdict", "p",
             "detects", "in a cell", "ns", "s");
  mc::parallel_for(cases.size(), o.threads, [&](std::size_t i) {
    CaseOptions c;
    c.samples = o.samples;
    c.seed = seed_of(*cases[i], o.seed);
    c.alpha = alpha;
    c.evidence = !page.empty();
    c.open_interval = o.open_interval;
    mc::Report report = mc::with_context(cases[i]->title(), [&] { return cases[i]->check(c); });
    const std::lock_guard lock(mutex);
    reports[i] = std::move(report);
    done[i] = 1;
    ++finished;
    if (printed < cases.size() && done[printed]) progress.clear();
    for (; printed < cases.size() && done[printed]; ++printed)
      fmt::print("{}", line_of(width, *cases[printed], reports[printed]));
    std::fflush(stdout);
    progress.show(static_cast<double>(finished) / static_cast<double>(cases.size()),
                  fmt::format("{} of {} cases", finished, cases.size()));
  });
  progress.clear();

  std::size_t passed = 0, inconclusive = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    passed += reports[i].passed();
    inconclusive += reports[i].verdict() == mc::Verdict::inconclusive;
  }
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (!reports[i].passed())
      fmt::print("\n{}\n  again: {}\n", reports[i].to_string(), command_again(*cases[i], o, cases.size()));
  fmt::print("\n{} of {} cases passed{} at family-wise alpha {:g}; {} samples each, seed {}\n", passed, cases.size(),
             inconclusive > 0 ? fmt::format(", {} inconclusive", inconclusive) : std::string(), o.alpha, o.samples,
             o.seed);
  const Run run{o, cases, reports};
  if (!o.junit.empty()) write_junit(o.junit, run);
  if (!o.json.empty()) write_json(o.json, run);
  if (!page.empty()) {
    write_page(page, run);
    fmt::print("page: {}\n", page);
  }
  return passed == cases.size() ? exit_ok : exit_failed;
}

} // namespace carlo

#include <catalogue/catalogue.h>
#include <catalogue/descriptions.h>
#include <catalogue/looks.h>
#include <cli/validate.h>
#include <cli/validate_input.h>
#include <options/run_session.h>
#include <report/validate_output.h>
#include <terminal/columns.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>
#include <terminal/result_file.h>

#include <mc/check/check_subject.h>
#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>
#include <mc/core/parallel.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>
#include <mc/run/job.h>
#include <mc/stats/multiple_testing.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

namespace carlo {
namespace {

// A label or title with the former names of its distribution, or the same text. Former names are still accepted, and
// the seeds of the cases follow from them, so that a seed gives the same random numbers as before the renaming.
std::string former_name(std::string text) {
  constexpr std::pair<std::string_view, std::string_view> renamed[] = {
      {"FuzzyMetal", "Metal"}, {"LightSampler", "LightChoice"}, {"TrowbridgeReitzFacets", "Microfacets"}};
  for (const auto& [name, former] : renamed)
    if (const std::size_t at = text.find(name); at != std::string::npos) text.replace(at, name.size(), former);
  return text;
}

// The cases that the names select: all cases of a distribution, or one case as --list prints it. Without a name, all
// cases of the user's file.
std::vector<const Case*> select(const ValidateCommandOptions& o, const Catalogue& catalogue, bool is_user_input) {
  mc::require(o.scalar.empty() || o.scalar == "float" || o.scalar == "double",
              "validate: --scalar '{}' must be float or double", o.scalar);
  std::vector<const Case*> chosen;
  const auto wanted = [&](const Case& c) { return o.scalar.empty() || c.scalar == o.scalar; };
  if (o.all || ((o.list || is_user_input) && o.names.empty())) {
    for (const Case& c : catalogue)
      if (wanted(c)) chosen.push_back(&c);
  }
  for (const std::string& name : o.names) {
    bool known = false;
    for (const Case& c : catalogue) {
      if (name != c.name && name != c.label() && name != former_name(c.name) && name != former_name(c.label()))
        continue;
      known = true;
      if (wanted(c)) chosen.push_back(&c);
    }
    if (known) continue;
    std::set<std::string> names;
    for (const Case& c : catalogue) names.insert(c.name);
    throw mc::Error(fmt::format("validate: unknown distribution '{}'{} ({})", name, mc::did_you_mean(name, names),
                                is_user_input ? "--list shows the distributions of your file"
                                              : "carlo validate --list names them all"));
  }
  std::vector<const Case*> unique;
  for (const Case* c : chosen)
    if (std::find(unique.begin(), unique.end(), c) == unique.end()) unique.push_back(c);
  mc::require(o.list || !unique.empty(), "validate: {}",
              o.names.empty() ? "name a distribution, or give --all or --list" : "no case has this --scalar");
  return unique;
}

// The seed of a case. It depends neither on the other cases of the run nor on the folder of a file.
std::uint64_t seed_of(const Case& c, const ValidateCommandOptions& o) {
  std::string title = former_name(c.title());
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

// p belongs to statistical tests: a broken law is certain.
std::string p_text(const mc::Report& r) {
  if (!r.is_statistical()) return "-";
  return r.p() < 1e-300 ? "<1e-300" : fmt::format("{:.2g}", r.p());
}

std::string line_of(std::size_t width, const Case& c, const mc::Report& r) {
  const std::string ns = r.ns_per_sample > 0 ? fmt::format("{:.1f}", r.ns_per_sample) : "-";
  return fmt::format("{:<{}} {:<7} {:<12} {:>8} {:>9} {:>9} {:>9} {:>7.2f}\n", c.label(), width, c.scalar,
                     name(r.verdict()), p_text(r), error_text(r.detectable), error_text(r.detectable_cell), ns,
                     r.seconds);
}

constexpr std::uint64_t most_samples = 1'000'000'000'000'000; // counts in doubles stay exact

// The time of so many samples at a million a second, "12 s" or "2.8 h".
std::string duration_text(double samples) {
  const double seconds = samples / 1e6;
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  return seconds < 7200 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

// Determines the number of samples. Throws Error before any work where it is impossible.
void resolve_sample_count(ValidateCommandOptions& o, double alpha, std::uint64_t available) {
  if (o.detect) {
    mc::require(*o.detect >= 1e-4 && *o.detect <= 1, "validate: --detect {} must lie in [0.0001, 1]", *o.detect);
    o.samples = mc::samples_to_detect(*o.detect, alpha);
    fmt::print("{} samples per case to detect {:g} %: about {} a case at a million samples a second\n", o.samples,
               100 * *o.detect, duration_text(static_cast<double>(o.samples)));
    std::fflush(stdout);
  }
  mc::require(available == 0 || o.samples <= available,
              "{}: {} samples can be counted, the others choose the bins; --detect {} needs {}", o.samples_file,
              available, o.detect.value_or(0), o.samples);
  mc::require(o.samples >= 1000 && o.samples <= most_samples, "validate: --samples {} must lie in [1000, {:g}]",
              o.samples, double(most_samples));
}

// The cases that finished, with their reports.
struct CheckedCases {
  std::vector<const Case*> cases;
  std::vector<mc::Report> reports;
  std::vector<UncheckedCase> unchecked;
  std::size_t incomplete = 0; ///< number of cases at the end of `cases` with the reports of fewer samples
};

// Checks a case; calls before_draws with the number of samples that are drawn next.
LookReport check(const Case& one, const ValidateCommandOptions& o, double alpha,
                 const std::function<void(std::uint64_t)>& before_draws) {
  CaseOptions c;
  c.samples = o.samples;
  c.seed = seed_of(one, o);
  c.alpha = alpha;
  c.evidence = !o.report.empty();
  c.open_interval = o.open_interval;
  c.before_draws = &before_draws;
  return mc::with_context(one.title(), [&]() -> LookReport {
    if (!o.samples_file.empty()) return {one.check(c)}; // a look would need rows of its own
    return check_in_looks(one.check, c);
  });
}

/// Checks all cases: each is a unit. Prints their lines in order, each as soon as possible.
class ValidateJob {
 public:
  /// The report of a case, or the error of a case that could not be checked.
  struct Result {
    mc::Report report;
    std::string error;
    template <class Archive> void archive(Archive& a) { a(report, error); }
  };

  ValidateJob(const std::vector<const Case*>& cases, const ValidateCommandOptions& o, double alpha,
              const std::atomic<bool>* cancel)
      : cases_(cases), options_(o), alpha_(alpha), cancel_(cancel) {
    for (const Case* c : cases) width_ = std::max(width_, c->label().size());
    fmt::print("{:<{}} {:<7} {:<12} {:>8} {:>9} {:>9} {:>9} {:>7}\n", "distribution", width_, "scalar", "verdict", "p",
               "detects", "in a cell", "ns/sample", "seconds");
  }

  std::size_t next_stage() { return std::exchange(has_begun_, true) ? 0 : cases_.size(); }
  std::optional<Result> compute(std::size_t i) const {
    Result result;
    try {
      LookReport checked = check(*cases_[i], options_, alpha_, [this](std::uint64_t draws) { count_draws(draws); });
      if (!checked.is_complete) return keep(i, std::move(checked.report));
      result.report = std::move(checked.report);
    } catch (const Interrupted&) {
      return {};
    } catch (const mc::Error& e) { // a crash of one case leaves the results of the others
      result.error = e.what();
    }
    return result;
  }
  void absorb(std::size_t i, Result result) {
    results_.emplace(i, std::move(result));
    print_lines();
    show_progress(results_.size());
  }
  void skip(std::size_t) {}
  bool needs_results() const { return false; }
  template <class Archive> void archive(Archive& a) { a(has_begun_, results_); }
  template <class Archive> void archive_stage(Archive&) {}

  // Prints the lines that were not printed yet.
  void print_lines() {
    const std::lock_guard lock(mutex_);
    progress_.clear();
    for (auto one = results_.lower_bound(printed_); one != results_.end(); ++one) {
      const auto& [i, result] = *one;
      if (result.error.empty()) fmt::print("{}", line_of(width_, *cases_[i], result.report));
      else fmt::print("{:<{}} {:<7} {}\n", cases_[i]->label(), width_, cases_[i]->scalar, "error");
      printed_ = i + 1;
    }
    std::fflush(stdout);
  }

  CheckedCases checked() const {
    CheckedCases all;
    for (const auto& [i, result] : results_) {
      if (!result.error.empty()) {
        all.unchecked.push_back({cases_[i], result.error});
        continue;
      }
      all.cases.push_back(cases_[i]);
      all.reports.push_back(result.report);
    }
    for (const auto& [i, report] : incomplete_) {
      all.cases.push_back(cases_[i]);
      all.reports.push_back(report);
    }
    all.incomplete = incomplete_.size();
    return all;
  }

 private:
  // Keeps the report of an interrupted case for the output. The case is not done: a run that goes on checks it again.
  std::optional<Result> keep(std::size_t i, mc::Report report) const {
    const std::lock_guard lock(mutex_);
    incomplete_.emplace(i, std::move(report));
    return {};
  }
  // Counts samples that are drawn next. Any thread calls it.
  void count_draws(std::uint64_t draws) const {
    if (*cancel_) throw Interrupted();
    drawn_ += draws;
    show_progress(finished_);
  }
  void show_progress(std::size_t finished) const {
    const std::lock_guard lock(mutex_);
    finished_ = finished;
    const double cases = static_cast<double>(cases_.size()), samples = static_cast<double>(options_.samples);
    const double drawn = static_cast<double>(drawn_) / (cases * samples * (1 + 1.0 / 8)); // with the pilot
    progress_.show(
        std::clamp(drawn, static_cast<double>(finished) / cases, 1.0),
        fmt::format("{} of {} cases  {} samples", finished, cases_.size(), format_count(static_cast<double>(drawn_))));
  }

  const std::vector<const Case*>& cases_;
  const ValidateCommandOptions& options_;
  double alpha_;
  const std::atomic<bool>* cancel_;
  bool has_begun_ = false;
  std::map<std::size_t, Result> results_; ///< by the number of the case
  std::size_t width_ = 24, printed_ = 0;
  mutable std::mutex mutex_;                             ///< of the progress and of incomplete_
  mutable std::map<std::size_t, mc::Report> incomplete_; ///< last looks of interrupted cases, by their numbers
  mutable std::atomic<std::uint64_t> drawn_ = 0;
  mutable std::atomic<std::size_t> finished_ = 0;
  mutable ProgressLine progress_;
};

CheckedCases check_all(const std::vector<const Case*>& cases, const ValidateCommandOptions& o, double alpha,
                       const std::atomic<bool>* cancel, const RunSession& session) {
  ValidateJob job(cases, o, alpha, cancel);
  const bool is_done = mc::run_job(job, {o.threads, cancel, session.checkpoint(), session.executor(), "validate"});
  job.print_lines();
  if (!is_done) print_how_to_resume(o.checkpoint);
  return job.checked();
}

// Throws Error where the cases that are checked at a time need more memory than is allowed.
void require_memory(std::size_t cases, const ValidateCommandOptions& o) {
  const int threads = o.threads > 0 ? o.threads : mc::hardware_threads();
  const std::size_t together = std::min(cases, static_cast<std::size_t>(threads));
  mc::require_memory(double(together) * mc::check_memory(o.samples),
                     fmt::format("validate: {} cases at a time", together), "fewer --threads need less");
}

// The options on which the reports depend, and the cases.
mc::RunIdentity identity_of(ValidateCommandOptions o, const std::vector<const Case*>& cases) {
  mc::RunIdentity identity =
      run_identity(validate_rows(o), {"NAME", "--all", "--list", "--verbose", "--threads", "--resume", "--every",
                                      "--report", "--timeout", "--memory", "--output"});
  o.seed = 0;
  std::uint64_t hash = cases.size();
  for (const Case* c : cases) hash = mc::hash(hash, seed_of(*c, o));
  identity.emplace_back("the cases", fmt::format("{} with the hash {:016x}", cases.size(), hash));
  identity.emplace_back("--report", o.report.empty() ? "not wanted" : "wanted");
  return identity;
}

// The reports of cases that did not pass, then the number of cases that passed.
void print_summary(const ValidationRun& run, std::size_t asked, std::size_t incomplete, bool verbose) {
  constexpr std::string_view hint = "; --verbose shows them";
  std::size_t passed = 0, inconclusive = 0, warned = 0;
  for (std::size_t i = 0; i < run.cases.size(); ++i) {
    const mc::Report& r = run.reports[i];
    passed += r.passed() && i + incomplete < run.cases.size();
    inconclusive += r.verdict() == mc::Verdict::inconclusive;
    warned += r.passed() && r.warning();
    if (r.passed() && r.warning()) fmt::print("\n{}\n", r.to_string());
    if (!r.passed())
      fmt::print("\n{}\n  again: {}\n", r.to_string(verbose ? mc::ReportText::full : mc::ReportText::brief, hint),
                 repeat_command(*run.cases[i], run.settings, asked));
  }
  fmt::print("\n{} of {} cases passed{}{} at family-wise alpha {:g}; {} samples each, seed {}\n", passed,
             run.cases.size(), warned > 0 ? fmt::format(", {} with a warning", warned) : std::string(),
             inconclusive > 0 ? fmt::format(", {} inconclusive", inconclusive) : std::string(), run.settings.alpha,
             run.settings.samples, run.settings.seed);
  if (!run.unchecked.empty()) fmt::print("{} of {} cases could not be checked\n", run.unchecked.size(), asked);
  if (run.interrupted) fmt::print("interrupted: {} of {} cases were finished\n", run.cases.size() - incomplete, asked);
}

// Files of the results, checked before the work.
struct ResultFiles {
  ResultFile json, junit;
  std::string page;

  explicit ResultFiles(const ValidateCommandOptions& o)
      : json(o.json), junit(o.junit),
        page(o.report.empty() ? "" : (mc::make_output_folder(o.report, "index.html") / "index.html").string()) {}
};

// Prints and writes the reports. Returns the exit code.
int report(const ValidateCommandOptions& o, const std::vector<const Case*>& cases, const CheckedCases& finished,
           const ResultFiles& files) {
  std::string errors;
  for (const UncheckedCase& u : finished.unchecked) errors += (errors.empty() ? "" : "\n") + u.error;
  mc::require(errors.empty() || !finished.cases.empty(), "{}", errors);
  const ValidationRun run{{o.command, o.seed, o.samples, o.alpha, !o.samples_file.empty(), o.open_interval},
                          finished.cases,
                          finished.reports,
                          finished.cases.size() - finished.incomplete + finished.unchecked.size() < cases.size(),
                          finished.unchecked};
  print_summary(run, cases.size(), finished.incomplete, o.verbose);
  for (std::size_t i = finished.cases.size() - finished.incomplete; i < finished.cases.size(); ++i)
    fmt::print("{}: {} after {} of {} samples\n", finished.cases[i]->title(), name(finished.reports[i].verdict()),
               finished.reports[i].samples, o.samples);
  ResultWriter results;
  if (files.junit.is_wanted()) files.junit.write(results, run.interrupted, validation_junit(run));
  if (files.json.is_wanted()) files.json.write(results, run.interrupted, validation_json(run));
  if (!files.page.empty()) fmt::print("page: {}\n", results.write(files.page, run.interrupted, validation_page(run)));
  results.finish();
  mc::require(errors.empty(), "{}", errors);
  if (run.interrupted) return exit_interrupted;
  const bool passed = std::all_of(run.reports.begin(), run.reports.end(), [](const auto& r) { return r.passed(); });
  return passed ? exit_ok : exit_failed;
}

} // namespace

int run_validate(const ValidateCommandOptions& options) {
  mc::require(options.names.empty() || options.names.front() != "book-slips",
              "validate: book-slips is a subcommand of its own: carlo known-bugs [BUG...]");
  ValidateCommandOptions o = options;
  const Interrupt interrupt;
  UserInput user_input;
  try {
    user_input = read_user_input(o, interrupt.flag());
  } catch (const Interrupted&) {
    fmt::print(stderr, "interrupted before anything was checked\n");
    return exit_interrupted;
  }
  if (user_input.samples > 0) o.samples = user_input.samples;
  const std::vector<const Case*> cases =
      select(o, user_input.cases.empty() ? catalogue() : user_input.cases, !user_input.cases.empty());
  if (o.list) {
    mc::require(o.json.empty() && o.junit.empty(), "validate: --list checks nothing; leave out --json and --junit");
    const bool is_overview = o.names.empty() && user_input.cases.empty();
    fmt::print("{}", (is_overview ? distributions_text : cases_text)(cases, terminal_columns(STDOUT_FILENO)));
    return exit_ok;
  }
  mc::require(o.alpha > 0 && o.alpha < 1, "validate: --alpha {} must lie in (0, 1)", o.alpha);
  const double alpha = mc::sidak_level(o.alpha, 1 / static_cast<double>(cases.size()));
  const ResultFiles files(o);
  resolve_sample_count(o, alpha, user_input.samples);
  require_memory(cases.size(), o);
  RunSession session(o.checkpoint, identity_of(o, cases), o.output, o.command);
  return session.run([&] {
    const CheckedCases finished = check_all(cases, o, alpha, interrupt.flag(), session);
    session.before_results();
    return report(o, cases, finished, files);
  });
}

Subcommand validate_subcommand() {
  return make_subcommand<ValidateCommandOptions>(validate_about(), validate_rows, run_validate);
}

} // namespace carlo

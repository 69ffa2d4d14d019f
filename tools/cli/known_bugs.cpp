#include <cli/known_bugs.h>
#include <known_bugs/cornell.h>
#include <known_bugs/known_bugs.h>
#include <plugin/worker.h>
#include <report/report_json.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>
#include <terminal/result_file.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/parallel.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <functional>
#include <mutex>

namespace carlo {
namespace {

using nlohmann::json;

KnownBugs select(const std::vector<std::string>& names) {
  KnownBugs all = book_bugs(), chosen;
  if (names.empty()) return all;
  for (const std::string& name : names) {
    const auto found = std::find_if(
        all.begin(), all.end(), [&](const KnownBug& s) { return name == s.id || name == s.name || name == s.title(); });
    if (found == all.end()) {
      std::vector<std::string> known;
      for (const KnownBug& s : all) known.insert(known.end(), {s.id, s.name});
      throw mc::Error(fmt::format("known-bugs: unknown bug '{}'{} (carlo known-bugs --list names them all)", name,
                                  mc::did_you_mean(name, known)));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

struct DetectionResult {
  mc::Report wrong, right;
  std::string test;          ///< the check that rejected the bug
  std::uint64_t samples = 0; ///< that the check needed
  bool caught = false;
};

// A density with jumps takes all evaluations, even for few samples.
constexpr std::size_t max_evaluations = 2'000'000;

// Doubles the samples until the bug is rejected. All sample sizes together reject a correct distribution with
// probability alpha.
//   throws : Interrupted.
DetectionResult detect(const KnownBug& slip, const KnownBugsCommandOptions& o, const std::atomic<bool>* cancel) {
  const std::function<void(std::uint64_t)> stop = [cancel](std::uint64_t) {
    if (*cancel) throw Interrupted();
  };
  std::uint64_t seed = o.seed; // the same numbers for any selection of bugs
  for (const char letter : slip.id)
    seed = mc::hash(seed, static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
  double looks = 1;
  for (std::uint64_t n = slip.wrong.min_samples; n < o.samples; n *= 2) looks += 1;
  const double alpha = mc::sidak_level(o.alpha, 1 / looks);
  DetectionResult t;
  for (std::uint64_t n = slip.wrong.min_samples;; n = std::min(2 * n, o.samples)) {
    t.wrong = slip.wrong.check(
        {.samples = n, .seed = seed, .alpha = alpha, .max_evaluations = max_evaluations, .before_draws = &stop});
    t.samples = n;
    t.caught = t.wrong.verdict() == mc::Verdict::fail;
    if (t.caught || n >= o.samples) break;
  }
  const std::uint64_t enough = std::min(o.samples, std::max(o.samples / 16, 4 * t.samples)); // for the correction
  // The deterministic law that failed, else the test with the smallest p.
  const mc::Check* by = nullptr;
  const auto sureness = [](const mc::Check& c) { return c.p ? mc::sidak_share(*c.p, c.share) : -1.0; };
  for (const mc::Check& c : t.wrong.checks)
    if (c.verdict == mc::Verdict::fail && (!by || sureness(c) < sureness(*by))) by = &c;
  if (by) {
    t.test = by->name;
    const bool deterministic = !by->p;
    if (deterministic && (by->fault == mc::Fault::mass || by->fault == mc::Fault::inverse)) t.samples = 0;
    else if (deterministic)
      if (const std::uint64_t bad = slip.wrong.first_failure(seed, t.samples)) t.samples = bad;
  }
  t.right = slip.right.check({.samples = std::max(slip.right.min_samples, enough),
                              .seed = seed,
                              .alpha = alpha,
                              .max_evaluations = max_evaluations,
                              .before_draws = &stop});
  return t;
}

// As judge(); errors name the bug.
DetectionResult detect_named(const KnownBug& slip, const KnownBugsCommandOptions& o, const std::atomic<bool>* cancel) {
  return mc::with_context(slip.title(), [&] { return detect(slip, o, cancel); });
}

std::string samples_text(const KnownBug& s, const DetectionResult& t) {
  if (!t.caught) return "missed";
  if (t.samples == 0) return "none";
  return fmt::format("{}{}", t.samples == s.wrong.min_samples ? "<= " : "", t.samples);
}

json to_json(const KnownBug& s, const DetectionResult& t) {
  return {{"id", s.id},
          {"name", s.name},
          {"where", s.source},
          {"story", s.description},
          {"caught", t.caught},
          {"test", t.test},
          {"samples", t.caught ? json(t.samples) : json()},
          {"fault", name(t.wrong.fault())},
          {"report", t.wrong.to_string(mc::ReportText::full)},
          {"right", {{"verdict", name(t.right.verdict())}, {"p", t.right.p()}, {"samples", t.right.samples}}}};
}

// Returns the results that were finished before `cancel`. Prints them in order, each as soon as possible.
std::vector<std::optional<DetectionResult>> detect_all(const KnownBugs& bugs, const KnownBugsCommandOptions& o,
                                                       const std::atomic<bool>* cancel) {
  fmt::print("book     Ray Tracing: The Rest of Your Life, 2016\n"
             "course   Introduction to Real-Time Ray Tracing, SIGGRAPH 2019\n"
             "lecture  CMU 15-468, 2021, with smallpt\n"
             "lajolla  its design notes, UCSD CSE 272\n\n"
             "{:<4} {:<34} {:<29} {:<27} {:>8}  {}\n",
             "bug", "", "where", "caught by", "samples", "corrected");
  std::vector<std::optional<DetectionResult>> results(bugs.size());
  std::size_t printed = 0, finished = 0;
  std::mutex mutex;
  ProgressLine progress;
  const auto print = [&](std::size_t i) {
    const KnownBug& s = bugs[i];
    const DetectionResult& r = *results[i];
    fmt::print("{:<4} {:<34} {:<29} {:<27} {:>8}  {}, p = {:.2g}\n", s.id, s.name, s.source, r.test, samples_text(s, r),
               name(r.right.verdict()), r.right.p());
  };
  mc::parallel_for(bugs.size(), o.threads, [&](std::size_t i) {
    if (*cancel) return;
    DetectionResult one;
    try {
      one = detect_named(bugs[i], o, cancel);
    } catch (const Interrupted&) {
      return;
    }
    const std::lock_guard lock(mutex);
    results[i] = std::move(one);
    ++finished;
    if (printed < bugs.size() && results[printed]) progress.clear();
    for (; printed < bugs.size() && results[printed]; ++printed) print(printed);
    std::fflush(stdout);
    progress.show(static_cast<double>(finished) / static_cast<double>(bugs.size()),
                  fmt::format("{} of {} bugs", finished, bugs.size()));
  });
  progress.clear();
  for (std::size_t i = printed; i < bugs.size(); ++i)
    if (results[i]) print(i);
  return results;
}

void print_stories(const KnownBugs& bugs, const std::vector<std::optional<DetectionResult>>& results) {
  for (std::size_t i = 0; i < bugs.size(); ++i) {
    if (!results[i]) continue;
    fmt::print("\n{}, {}\n  {}\n  wrong: {}\n", bugs[i].title(), bugs[i].source, bugs[i].description,
               results[i]->wrong.to_string());
    if (!results[i]->right.passed()) fmt::print("  corrected: {}\n", results[i]->right.to_string());
  }
}

// Prints the boxes and appends them to `all`. Returns whether each agrees with the reference as the books claim.
// Returns true when interrupted.
bool check_cornell_boxes(const KnownBugsCommandOptions& o, json& all, const std::atomic<bool>* cancel) {
  constexpr std::uint64_t least_paths = 62'500; // that reject the wrong boxes
  const std::uint64_t paths = std::max(o.samples / 16, least_paths);
  fmt::print("\nWhich Cornell box was right? Mean radiance of the picture, at least {} paths each.\n", paths);
  const std::vector<CornellBox> boxes = cornell_boxes(paths, o.seed, o.threads, cancel);
  if (boxes.empty()) return true;
  const double level = mc::sidak_level(o.alpha, 1 / static_cast<double>(boxes.size() - 1));
  bool as_claimed = true;
  for (const CornellBox& b : boxes) {
    const bool agrees = b.p > level;
    as_claimed = as_claimed && agrees == b.claimed_right;
    const std::string off = &b == &boxes.front() ? fmt::format("{:.4f}", b.mean)
                                                 : fmt::format("{:+.1f} % +- {:.1f}", 100 * b.off, 100 * b.off_error);
    fmt::print("  {:<34} {:<12} {:<16} {}  {}\n", b.name, b.source, off, agrees ? "right" : "wrong", b.description);
    all.push_back({{"name", b.name},
                   {"where", b.source},
                   {"story", b.description},
                   {"mean", b.mean},
                   {"std_error", b.std_error},
                   {"off", b.off},
                   {"off_error", b.off_error},
                   {"p", b.p},
                   {"agrees", agrees}});
  }
  return as_claimed;
}

std::vector<Option> rows(KnownBugsCommandOptions& o) {
  return in_groups({
      {common_options,
       {
           {"BUG", "", &o.names, "Bugs by id or name, with their explanations. Default: all, and the Cornell boxes."},
           {"--list", "", &o.list, "List the bugs, and stop."},
           output_file({"--json", "FILE", &o.json, "Write the results to this file; - is standard output."}),
       }},
      {expert_options,
       {
           {"--samples", "N", &o.samples, "Most samples per bug, 8000 to 1e9."},
           {"--alpha", "PROBABILITY", &o.alpha,
            "Probability of rejecting a correct distribution, over all sample sizes tried for one bug."},
           {"--seed", "N", &o.seed, "Seed of the random numbers. The same seed gives the same verdicts."},
           {"--threads", "N", &o.threads, "Threads; 0 is all processors."},
       }},
  });
}

} // namespace

int run_known_bugs(const KnownBugsCommandOptions& o) {
  const KnownBugs bugs = select(o.names);
  if (o.list) {
    for (const KnownBug& s : bugs) fmt::print("{:<4} {:<34} {}\n", s.id, s.name, s.source);
    return exit_ok;
  }
  mc::require(o.alpha > 0 && o.alpha < 1, "known-bugs: --alpha {} must lie in (0, 1)", o.alpha);
  mc::require(o.samples >= 8000 && o.samples <= 1'000'000'000, "known-bugs: --samples {} must lie in [8000, 1e9]",
              o.samples);
  const ResultFile file(o.json);

  const Interrupt interrupt;
  const std::vector<std::optional<DetectionResult>> results = detect_all(bugs, o, interrupt.flag());
  json all = {{"command", o.command}, {"commit", commit},       {"seed", o.seed},
              {"alpha", o.alpha},     {"slips", json::array()}, {"boxes", json::array()}};
  std::size_t finished = 0, caught = 0, right = 0;
  for (std::size_t i = 0; i < bugs.size(); ++i) {
    if (!results[i]) continue;
    ++finished;
    caught += results[i]->caught;
    right += results[i]->right.passed();
    all["slips"].push_back(to_json(bugs[i], *results[i]));
  }
  bool boxes_as_claimed = true;
  if (!o.names.empty()) print_stories(bugs, results);
  else if (!*interrupt.flag()) boxes_as_claimed = check_cornell_boxes(o, all["boxes"], interrupt.flag());
  const bool interrupted = *interrupt.flag();
  fmt::print("\n{} of {} bugs rejected, {} of {} corrections passed, at alpha {:g} for each, seed {}\n", caught,
             finished, right, finished, o.alpha, o.seed);
  if (interrupted) fmt::print("interrupted: {} of {} bugs were finished\n", finished, bugs.size());
  const bool passed = caught == bugs.size() && right == bugs.size() && boxes_as_claimed && !interrupted;
  all["passed"] = passed;
  if (interrupted) all["interrupted"] = true;
  ResultWriter writer;
  if (file.is_wanted()) file.write(writer, interrupted, json_text(all));
  writer.finish();
  if (interrupted) return exit_interrupted;
  return passed ? exit_ok : exit_failed;
}

Subcommand known_bugs_subcommand() {
  return make_subcommand<KnownBugsCommandOptions>(
      {.name = "known-bugs",
       .summary = "Run the checker on sampling bugs that books, courses and renderers have printed",
       .examples = {{"carlo known-bugs", "checks all bugs, and their corrections"},
                    {"carlo known-bugs P9", "explains one bug, and the test that finds it"},
                    {"carlo known-bugs --list", "names the bugs and their sources"}},
       .failure = "a bug was missed, or a correction failed",
       .aliases = {"slips"}},
      rows, run_known_bugs);
}

} // namespace carlo

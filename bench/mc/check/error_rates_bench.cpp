// Measures how often the checker rejects random correct subjects, and how often it misses random faults, by kind and
// size.
// Usage: bench_mc_check_error_rates right|narrow|rounded|faults|promise|foreign [CASES [FIRST_SEED [SAMPLES [NAME]]]]
//   right   : random correct subjects of random_subjects.h.
//   narrow  : random correct subjects with narrow features.
//   rounded : random correct subjects that rounding makes difficult. A lobe narrower than its steps is inconclusive.
//   faults  : random faults of random_faults.h in correct subjects, with sizes around the detectable size.
//   promise : random faults of the size that the report of the correct subject calls detectable.
//   foreign : CASES seeds of each subject of regression_subjects.h.
//   NAME    : selects subjects with names that contain it.
// Prints CSV after a line with the command, and a summary on the standard error. alpha = 1 %.

#include <mc/check/random_faults.h>
#include <mc/check/regression_subjects.h>

#include <mc/check/check_subject.h>

#include <cstdlib>
#include <ctime>
#include <map>

namespace checker_bench {
namespace {

struct Options {
  std::string what = "right";
  std::uint64_t cases = 100, first = 1;
  double samples = 1e6;
  std::string name;
};

mc::Report check(const Subject& subject, std::uint64_t seed, const Options& o) {
  return check_subject(subject, {.samples = static_cast<std::uint64_t>(o.samples),
                                 .seed = seed,
                                 .alpha = 0.01,
                                 .open_interval = o.what == "rounded"});
}

void print(std::uint64_t seed, const FaultySubject& one, const mc::Report& report, double seconds) {
  std::string check;
  for (const mc::Check& c : report.checks)
    if (check.empty() && c.verdict == report.verdict() && c.verdict != mc::Verdict::pass) check = c.name;
  fmt::print("{},{},{:.4g},{},{},{:.3g},{},{:.3g},{:.3g},{:.2f}\n", seed, one.kind, one.size, one.subject.name,
             mc::name(report.verdict()), report.p(), check.empty() ? "" : '"' + check + '"', report.detectable,
             report.detectable_cell, seconds);
  std::fflush(stdout);
}

void run(const Options& o) {
  fmt::print(
      "# bench_mc_check_error_rates {} {} {} {:g}{}\nseed,kind,size,name,verdict,p,check,detects,in_a_cell,seconds\n",
      o.what, o.cases, o.first, o.samples, o.name.empty() ? "" : " " + o.name);
  std::map<std::string, std::map<std::string, int>> verdicts;
  double seconds = 0, checked = 0;
  const auto one_case = [&](std::uint64_t seed, const FaultySubject& one) {
    if (one.subject.name.find(o.name) == std::string::npos) return;
    const std::clock_t start = std::clock();
    const mc::Report report = check(one.subject, seed, o);
    const double used = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    seconds += used;
    checked += 1;
    ++verdicts[o.what == "foreign" ? one.subject.name : one.kind][std::string(mc::name(report.verdict()))];
    print(seed, one, report, used);
  };
  const std::vector<RegressionSubject> foreign =
      o.what == "foreign" ? regression_subjects() : std::vector<RegressionSubject>{};
  for (std::uint64_t seed = o.first; seed < o.first + o.cases; ++seed)
    if (o.what == "foreign") {
      for (const RegressionSubject& f : foreign) one_case(seed, {f.right ? "right" : "wrong", 0, f.subject});
    } else if (o.what == "right") {
      one_case(seed, {"right", 0, random_correct(seed)});
    } else if (o.what == "narrow") {
      one_case(seed, {"right", 0, random_narrow(seed)});
    } else if (o.what == "rounded") {
      one_case(seed, {"right", 0, random_rounded(seed)});
    } else {
      const Subject right = random_continuous(seed);
      if (right.name.find(o.name) == std::string::npos) continue;
      if (o.what == "promise") one_case(seed, stated_fault(right, check(right, seed, o), seed));
      else one_case(seed, random_fault(right, seed, o.samples));
    }
  for (const auto& [kind, counts] : verdicts)
    for (const auto& [verdict, count] : counts) fmt::print(stderr, "{}: {} {}\n", kind, verdict, count);
  fmt::print(stderr, "{:.2f} CPU seconds each\n", seconds / checked);
}

} // namespace
} // namespace checker_bench

int main(int argc, char** argv) {
  checker_bench::Options o;
  if (argc > 1) o.what = argv[1];
  if (argc > 2) o.cases = static_cast<std::uint64_t>(std::atof(argv[2]));
  if (argc > 3) o.first = static_cast<std::uint64_t>(std::atof(argv[3]));
  if (argc > 4) o.samples = std::atof(argv[4]);
  if (argc > 5) o.name = argv[5];
  checker_bench::run(o);
}

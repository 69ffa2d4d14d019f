#include <mc/check/fit/tests/fit_test.h>

#include <mc/random/hash.h>
#include <mc/stats/multiple_testing.h>

#include <algorithm>
#include <utility>

namespace mc {

Check statistical_check(std::string name, double p, double statistic, double share, double alpha, Fault fault,
                        std::string detail) {
  Check c{std::move(name), Verdict::pass, p, share, statistic, 0, fault, {}};
  if (p > sidak_level(alpha, share)) return c;
  c.verdict = Verdict::fail;
  c.detail = std::move(detail);
  return c;
}

std::uint64_t inverted_stream(const SubjectOptions& options) { return hash(options.seed, 5); }

std::uint64_t inverted_count(const SubjectOptions& options) {
  return std::min<std::uint64_t>(options.samples, 1 << 17);
}

std::vector<Check*> checks_of_cells(std::vector<TestFindings>& findings) {
  std::vector<Check*> checks;
  for (TestFindings& f : findings)
    if (f.row && f.row->of_cells)
      for (Check& c : f.checks) checks.push_back(&c);
  return checks;
}

void prepend_finding(const std::vector<Check*>& checks, const std::string& finding) {
  if (finding.empty()) return;
  const auto prepend = [&](auto accepts) {
    const auto first = std::find_if(checks.begin(), checks.end(),
                                    [&](const Check* c) { return c->verdict == Verdict::fail && accepts(*c); });
    if (first != checks.end() && !(*first)->detail.starts_with(finding))
      (*first)->detail = finding + "; " + (*first)->detail;
  };
  prepend([](const Check&) { return true; });
  prepend([](const Check& c) { return c.p && *c.p < 1e-9; });
}

} // namespace mc

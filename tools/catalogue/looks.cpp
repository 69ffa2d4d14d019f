#include <catalogue/looks.h>
#include <terminal/interrupt.h>

#include <mc/random/hash.h>
#include <mc/stats/multiple_testing.h>

#include <optional>
#include <vector>

namespace carlo {

namespace {

constexpr double share_of_early_look = 0.05;
constexpr std::uint64_t first_look = 1'000'000, growth = 10;

std::vector<std::uint64_t> looks_for(std::uint64_t samples) {
  std::vector<std::uint64_t> looks;
  for (std::uint64_t n = first_look; n <= samples / growth; n *= growth) looks.push_back(n);
  looks.push_back(samples);
  return looks;
}

} // namespace

LookReport check_in_looks(const std::function<mc::Report(const CaseOptions&)>& check, const CaseOptions& options) {
  const std::vector<std::uint64_t> looks = looks_for(options.samples);
  if (looks.size() == 1) return {check(options)};
  std::optional<mc::Report> last;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const bool is_last = i + 1 == looks.size();
    const double share = is_last ? 1 - share_of_early_look * static_cast<double>(i) : share_of_early_look;
    CaseOptions own = options;
    own.samples = looks[i];
    own.alpha = mc::sidak_level(options.alpha, share);
    if (!is_last) own.seed = mc::hash(options.seed, i);
    try {
      mc::Report report = check(own);
      report.alpha = options.alpha;
      for (mc::Check& c : report.checks) c.share *= share;
      last = std::move(report);
    } catch (const Interrupted&) {
      if (!last) throw;
      return {std::move(*last), false};
    }
    if (last->verdict() == mc::Verdict::fail) break;
  }
  return {std::move(*last)};
}

} // namespace carlo

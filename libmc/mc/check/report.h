#pragma once
/// What a checker found.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mc {

/// `inconclusive`: the test itself could not be trusted (say, its quadrature did not converge). Never counted as a pass.
enum class Verdict { pass, fail, inconclusive };

std::string_view name(Verdict v);

/// One law or test applied to one subject.
struct Check {
  std::string name;              ///< e.g. "chi-square", "invert", "mass"
  Verdict verdict = Verdict::pass;
  std::optional<double> p;       ///< p-value of a statistical test; none for a deterministic law
  double statistic = 0;          ///< the test statistic, or the largest error of a deterministic law
  double limit = 0;              ///< what `statistic` (deterministic) may reach
  double detectable = 0;         ///< smallest relative density error caught with 99 % probability; 0: not stated
  std::string detail;            ///< where and by how much, one line; empty when there is nothing to say
};

/// All checks of one subject. Statistical checks share one family-wise alpha, see multiple_testing.h.
struct Report {
  std::string subject;
  double alpha = 0.01;
  std::uint64_t samples = 0;
  double seconds = 0;
  double ns_per_sample = 0;
  std::vector<Check> checks;

  Verdict verdict() const; ///< fail if any failed, else inconclusive if any is, else pass
  bool passed() const { return verdict() == Verdict::pass; }
  double p() const;        ///< family-wise adjusted p-value (Sidak over the statistical checks); 1 without any
  /// Several lines: the verdict, then each check that did not pass with its detail.
  std::string to_string() const;
};

} // namespace mc

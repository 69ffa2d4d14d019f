#pragma once
/// What a checker found.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mc {

/// `inconclusive`: the test itself could not be trusted (say, its quadrature did not converge). Never counted as a pass.
enum class Verdict { pass, fail, inconclusive };

std::string_view name(Verdict v);

/// What a failed check points to. `shape`: the samples follow another density than the one claimed.
enum class Fault { none, edge, not_finite, outside, leak, mass, weight, support, inverse, jacobian, precision, atom, shape, local, physics };

std::string_view name(Fault f);

/// One law or test applied to one subject.
struct Check {
  std::string name;              ///< e.g. "chi-square, 16 to 63 cells", "invert", "mass"
  Verdict verdict = Verdict::pass;
  std::optional<double> p;       ///< p-value of a statistical test; none for a deterministic law
  double share = 0;              ///< share of the family-wise alpha that a statistical test spends; the shares add up to 1
  double statistic = 0;          ///< the test statistic, or the largest error of a deterministic law
  double limit = 0;              ///< what `statistic` (deterministic) may reach
  Fault fault = Fault::none;     ///< what it would point to if it failed
  std::string detail;            ///< where and by how much, one line; empty when there is nothing to say
};

/// A cell of the partition whose count is far from what the density claims.
struct WorstCell {
  std::array<double, 3> lo{}, hi{}; ///< chart coordinates
  double observed = 0, expected = 0, z = 0;
  std::string where;                ///< its centre as a point of the domain
};

/// All checks of one subject. Statistical checks share one family-wise alpha, see multiple_testing.h.
struct Report {
  std::string subject;
  double alpha = 0.01;
  std::uint64_t samples = 0;
  double mass = 1, mass_error = 0; ///< integral of the claimed density, atoms included, and its error bound
  double detectable = 0;           ///< relative error of the density, of random sign from cell to cell, caught with probability .99
  double detectable_cell = 0;      ///< relative error in a single cell of average mass, caught with probability .99
  double seconds = 0;
  double ns_per_sample = 0;
  std::vector<Check> checks;
  std::vector<WorstCell> worst;    ///< the five worst, worst first

  Verdict verdict() const; ///< fail if any failed, else inconclusive if any is, else pass
  bool passed() const { return verdict() == Verdict::pass; }
  double p() const;        ///< family-wise adjusted p-value (weighted Sidak over the statistical checks); 1 without any
  Fault fault() const;     ///< the likely fault: that of the first failed check, deterministic ones first
  /// Several lines: the verdict, then each check that did not pass with its detail, then the worst cells.
  std::string to_string() const;
};

} // namespace mc

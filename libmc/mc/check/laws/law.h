#pragma once
/// Interface of the laws of distributions. Each law is one function in a file of its own and one row of table.cpp.

#include <mc/check/laws/worst_error.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/any_distribution.h>
#include <mc/check/subject/options.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <type_traits>

namespace mc {

/// Options of the laws. Error bounds are the contract of the distribution, in machine epsilons of its scalar.
struct LawOptions {
  std::string name = "warp";      ///< name in the report
  SubjectOptions statistics = {}; ///< options of the statistical tests, and the seed; 0 samples skip the tests
  std::uint64_t points = 256;     ///< number of random points for the laws over the 50-digit oracle
  double invert_eps = 16;         ///< bound on |invert(sample(u)) - u|
  double sample_eps = 16;         ///< |sample(u) - exact| / max(1, |exact|), beyond the effect of 4 rounding steps of u
  double pdf_eps = 64;            ///< bound on |pdf(x) / exact - 1|
  double mass_eps = 64;           ///< bound on |mass - 1| beyond the quadrature error
};

/// A row of a table of deterministic laws.
///   Subject : the types of the arguments: a distribution with its options, a BSDF with its direction, or a family of
///             BSDFs.
template <class... Subject> struct LawRow {
  const char* name;                           ///< name in a list of laws that were not tried
  Findings (*law)(const Subject&... subject); ///< returns no checks if the subject lacks a required part
  const char* missing; ///< the reason for no checks, for example "no invert"; null: a report lists no reason
};

/// Runs the laws in the order of the table, and appends their findings to the report.
template <class... Subject>
void run_laws(std::span<const LawRow<Subject...>> laws, Report& report,
              const std::type_identity_t<Subject>&... subject) {
  for (const LawRow<Subject...>& row : laws) {
    Findings found = row.law(subject...);
    if (found.checks.empty() && row.missing) report.untried.push_back({row.name, row.missing});
    report.checks.insert(report.checks.end(), found.checks.begin(), found.checks.end());
    report.figures.insert(report.figures.end(), found.figures.begin(), found.figures.end());
  }
}

/// A law of distributions.
using Law = Findings(const AnyDistribution& distribution, const LawOptions& options);

Law inverse_law, determinism_law; ///< laws that other files call directly

/// Returns a random point of the unit cube: the same numbers in double for all scalars, rounded to the distribution's
/// scalar.
AnyDistribution::Uniforms rounded_uniforms(const AnyDistribution& distribution, Pcg& random);
/// The same without rounding.
OracleDistribution::Point oracle_uniforms(const AnyDistribution& distribution, Pcg& random);

} // namespace mc

#pragma once
/// The table of all checks: laws, statistical tests and explanations. A new check is one file and one row of table.cpp.

#include <mc/check/fit/tests/fit_test.h>
#include <mc/check/laws/bsdf/roughness_limit.h>
#include <mc/check/laws/law.h>

#include <span>

namespace mc {

/// Returns the laws of distributions, in the order of a report.
std::span<const LawRow<AnyDistribution, LawOptions>> distribution_laws();

/// Returns the laws of BSDFs for a fixed wo.
std::span<const LawRow<BsdfView>> bsdf_laws();

/// Returns the laws of BSDFs whose roughness tends to 0.
std::span<const LawRow<RoughnessFamily>> roughness_laws();

/// Returns the statistical tests and the laws of counted samples, in the order of a report.
std::span<const FitTestRow> fit_tests();

/// Returns the explanations, in the order in which they change the findings.
std::span<const ExplanationRow> explanations();

} // namespace mc

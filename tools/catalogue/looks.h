#pragma once
/// Checks with many samples that end when the verdict is sure.

#include <catalogue/catalogue.h>

#include <functional>

namespace carlo {

/// A report, and whether it is that of all samples.
struct LookReport {
  mc::Report report;
  bool is_complete = true; ///< false: the check was interrupted, and the report is that of the last finished look
};

/// Checks with options.samples samples in looks: 1e6, 1e7, ... samples as long as these are at most a tenth, then all.
/// Each look has samples of its own. A look that fails ends the check: a correct distribution fails in any look with
/// probability options.alpha.
///   alpha  : each look before the last has 5 % of it.
///   throws : what `check` throws. Interrupted only before the end of the first look.
LookReport check_in_looks(const std::function<mc::Report(const CaseOptions&)>& check, const CaseOptions& options);

} // namespace carlo
